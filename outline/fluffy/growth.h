#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rinkaku::fluffy {

/// Which part of a mesh fluff grows from.
struct Selection {
  /// Names of materials, nodes or groups, with * and ? as in file names; empty: all.
  std::vector<std::string> names;
  /// The channel of the vertex colours (0 red to 3 alpha) that says how long fluff is, 0 to 1; 0 is bare. -1: none.
  int painted_channel = -1;
};

/// Where the frame lies.
enum class Growth {
  AlongNormals,  ///< the skin moved along its welded normals: as long everywhere
  Scaled,        ///< the skin scaled about its own centre, as the paper has it
};

/// Where texture coordinates come from.
enum class Coordinates {
  Generated,  ///< laid on along the axis that the surface faces most
  Mesh,
};

struct FrameOptions {
  Selection selection;
  Growth growth = Growth::AlongNormals;
  /// p: how much larger than the chosen part the frame is. Along normals, fluff is (p - 1) times the part's mean
  /// distance from its centre.
  double scale = 1.1;
  std::optional<double> length_m;  ///< of the fluff, instead of what `scale` gives; along normals only
  double exaggeration = 0;         ///< fluff gets up to 1 + this times as long where the shape bends
  Coordinates coordinates = Coordinates::Generated;
  std::optional<double> tile_m;  ///< generated: how large the texture lies on the surface
  double tile_lengths = 8;       ///< the same in lengths of the fluff, where tile_m is not given
  /// How far a coarser frame than the mesh may lie from it, in lengths of the fluff; 0: the mesh's own triangles.
  double coarseness = 0;
  double repeat = 1;  ///< the mesh's: how often the texture goes into theirs
};

/// The length that fluff has along normals before it is varied, in metres; see FrameOptions::scale.
double base_length_m(const FrameOptions& options, double mean_radius_m);

}  // namespace rinkaku::fluffy

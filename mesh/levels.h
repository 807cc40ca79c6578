#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace rinkaku::mesh {

/// A coarser version of a mesh: other triangles over the same vertices.
struct Level {
  std::vector<glm::uvec3> triangles;  ///< indices of the whole mesh's vertices
  /// Each of the whole mesh's parts twice, in order: first its kept triangles, then the rest, simplified. Some may be
  /// empty.
  std::vector<Part> parts;
  /// About how far its surface lies from the whole mesh's, in the mesh's units (by quadrics).
  double error = 0;
};

/// Coarser levels of a mesh, each made when it is asked for.
///
/// A level leaves out vertices, and never moves one. What stays as it is: kept triangles, textured parts (the error
/// does not tell how far a texture slides), and the borders of parts, of kept triangles and of open surfaces. Small
/// meshes have no levels, nor have those with vertex colours, which a coarser level would smear. Garland and Heckbert,
/// "Surface simplification using quadric error metrics", 1997 (through meshoptimizer).
class Levels {
 public:
  /// `kept` says per triangle whether it stays (1), as one over which the shading changes does; empty for none.
  explicit Levels(const Mesh& mesh, std::span<const std::uint8_t> kept = {});

  std::size_t count() const { return errors_.size(); }
  /// What a level's error is at most, in the mesh's units; it grows from level to level.
  double most_error(std::size_t level) const { return errors_[level]; }
  /// Cost: about 0.5 microseconds a triangle of the mesh.
  Level make(std::size_t level) const;

 private:
  // A part's triangles: those that stay, and those that may be simplified.
  struct SplitPart {
    Part part;
    std::vector<unsigned> kept, free;
  };
  std::vector<glm::vec3> positions_;
  std::vector<SplitPart> parts_;
  std::vector<double> errors_;
  double extent_ = 0;
};

}  // namespace rinkaku::mesh

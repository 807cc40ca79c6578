#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// [[water.surface.arrow]]: how water flows at a place, drawn on the screen or laid down in the world.
struct WaterArrowScene {
  std::string where;        ///< file:line:column
  std::size_t in_file = 0;  ///< which one of the file's it is
  std::int64_t frame = 0;
  bool on_screen = true;
  glm::dvec2 from_px{0}, to_px{0};  ///< pixels of the recording
  glm::dvec3 from_m{0}, to_m{0};    ///< world
  bool operator==(const WaterArrowScene&) const = default;
};

/// [[water.surface]]: one plane piece of water.
struct WaterSurfaceScene {
  std::string where;
  std::vector<glm::dvec3> outline_m;
  std::vector<int> open;  ///< edges that water flows through, by the number of their first corner
  std::vector<std::vector<glm::dvec3>> obstacles_m;
  std::vector<WaterArrowScene> arrows;  ///< in order of frames; every key frame has as many
  std::optional<double> alpha_m;
  std::optional<std::array<double, 3>> colour;  ///< in place of the water's
  bool operator==(const WaterSurfaceScene&) const = default;
};

/// [[water.spray]]: drops that rise along a line, as at a waterfall's foot.
struct WaterSprayScene {
  std::string where;
  glm::dvec3 from_m{0}, to_m{0};
  int drops = 300;
  double height_m = 0.3;
  double size_m = 0.1;
  std::array<double, 3> colour{0.95, 0.97, 1.0};
  bool operator==(const WaterSprayScene&) const = default;
};

/// A brush of the user's own, and where in the picture it is used.
struct WaterBrushScene {
  std::string where;
  std::filesystem::path image;
  bool on_screen = true;
  glm::dvec2 at_px{0};
  glm::dvec3 at_m{0};  ///< world
  bool operator==(const WaterBrushScene&) const = default;
};

/// [water]
struct WaterScene {
  std::string where;
  int strokes = 7000;
  double layers = 6.5;
  std::array<double, 3> colour{0.16, 0.33, 0.40};

  // stroke = { ... }
  std::optional<double> length_m;
  double aspect = 0.22;
  std::optional<double> width_px;
  double opacity = 0.9;
  double ground = 0.8;  ///< opacity of the first coat
  double foreshortening = 0.5;
  double variety = 0.05;

  // flow = { ... }
  enum class Flow { DivergenceFree, Arrows } flow = Flow::DivergenceFree;
  std::optional<double> alpha_m;
  int cells = 48;

  // mirror = { ... }
  bool mirror_plate = true;
  double surroundings_m = 20;
  double reflection = 0.9;
  std::array<double, 3> sky_zenith{0.33, 0.53, 0.77}, sky_horizon{0.80, 0.87, 0.90};
  std::filesystem::path panorama;  ///< empty: a gradient

  // colours = { ... }
  enum class Colours { ByCamera, Keys, Followed, Sampled } colours = Colours::ByCamera;
  int key_frames = 15;
  double ripple = 0.4;
  bool mean = true;

  // waterline = { ... }
  bool waterline = true;
  std::array<double, 3> waterline_colour{0.86, 0.92, 0.93};

  std::vector<WaterSurfaceScene> surfaces;
  std::vector<WaterSprayScene> sprays;
  std::vector<WaterBrushScene> brushes;
  bool operator==(const WaterScene&) const = default;
};

/// Whether they are equal but for where in the file they stand.
bool paints_the_same(WaterScene a, WaterScene b);

toml::Schema water_schema();

/// Throws Error (Input).
WaterScene read_water(const toml::Table& water);

}  // namespace rinkaku::pipeline

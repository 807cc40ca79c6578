#include "apps/rinkaku/viewer/tunables.h"

namespace rinkaku::app {

// A new key of a pass that can change while running adds its line here; docs/scene.md has the limits.
const std::vector<Tunable>& object_tunables() {
  using Kind = Tunable::Kind;
  static const std::vector<Tunable> all = {
      {"", "position_m", "position", Kind::Vector, -2, 2, 0},
      {"", "rotation_deg", "rotation", Kind::Vector, -180, 180, 0},
      {"", "height_m", "height", Kind::Number, 0.01, 2, 0.1, true},
      {"", "colour", "colour", Kind::Colour},
      {"toon", "bands", "bands", Kind::Whole, 2, 16, 3},
      {"toon", "shade_colour", "shade", Kind::Colour},
      {"outline", "width_px", "width", Kind::Number, 0.5, 20, 3},
      {"outline", "colour", "line colour", Kind::Colour},
      {"outline",
       "method",
       "method",
       Kind::Choice,
       0,
       0,
       0,
       false,
       {"uniform", "curvature", "control", "hull", "depth_normals", "silhouette", "laplacian", "z_lines",
        "hidden_lines", "facing", "isophote", "wobble", "strokes"}},
      {"outline", "exaggeration", "exaggeration", Kind::Number, 0, 20, 1, false, {}, "method", "curvature"},
      {"outline", "saturation", "saturation", Kind::Number, 0.05, 10, 1, true, {}, "method", "curvature"},
      {"outline", "curve", "curve", Kind::Number, 0.1, 4, 1, false, {}, "method", "curvature"},
      {"outline", "min_factor", "thinnest", Kind::Number, 0.05, 1, 0.25, false, {}, "method", "curvature"},
      {"outline", "smoothing", "smoothing", Kind::Whole, 0, 100, 3, false, {}, "method", "curvature"},
      {"outline",
       "sign",
       "sign",
       Kind::Choice,
       0,
       0,
       0,
       false,
       {"magnitude", "convex", "concave"},
       "method",
       "curvature"},
      {"outline", "taper_px", "taper", Kind::Number, 0, 100, 0},
      {"fluffy", "scale", "fluff size", Kind::Number, 1.01, 3, 1.1},
      {"fluffy", "threshold", "fluff threshold", Kind::Number, 0, 1, 0.5},
      {"fluffy", "angle_deg", "fluff band", Kind::Number, 1, 179, 70},
      {"fluffy", "hang", "fluff hang", Kind::Number, 0, 2, 0.25},
      {"fluffy", "exaggeration", "fluff exaggeration", Kind::Number, 0, 20, 0},
  };
  return all;
}

const std::vector<Tunable>& scene_tunables() {
  static const std::vector<Tunable> all = {
      {"light", "direction", "light", Tunable::Kind::Vector, -1, 1, 0, false, {}, "", "", {-0.4f, 0.5f, 0.8f}},
  };
  return all;
}

}  // namespace rinkaku::app

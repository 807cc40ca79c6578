#include "apps/rinkaku/viewer/tunables.h"

namespace rinkaku::app {

// A new key of a pass that can change while running adds its line here; docs/scene.md has the limits.
const std::vector<Tunable>& object_tunables() {
  using Kind = Tunable::Kind;
  static const std::vector<Tunable> all = {
      {"", "position_m", "position", Kind::Vector, -2, 2, 0},
      {"", "rotation_deg", "rotation", Kind::Vector, -180, 180, 0},
      {.table = "",
       .key = "height_m",
       .label = "height",
       .least = 0.01,
       .most = 2,
       .logarithmic = true,
       .only_given = true},
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
      {"outline", "thickness_part", "part of thickness", Kind::Number, 0, 5, 0.5, false, {}, "method", "curvature"},
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
      {"outline", "taper_px", "taper", Kind::Number, 0, 100, 6},
      {"fluffy", "scale", "fluff size", Kind::Number, 1.01, 3, 1.1},
      {"fluffy", "threshold", "fluff threshold", Kind::Number, 0, 1, 0.5},
      {"fluffy", "angle_deg", "fluff band", Kind::Number, 1, 179, 70},
      {"fluffy", "hang", "fluff hang", Kind::Number, 0, 2, 0.25},
      {"fluffy", "exaggeration", "fluff exaggeration", Kind::Number, 0, 20, 0},
  };
  return all;
}

const std::vector<Tunable>& water_tunables() {
  using Kind = Tunable::Kind;
  static const std::vector<Tunable> all = {
      {"", "strokes", "strokes", Kind::Whole, 500, 30000, 7000, true},
      {"", "layers", "layers", Kind::Number, 1, 20, 6.5},
      {"", "colour", "deep water", Kind::Colour},
      {.table = "stroke",
       .key = "length_m",
       .label = "length",
       .least = 0.01,
       .most = 5,
       .logarithmic = true,
       .only_given = true},
      {.table = "stroke",
       .key = "aspect",
       .label = "aspect",
       .least = 0.02,
       .most = 2,
       .preset = 0.22,
       .without_key = "width_px"},
      {.table = "stroke", .key = "width_px", .label = "width", .least = 0.5, .most = 50, .only_given = true},
      {"stroke", "opacity", "opacity", Kind::Number, 0.05, 1, 0.9},
      {"stroke", "ground", "first coat", Kind::Number, 0, 1, 0.8},
      {"stroke", "foreshortening", "foreshorten", Kind::Number, 0, 1, 0.5},
      {"stroke", "variety", "variety", Kind::Number, 0, 0.5, 0.05},
      {"flow", "method", "flow", Kind::Choice, 0, 0, 0, false, {"divergence_free", "arrows"}},
      {.table = "flow",
       .key = "alpha_m",
       .label = "arrows' reach",
       .least = 0.01,
       .most = 20,
       .logarithmic = true,
       .only_given = true},
      {"mirror", "plate", "mirrored plate", Kind::Flag, 0, 1, 1},
      {"mirror", "reflection", "reflection", Kind::Number, 0, 1, 0.9},
      {"mirror", "surroundings_m", "surroundings", Kind::Number, 1, 200, 20, true},
      {"mirror", "zenith", "zenith", Kind::Colour},
      {"mirror", "horizon", "horizon", Kind::Colour},
      {.table = "colours",
       .key = "method",
       .label = "colours",
       .kind = Kind::Choice,
       .choices = {"keys", "followed", "sampled"},
       .only_given = true},
      {"colours", "key_frames", "frames to a key", Kind::Whole, 1, 60, 15},
      {"colours", "ripple", "ripple", Kind::Number, 0, 4, 0.4},
      {"colours", "mean", "mean of nine", Kind::Flag, 0, 1, 1},
      {"waterline", "colour", "waterline", Kind::Colour},
  };
  return all;
}

const std::vector<Tunable>& water_surface_tunables() {
  static const std::vector<Tunable> all = {
      {.table = "", .key = "colour", .label = "colour", .kind = Tunable::Kind::Colour},
      {.table = "",
       .key = "alpha_m",
       .label = "arrows' reach",
       .least = 0.01,
       .most = 20,
       .logarithmic = true,
       .only_given = true},
  };
  return all;
}

const std::vector<Tunable>& water_spray_tunables() {
  using Kind = Tunable::Kind;
  static const std::vector<Tunable> all = {
      {"", "drops", "drops", Kind::Whole, 1, 2000, 300, true},
      {"", "height_m", "height", Kind::Number, 0.01, 5, 0.3, true},
      {"", "size_m", "size", Kind::Number, 0.01, 2, 0.1, true},
      {"", "colour", "colour", Kind::Colour},
  };
  return all;
}

const std::vector<Tunable>& foreground_tunables() {
  using Kind = Tunable::Kind;
  static const std::vector<Tunable> all = {
      {.table = "",
       .key = "distance_m",
       .label = "distance",
       .least = 0.05,
       .most = 20,
       .logarithmic = true,
       .only_given = true},
      {.table = "", .key = "refine", .label = "refined borders", .kind = Kind::Flag, .only_given = true},
      {"chroma", "key", "key colour", Kind::Colour},
      {"chroma", "hue_deg", "hue tolerance", Kind::Number, 5, 85, 35},
      {"chroma", "clip_low", "nothing below", Kind::Number, 0, 0.5, 0.12},
      {"chroma", "clip_high", "all above", Kind::Number, 0.55, 1, 0.9},
      {"chroma", "despill", "despill", Kind::Number, 0, 1, 1},
      {"difference", "threshold", "threshold", Kind::Number, 0.1, 20, 2.5, true},
      {"difference", "deepest_shadow", "deepest shadow", Kind::Number, 0, 1, 0.6},
      {.table = "difference",
       .key = "memory_frames",
       .label = "memory",
       .kind = Kind::Whole,
       .least = 2,
       .most = 3000,
       .preset = 300,
       .logarithmic = true,
       .without_key = "clean"},
  };
  return all;
}

const std::vector<Tunable>& scene_tunables() {
  static const std::vector<Tunable> all = {
      {"light", "direction", "light", Tunable::Kind::Vector, -1, 1, 0, false, {}, "", "", {-0.4f, 0.5f, 0.8f}},
      {.table = "background", .key = "colour", .label = "background", .kind = Tunable::Kind::Colour},
  };
  return all;
}

}  // namespace rinkaku::app

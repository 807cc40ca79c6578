#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "outline/width_options.h"
#include "pipeline/frame/picture_format.h"

namespace rinkaku::pipeline {

/// The scene file as plain values: validated, defaults filled in, paths made absolute. Lengths in metres, angles in the
/// file's degrees; docs/scene.md describes every key.

struct PlateScene {
  std::string input;             ///< video file or image sequence pattern; absolute
  std::optional<Rational> fps;   ///< of an image sequence
  std::filesystem::path camera;  ///< camera.yml; empty if there is none (then nothing can be drawn)
};

struct MarkerTrack {
  std::string dictionary;  ///< as OpenCV names it without "DICT_": "ARUCO_ORIGINAL", "APRILTAG_36h11", "4X4_50"
  int id = 0;
  double size_m = 0;
};
struct BoardTrack {
  std::filesystem::path board;
};
struct PoseFileTrack {
  std::filesystem::path poses;
};
struct LockedTrack {
  glm::dvec3 position_m{0, 0, 0};
  glm::dvec3 look_at_m{0, 1, 0};
  glm::dvec3 up{0, 0, 1};
};

/// One-Euro filter (Casiez, Roussel, Vogel 2012).
struct Smoothing {
  bool on = false;
  double min_cutoff_hz = 1.0;
  double beta = 1.0;  ///< cutoff gained per pixel/s of motion in the picture
};

struct TrackScene {
  std::variant<MarkerTrack, BoardTrack, PoseFileTrack, LockedTrack> from;
  Smoothing smoothing;  ///< on by default for marker and board
  // For marker and board only:
  double hold_s = 0.3;  ///< a lost marker's last pose is kept for so long
  double fade_s = 0.3;  ///< then the CG fades out over this time
};

struct ToonScene {
  int bands = 3;
  std::array<double, 3> shade_colour{0.62, 0.60, 0.78};  ///< sRGB; what the darkest band multiplies the colour by
};

struct OutlineScene {
  double width_px = 3;
  std::optional<double> width_m;  ///< in place of width_px
  double min_px = 0;              ///< for width_m
  double max_px = 40;
  double taper_px = 0;                             ///< 0: lines end blunt; by default 15 with the method Curvature
  std::array<double, 3> colour{0.07, 0.05, 0.09};  ///< sRGB
  enum class Method { Uniform, Curvature } method = Method::Uniform;
  // For the method Curvature; see outline/width_options.h.
  using Curvature = outline::CurvatureKind;
  using Sign = outline::CurvatureSign;
  Curvature curvature = Curvature::Mean;
  Sign sign = Sign::Magnitude;
  double exaggeration = 2;
  double saturation = 1;
  double curve = 1;
  double min_factor = 0.25;
  int smoothing = 3;
};

struct ObjectScene {
  std::string name;  ///< for messages; the mesh's file name if not given
  std::filesystem::path mesh;
  glm::dvec3 position_m{0, 0, 0};
  glm::dvec3 rotation_deg{0, 0, 0};  ///< about world x, then y, then z
  std::optional<double> height_m;    ///< scales the mesh so that it is this high along its up axis
  glm::dvec3 scale{1, 1, 1};         ///< used where height_m is not given
  std::optional<char> up;            ///< 'x', 'y' or 'z': the mesh's own up axis; empty: by the format
  /// What lies at position_m: the middle of the mesh's bottom (of its bounding box), or the mesh's own origin. By
  /// default the bottom, but where `scale` is given the origin.
  enum class Anchor { Base, Origin } anchor = Anchor::Base;
  double crease_deg = 60;                       ///< edges sharper than this are shaded hard
  std::optional<std::array<double, 3>> colour;  ///< sRGB; replaces the materials' base colours
  std::optional<ToonScene> toon;                ///< empty: flat colour, unlit
  std::optional<OutlineScene> outline;
  /// The model of a filmed thing: not drawn, but CG behind it is hidden.
  bool holdout = false;
};

struct LightScene {
  glm::dvec3 direction{-0.4, 0.5, 0.8};  ///< towards the light, in the world
};

/// What is written when the command line gives no -o.
struct OutputScene {
  std::string path;  ///< video, image pattern or "-"; empty if the scene has none
  std::string codec;
  std::int64_t bit_rate = 0;
  enum class Content { Composite, Cg } content = Content::Composite;  ///< Cg: CG on nothing, straight alpha
};

struct Scene {
  std::filesystem::path file;
  PlateScene plate;
  std::optional<TrackScene> track;
  LightScene light;
  std::vector<ObjectScene> objects;
  OutputScene output;
};

/// What the call puts in the scene file's place.
struct SceneOptions {
  std::string input;  ///< a video or image pattern instead of the plate's own, which then needn't exist; not checked
};

/// Reads and validates a scene file (TOML). Throws Error (Input) naming file, line and column: unknown keys with the
/// nearest known one, wrong types, values out of range (NaN and infinity among them), missing files, keys that exclude
/// or need each other.
Scene read_scene(const std::filesystem::path& file, const SceneOptions& options = {});

}  // namespace rinkaku::pipeline

#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include <glm/vec3.hpp>

#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

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

/// [track]: where the camera's pose comes from.
struct TrackScene {
  std::variant<MarkerTrack, BoardTrack, PoseFileTrack, LockedTrack> from;
  Smoothing smoothing;  ///< on by default for marker and board
  // For marker and board only:
  double hold_s = 0.3;  ///< a lost marker's last pose is kept for so long
  double fade_s = 0.3;  ///< then the CG fades out over this time
};

toml::Schema track_schema();

/// Throws Error (Input).
TrackScene read_track(const toml::Table& track);

}  // namespace rinkaku::pipeline

#include <cmath>
#include <cstdio>

#include <opencv2/imgcodecs.hpp>

#include "recordings/generator/desk_room.h"
#include "recordings/generator/film.h"
#include "recordings/generator/random.h"
#include "recordings/generator/recordings.h"
#include "recordings/generator/shot.h"

namespace rinkaku::recordings {
namespace {

constexpr int frames_in_all = 150;

CameraModel desk_camera() {
  CameraModel camera{1280, 720, 1010.4, 1008.7, 646.3, 354.8, {}};
  camera.distortion = {-0.1620, 0.0480, 0.0009, -0.0006, -0.0065};
  return camera;
}

// Muscles shake at 1 to 10 Hz, the slow parts widest. Standard deviation about 1.
double tremor(double time_s, unsigned channel) {
  double sum = 0;
  constexpr int parts = 7;
  for (unsigned i = 0; i < parts; ++i) {
    const double hz = 0.7 * std::pow(1.55, i) * (0.9 + 0.2 * uniform({channel, i, 1}));
    sum += std::sin(6.283185307 * (hz * time_s + uniform({channel, i, 2}))) / std::pow(1.5, i);
  }
  return sum;
}

RigidTransform hand_held(double t, const BoardLayout& board) {
  const double turn = 0.5 - 0.5 * std::cos(3.14159265 * t / 5);  // 0 to 1 in five seconds, softly
  const double azimuth = -0.40 + 0.82 * turn + 0.05 * std::sin(1.9 * t);
  const double elevation = 0.56 + 0.10 * std::sin(1.25 * t + 0.4);
  const double distance = 0.60 - 0.10 * std::sin(3.14159265 * t / 5) + 0.015 * std::sin(2.6 * t);
  const glm::dvec3 middle(0.5 * static_cast<double>(board.width_m()), 0.5 * static_cast<double>(board.height_m()), 0);
  glm::dvec3 position = middle + distance * glm::dvec3(std::sin(azimuth) * std::cos(elevation),
                                                       -std::cos(azimuth) * std::cos(elevation), std::sin(elevation));
  glm::dvec3 target = middle + glm::dvec3(0.012 * std::sin(1.1 * t), 0.045 + 0.012 * std::sin(1.7 * t + 1), 0.035);
  position += 0.0011 * glm::dvec3(tremor(t, 1), tremor(t, 2), tremor(t, 3));
  target += 0.0016 * glm::dvec3(tremor(t, 4), tremor(t, 5), tremor(t, 6));
  return look_at(position, target, 0.02 * std::sin(0.9 * t) + 0.003 * tremor(t, 7));
}

}  // namespace

void make_desk(const std::filesystem::path& folder, FrameRange range) {
  std::filesystem::create_directories(folder);
  const BoardLayout board;
  const CameraModel camera = desk_camera();
  const Path path = [&](double time_s) { return hand_held(time_s, board); };
  const ShotOptions options;
  write_camera(folder / "camera.yml", camera);
  write_poses(folder / "poses.csv", path, frames_in_all, options.rate_hz);

  std::vector<glm::vec3> eyes;
  for (int i = 0; i < frames_in_all; i += 5) eyes.emplace_back(path(i / options.rate_hz).translation_m);
  const Room room = make_desk_room(board, eyes);
  const LensRays rays(camera);
  const FilmOptions film{1.0f, 0.28f, 3500, 6, 7};
  Encoder encoder(folder / "video.mp4", camera.width_px, camera.height_px, options.rate_hz, Encoder::Kind::Video, 22);
  for (int i = range.first; i < std::min(range.last, frames_in_all); ++i) {
    encoder.write(to_yuv420(develop(render(room, camera, rays, path, options, i), film, i)));
    std::fprintf(stderr, "\rdesk %d/%d", i + 1, frames_in_all);
  }
  std::fputc('\n', stderr);
  encoder.finish();
}

}  // namespace rinkaku::recordings

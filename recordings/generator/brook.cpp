#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

#include "recordings/generator/brook_land.h"
#include "recordings/generator/film.h"
#include "recordings/generator/parallel.h"
#include "recordings/generator/random.h"
#include "recordings/generator/recordings.h"
#include "recordings/generator/shot.h"

namespace rinkaku::recordings {
namespace {

constexpr int frames_in_all = 120;

CameraModel brook_camera() {
  CameraModel camera{1280, 720, 1010.4, 1009.8, 641.7, 357.9, {}};
  camera.distortion = {-0.0920, 0.0240, 0.0004, -0.0003, -0.0020};
  return camera;
}

cv::Mat3f landscape(const BrookLand& land, const CameraModel& camera, const RigidTransform& pose, int samples) {
  const LensRays rays(camera);
  cv::Mat3f picture(camera.height_px, camera.width_px);
  parallel_for(picture.rows, [&](int y) {
    for (int x = 0; x < picture.cols; ++x) {
      const glm::vec2 shift(uniform({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 1}),
                            uniform({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 2}));
      glm::vec3 sum(0);
      for (int s = 0; s < samples; ++s) {
        const glm::vec2 blur = 0.44f * gaussian(low_discrepancy(s, shift));
        const glm::vec2 ray = rays.at(static_cast<float>(x) + blur.x, static_cast<float>(y) + blur.y);
        const glm::dvec3 direction = glm::normalize(pose.rotation * glm::dvec3(ray.x, ray.y, 1.0));
        // A bright spot in one sample must not whiten the pixel.
        sum += glm::min(land.light(glm::vec3(pose.translation_m), glm::vec3(direction)), glm::vec3(2.5f));
      }
      for (int i = 0; i < 3; ++i) picture(y, x)[i] = sum[i] / static_cast<float>(samples);
    }
  });
  return picture;
}

}  // namespace

void make_brook(const std::filesystem::path& folder, FrameRange range) {
  std::filesystem::create_directories(folder);
  const CameraModel camera = brook_camera();
  const RigidTransform pose = look_at({0.0, -5.0, 1.9}, {0.55, 4.0, 0.55});
  write_camera(folder / "camera.yml", camera);
  write_poses(
      folder / "poses.csv", [&](double) { return pose; }, frames_in_all, 30);
  const BrookLand land;
  write_text(folder / "rocks.obj", land.rocks_obj());
  const cv::Mat3f light = landscape(land, camera, pose, 16);
  const FilmOptions film{0.95f, 0.22f, 5200, 6, 17};
  Encoder video(folder / "video.mp4", camera.width_px, camera.height_px, 30, Encoder::Kind::Video, 24);
  for (int i = range.first; i < std::min(range.last, frames_in_all); ++i) {
    // A thin cloud draws past.
    const double level = 1 + 0.03 * std::sin(0.9 * i / 30.0 + 0.4);
    video.write(to_yuv420(develop(light * level, film, i)));
    std::fprintf(stderr, "\rbrook %d/%d", i + 1, frames_in_all);
  }
  std::fputc('\n', stderr);
  video.finish();
}

}  // namespace rinkaku::recordings

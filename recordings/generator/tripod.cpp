#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "recordings/generator/film.h"
#include "recordings/generator/passer_by.h"
#include "recordings/generator/recordings.h"
#include "recordings/generator/shot.h"
#include "recordings/generator/tripod_room.h"

namespace rinkaku::recordings {
namespace {

constexpr int frames_in_all = 135;

CameraModel tripod_camera() {
  CameraModel camera{1280, 720, 1042.7, 1041.9, 634.8, 362.6, {}};
  camera.distortion = {-0.1280, 0.0310, -0.0005, 0.0008, -0.0032};
  return camera;
}

// Clouds before the sun: slow, within a few percent, and a trace of the mains' flicker.
float light_at(double time_s) {
  return static_cast<float>(1 + 0.020 * std::sin(1.1 * time_s + 0.3) + 0.008 * std::sin(3.7 * time_s) +
                            0.002 * std::sin(41 * time_s));
}

}  // namespace

void make_tripod(const std::filesystem::path& folder, FrameRange range) {
  std::filesystem::create_directories(folder);
  const CameraModel camera = tripod_camera();
  const RigidTransform pose = look_at({0.0, -4.2, 1.42}, {0.05, 0.6, 0.86});
  const Path path = [&](double) { return pose; };
  ShotOptions options;
  options.lens_radius_m = 0.0008f;
  options.focus_m = 4.2f;
  write_camera(folder / "camera.yml", camera);
  write_poses(folder / "poses.csv", path, frames_in_all, options.rate_hz);

  const Room room = make_tripod_room(glm::vec3(pose.translation_m));
  const LensRays rays(camera);
  ShotOptions still = options;
  still.samples = 64;
  const cv::Mat3f empty = render(room, camera, rays, path, still, 0);
  const FilmOptions film{1.0f, 0.24f, 4200, 6, 9};
  FilmOptions clean = film;
  clean.electrons *= 32;  // as if 32 pictures had been averaged
  clean.read_electrons *= 4;
  cv::imwrite(folder / "clean.jpg", to_bgr(develop(empty, clean, 0)), {cv::IMWRITE_JPEG_QUALITY, 95});

  const PasserByRenderer passer_by(room, camera, rays, pose, {-2.95f, -0.62f, 0});
  Encoder video(folder / "video.mp4", camera.width_px, camera.height_px, options.rate_hz, Encoder::Kind::Video, 22);
  Encoder matte(folder / "matte.mkv", camera.width_px, camera.height_px, options.rate_hz, Encoder::Kind::Matte, 0);
  for (int i = range.first; i < std::min(range.last, frames_in_all); ++i) {
    const PasserBy walker = passer_by.render(i, options);
    cv::Mat3f light(empty.size());
    cv::Mat1b alpha(empty.size());
    const float level = light_at(i / options.rate_hz);
    for (int y = 0; y < light.rows; ++y) {
      for (int x = 0; x < light.cols; ++x) {
        const float a = walker.alpha(y, x);
        light(y, x) = level * (walker.light(y, x) + (1 - a) * walker.shadow(y, x) * empty(y, x));
        alpha(y, x) = cv::saturate_cast<uchar>(255 * a);
      }
    }
    video.write(to_yuv420(develop(light, film, i)));
    matte.write(alpha);
    std::fprintf(stderr, "\rtripod %d/%d", i + 1, frames_in_all);
  }
  std::fputc('\n', stderr);
  video.finish();
  matte.finish();
}

}  // namespace rinkaku::recordings

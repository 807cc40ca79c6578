#include "recordings/generator/shot.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "pipeline/frame/error.h"
#include "recordings/generator/parallel.h"
#include "recordings/generator/random.h"

namespace rinkaku::recordings {

LensRays::LensRays(const CameraModel& camera)
    : width_(camera.width_px + 2 * margin), height_(camera.height_px + 2 * margin) {
  nodes_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  const double limit = max_undistorted_radius(camera);
  parallel_for(height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      const auto ray = undistort(camera, to_normalised(camera, {x - margin, y - margin}), limit);
      if (!ray) throw runtime_failure("lens", "does not see the whole picture", "use weaker distortion");
      nodes_[static_cast<std::size_t>(y * width_ + x)] = glm::vec2(*ray);
    }
  });
}

glm::vec2 LensRays::at(float x_px, float y_px) const {
  const float x = std::clamp(x_px + margin, 0.0f, static_cast<float>(width_) - 1.001f);
  const float y = std::clamp(y_px + margin, 0.0f, static_cast<float>(height_) - 1.001f);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const glm::vec2* row = nodes_.data() + static_cast<std::ptrdiff_t>(y0) * width_ + x0;
  return (1 - fy) * ((1 - fx) * row[0] + fx * row[1]) + fy * ((1 - fx) * row[width_] + fx * row[width_ + 1]);
}

cv::Mat3f render(const Room& room, const CameraModel& camera, const LensRays& rays, const Path& path,
                 const ShotOptions& options, int frame) {
  const double time = frame / options.rate_hz;
  struct Eye {
    glm::mat3 rotation;
    glm::vec3 position;
  };
  std::vector<Eye> eyes;
  for (int i = 0; i < options.samples; ++i) {
    const RigidTransform pose = path(time + ((i + 0.5) / options.samples - 0.5) * options.exposure_s);
    eyes.push_back({glm::mat3(glm::mat3_cast(pose.rotation)), glm::vec3(pose.translation_m)});
  }
  const Eye& middle = eyes[eyes.size() / 2];

  cv::Mat3f picture(camera.height_px, camera.width_px);
  constexpr int tile = 16;
  const int tiles_x = (camera.width_px + tile - 1) / tile, tiles_y = (camera.height_px + tile - 1) / tile;
  parallel_for(tiles_x * tiles_y, [&](int index) {
    const int x0 = index % tiles_x * tile, y0 = index / tiles_x * tile;
    const auto ray = [&](float x, float y) { return glm::normalize(glm::vec3(rays.at(x, y), 1)); };
    const glm::vec3 axis = ray(static_cast<float>(x0) + 0.5f * tile, static_cast<float>(y0) + 0.5f * tile);
    float reach = 0;
    for (const int corner : {0, 1, 2, 3}) {
      const glm::vec3 r = ray(static_cast<float>(x0 + corner % 2 * tile), static_cast<float>(y0 + corner / 2 * tile));
      reach = std::max(reach, std::acos(std::min(1.0f, glm::dot(r, axis))));
    }
    // 0.03 rad more for motion during the exposure and for the lens' blur.
    const auto candidates = room.inside_cone(middle.position, middle.rotation * axis, reach + 0.03f);
    for (int y = y0; y < std::min(y0 + tile, camera.height_px); ++y) {
      for (int x = x0; x < std::min(x0 + tile, camera.width_px); ++x) {
        const std::uint32_t ux = static_cast<std::uint32_t>(x), uy = static_cast<std::uint32_t>(y);
        const std::uint32_t uf = static_cast<std::uint32_t>(frame);
        const glm::vec2 shift(uniform({ux, uy, uf, 11}), uniform({ux, uy, uf, 12}));
        const glm::vec2 lens_shift(uniform({ux, uy, uf, 13}), uniform({ux, uy, uf, 14}));
        glm::vec3 sum(0);
        for (int i = 0; i < options.samples; ++i) {
          const glm::vec2 spread = options.softness_px * gaussian(low_discrepancy(i, shift));
          const glm::vec3 through(rays.at(static_cast<float>(x) + spread.x, static_cast<float>(y) + spread.y), 1);
          // Neighbouring samples of the sequence lie far apart on the lens as well.
          const glm::vec2 u = low_discrepancy(i * 5 % options.samples, lens_shift);
          const float r = options.lens_radius_m * std::sqrt(u.x), a = 6.2831853f * u.y;
          const glm::vec3 on_lens(r * std::cos(a), r * std::sin(a), 0);
          const Eye& eye = eyes[static_cast<std::size_t>(i)];
          const glm::vec3 origin = eye.position + eye.rotation * on_lens;
          const glm::vec3 direction = glm::normalize(eye.rotation * (through * options.focus_m - on_lens));
          sum += room.shade(room.trace(origin, direction, &candidates), direction);
        }
        sum /= static_cast<float>(options.samples);
        picture(y, x) = {sum.x, sum.y, sum.z};
      }
    }
  });
  return picture;
}

RigidTransform look_at(glm::dvec3 position, glm::dvec3 target, double roll) {
  const glm::dvec3 z = glm::normalize(target - position);
  const glm::dvec3 x = glm::normalize(glm::cross(z, glm::dvec3(0, 0, 1))), y = glm::cross(z, x);
  const glm::dquat level = glm::normalize(glm::quat_cast(glm::dmat3(x, y, z)));
  return {glm::normalize(level * glm::angleAxis(roll, glm::dvec3(0, 0, 1))), position};
}

void write_camera(const std::string& file, const CameraModel& camera) {
  cv::FileStorage out(file, cv::FileStorage::WRITE);
  if (!out.isOpened()) throw runtime_failure(file, "could not be written", "check the folder");
  out << "image_width" << camera.width_px << "image_height" << camera.height_px;
  out << "camera_matrix" << cv::Mat(cv::Matx33d(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1));
  const auto& k = camera.distortion;
  out << "distortion_coefficients" << cv::Mat(cv::Matx<double, 1, 5>(k[0], k[1], k[2], k[3], k[4]));
}

void write_poses(const std::string& file, const Path& path, int frames, double rate_hz) {
  std::ostringstream out;
  out << "frame,time_s,tx,ty,tz,qx,qy,qz,qw\n" << std::fixed;
  for (int i = 0; i < frames; ++i) {
    const RigidTransform pose = path(i / rate_hz);
    const auto& [q, t] = pose;
    out << i << std::setprecision(6) << ',' << i / rate_hz << std::setprecision(9);
    for (const double v : {t.x, t.y, t.z, q.x, q.y, q.z, q.w}) out << ',' << v;
    out << '\n';
  }
  write_text(file, out.str());
}

void write_text(const std::string& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  if (!out.write(text.data(), static_cast<std::streamsize>(text.size()))) {
    throw runtime_failure(file, "could not be written", "check the folder and the free space");
  }
}

}  // namespace rinkaku::recordings

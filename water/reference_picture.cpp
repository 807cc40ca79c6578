#include "water/reference_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rinkaku::water {
namespace {

// Bilinear at a place in texels, the nearest texel beyond the border.
glm::vec4 texel(const Picture& picture, double x, double y, bool around = false) {
  const int w = picture.width_px, h = picture.height_px;
  y = std::clamp(y, 0.0, h - 1.0);
  if (!around) x = std::clamp(x, 0.0, w - 1.0);
  const double fx = std::floor(x), fy = std::floor(y);
  const auto column = [&](int i) { return around ? ((i % w) + w) % w : std::min(i, w - 1); };
  const int x0 = column(static_cast<int>(fx)), x1 = column(static_cast<int>(fx) + 1);
  const int y0 = static_cast<int>(fy), y1 = std::min(y0 + 1, h - 1);
  const auto sample = [&](int i, int j) {
    const std::uint8_t* s = picture.samples.data() + (static_cast<std::size_t>(j) * w + i) * picture.channels;
    return glm::vec4(s[0], s[1], s[2], picture.channels == 4 ? s[3] : 255) / 255.0f;
  };
  const auto tx = static_cast<float>(x - fx), ty = static_cast<float>(y - fy);
  return glm::mix(glm::mix(sample(x0, y0), sample(x1, y0), tx), glm::mix(sample(x0, y1), sample(x1, y1), tx), ty);
}

glm::vec3 sky_colour(const Sky& sky, const glm::dvec3& direction) {
  const double up = std::clamp(direction.z, -1.0, 1.0);
  if (sky.panorama.empty()) return glm::mix(sky.horizon, sky.zenith, static_cast<float>(std::sqrt(std::max(up, 0.0))));
  const double turn = std::atan2(direction.x, direction.y) / (2 * std::numbers::pi);
  const double tilt = std::asin(up) / std::numbers::pi;
  return glm::vec3(texel(sky.panorama, (0.5 + turn) * sky.panorama.width_px - 0.5,
                         (0.5 - tilt) * sky.panorama.height_px - 0.5, true));
}

struct Eye {
  const CameraModel& camera;
  const RigidTransform& camera_from_world;
  glm::dvec3 position;
  double most_radius;
};

// What is filmed in a direction from a point on the water, and how much it is to be believed there (1 in the picture, 0
// far from it).
glm::vec4 filmed(const Eye& eye, const Picture& plate, double surroundings_m, const glm::dvec3& from,
                 const glm::dvec3& direction) {
  // Where the ray leaves the sphere around the camera.
  const glm::dvec3 offset = from - eye.position;
  const double b = glm::dot(offset, direction), c = glm::dot(offset, offset) - surroundings_m * surroundings_m;
  const double under = b * b - c;
  const double along = c < 0 ? -b + std::sqrt(under) : surroundings_m;
  const glm::dvec3 seen = eye.camera_from_world * (from + direction * along);
  if (!(seen.z > 1e-3)) return glm::vec4(0);
  glm::dvec2 n(seen.x / seen.z, seen.y / seen.z);
  const double radius = glm::length(n);
  if (radius > eye.most_radius) n *= eye.most_radius / radius;
  const glm::dvec2 pixel = to_pixels(eye.camera, distort(eye.camera, n));
  const double w = eye.camera.width_px, h = eye.camera.height_px;
  const double x = (pixel.x + 0.5) / w, y = (pixel.y + 0.5) / h;  // 0 to 1 in the picture
  const double beyond = std::max({0.0, -x, x - 1, -y, y - 1});
  const glm::vec4 colour = texel(plate, x * plate.width_px - 0.5, y * plate.height_px - 0.5);
  const auto trust = static_cast<float>(std::clamp(1 - beyond / 0.6, 0.0, 1.0));
  return {glm::vec3(colour), trust};
}

}  // namespace

void ReferencePicture::paint(const Surface& surface, const CameraModel& camera, const RigidTransform& camera_from_world,
                             const MirrorOptions& options, const Picture* plate, const Picture* mirrored,
                             int mirrored_step_px, int step_px) {
  step_px_ = step_px;
  ++version_;
  width_px_ = (camera.width_px + step_px - 1) / step_px + 1;
  height_px_ = (camera.height_px + step_px - 1) / step_px + 1;
  samples_.resize(static_cast<std::size_t>(width_px_) * height_px_);
  const RigidTransform world_from_camera = inverse(camera_from_world);
  const Eye eye{camera, camera_from_world, world_from_camera.translation_m, 1e9};
  const glm::dvec3& n = surface.normal();
  const double height = surface.height_m(eye.position);
  for (int j = 0; j < height_px_; ++j) {
    for (int i = 0; i < width_px_; ++i) {
      const double x = static_cast<double>(i) * step_px, y = static_cast<double>(j) * step_px;
      const glm::dvec3 ray =
          glm::normalize(world_from_camera.rotation * glm::dvec3(to_normalised(camera, {x, y}), 1.0));
      // From the water's side that the eye is on; above the horizon the water is taken to go on for ever.
      double falls = glm::dot(ray, n) * (height < 0 ? 1 : -1);
      glm::dvec3 away = ray - 2.0 * glm::dot(ray, n) * n;
      if (falls < 0) away = ray, falls = 0;
      const double far = falls > 1e-4 ? std::min(std::abs(height) / falls, 1e4) : 1e4;
      const glm::dvec3 hit = eye.position + ray * far;
      glm::vec3 seen = sky_colour(options.sky, away);
      if (options.plate && plate != nullptr) {
        const glm::vec4 film = filmed(eye, *plate, options.surroundings_m, hit, away);
        seen = glm::mix(seen, glm::vec3(film), film.a);
      }
      if (mirrored != nullptr && !mirrored->empty()) {
        const glm::vec4 object = texel(*mirrored, mirrored->width_px - 1 - x / mirrored_step_px, y / mirrored_step_px);
        seen = glm::vec3(object) + seen * (1 - object.a);
      }
      const double grazing = 1 - std::min(falls, 1.0);
      const auto share = static_cast<float>(options.reflection * (0.35 + 0.65 * grazing * grazing));
      samples_[static_cast<std::size_t>(j) * width_px_ + i] =
          glm::clamp(glm::mix(options.water_colour, seen * static_cast<float>(options.gain), share), 0.0f, 1.0f);
    }
  }
}

void ReferencePicture::mix(std::span<const ReferencePicture* const> pictures, std::span<const float> weights) {
  ++version_;
  width_px_ = pictures[0]->width_px_, height_px_ = pictures[0]->height_px_, step_px_ = pictures[0]->step_px_;
  samples_.assign(pictures[0]->samples_.size(), glm::vec3(0));
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const glm::vec3* from = pictures[k]->samples_.data();
    for (std::size_t i = 0; i < samples_.size(); ++i) samples_[i] += from[i] * weights[k];
  }
}

glm::vec3 ReferencePicture::at(glm::dvec2 pixel) const {
  const double x = std::clamp(pixel.x / step_px_, 0.0, width_px_ - 1.001);
  const double y = std::clamp(pixel.y / step_px_, 0.0, height_px_ - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const auto fx = static_cast<float>(x - i), fy = static_cast<float>(y - j);
  const glm::vec3* s = samples_.data() + static_cast<std::size_t>(j) * width_px_ + i;
  return (s[0] * (1 - fx) + s[1] * fx) * (1 - fy) + (s[width_px_] * (1 - fx) + s[width_px_ + 1] * fx) * fy;
}

MirroredEye mirrored_eye(const Surface& surface, const CameraModel& camera, const RigidTransform& camera_from_world) {
  // Mirroring the world at the surface and the picture at its vertical axis is a rigid motion again.
  const glm::dmat3 turn = glm::mat3_cast(camera_from_world.rotation);
  const glm::dvec3& n = surface.normal();
  const glm::dmat3 mirror = glm::dmat3(1) - 2.0 * glm::outerProduct(n, n);
  glm::dmat3 turned = turn * mirror;
  for (int c = 0; c < 3; ++c) turned[c].x = -turned[c].x;
  const glm::dvec3 eye = inverse(camera_from_world).translation_m;
  const glm::dvec3 behind = eye - 2.0 * surface.height_m(eye) * n;
  MirroredEye m{camera, {glm::normalize(glm::quat_cast(turned)), {}}};
  m.camera_from_world.translation_m = -(m.camera_from_world.rotation * behind);
  m.camera.cx_px = camera.width_px - 1 - camera.cx_px;
  return m;
}

CameraModel smaller(const CameraModel& camera, int step_px) {
  CameraModel s = camera;
  // Pixel i of the small picture stands at pixel i * step of the large one.
  s.width_px = (camera.width_px + step_px - 1) / step_px + 1;
  s.height_px = (camera.height_px + step_px - 1) / step_px + 1;
  s.fx_px /= step_px, s.fy_px /= step_px, s.cx_px /= step_px, s.cy_px /= step_px;
  s.distortion = {};
  return s;
}

}  // namespace rinkaku::water

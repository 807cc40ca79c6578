#include "water/stroke_size.h"

#include <algorithm>
#include <cmath>

namespace rinkaku::water {

double stroke_length_px(const StrokeSize& size, double focal_px, double depth_m) {
  return std::clamp(focal_px * size.length_m / depth_m, size.least_px, size.most_px);
}

double stroke_width_px(const StrokeSize& size, double length_px) {
  return size.width_px > 0 ? size.width_px : std::max(size.width * length_px, 1.5);
}

StrokeDensity::StrokeDensity(const Surface& surface, const std::optional<Outlook>& outlook, const StrokeSize& size)
    : outlook_(outlook), size_(size) {
  if (!outlook_) return;
  const RigidTransform& camera = outlook_->camera_from_world;
  origin_ = camera * surface.to_world({0, 0});
  along_x_ = camera * surface.to_world({1, 0}) - origin_;
  along_y_ = camera * surface.to_world({0, 1}) - origin_;
}

StrokeDensity::Seen StrokeDensity::seen(glm::dvec2 p) const {
  const glm::dvec3 c = origin_ + along_x_ * p.x + along_y_ * p.y;
  const CameraModel& camera = outlook_->camera;
  if (!(c.z > 0.01)) return {};
  const double x = c.x / c.z, y = c.y / c.z;
  const glm::dvec2 pixel = to_pixels(camera, {x, y});
  const double room_x = camera.width_px / 8.0, room_y = camera.height_px / 8.0;
  if (pixel.x < -room_x || pixel.y < -room_y || pixel.x > camera.width_px + room_x ||
      pixel.y > camera.height_px + room_y) {
    return {};
  }
  // The determinant of the pixel's derivative.
  const glm::dvec2 dx((along_x_.x - x * along_x_.z) / c.z, (along_x_.y - y * along_x_.z) / c.z);
  const glm::dvec2 dy((along_y_.x - x * along_y_.z) / c.z, (along_y_.y - y * along_y_.z) / c.z);
  return {c.z, std::abs(dx.x * dy.y - dx.y * dy.x) * camera.fx_px * camera.fy_px};
}

double StrokeDensity::pixels_per_m2(glm::dvec2 p) const { return outlook_ ? seen(p).pixels_per_m2 : 0; }

double StrokeDensity::at(glm::dvec2 p) const {
  if (!outlook_) return 1;
  const Seen s = seen(p);
  if (!(s.pixels_per_m2 > 0)) return 0;
  const double length = stroke_length_px(size_, outlook_->camera.fx_px, s.depth_m);
  return s.pixels_per_m2 / (length * stroke_width_px(size_, length));
}

namespace {

// The sum of a function over the surface, by squares.
template <typename Function>
double integral(const Surface& surface, const Function& function) {
  constexpr int across = 128;
  const glm::dvec2 span = surface.most() - surface.least();
  double sum = 0;
  for (int y = 0; y < across; ++y) {
    for (int x = 0; x < across; ++x) {
      const glm::dvec2 p = surface.least() + span * (glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(across));
      if (surface.contains(p)) sum += function(p);
    }
  }
  return sum * span.x * span.y / (across * across);
}

}  // namespace

double seen_size(const Surface& surface, const std::optional<Outlook>& outlook) {
  if (!outlook) return surface.area_m2();
  const StrokeDensity density(surface, outlook, {});
  return integral(surface, [&](glm::dvec2 p) { return density.pixels_per_m2(p); });
}

double covering_length_m(const Surface& surface, const std::optional<Outlook>& outlook, StrokeSize size, int strokes,
                         double layers) {
  if (!outlook) return std::sqrt(layers * surface.area_m2() / (strokes * size.width));
  const auto needed = [&](double length_m) {  // strokes for one layer
    size.length_m = length_m;
    const StrokeDensity density(surface, outlook, size);
    return integral(surface, [&](glm::dvec2 p) { return density.at(p); });
  };
  double least = 1e-6, most = 1e6;
  for (int i = 0; i < 48; ++i) {
    const double middle = std::sqrt(least * most);
    (needed(middle) * layers > strokes ? least : most) = middle;
  }
  return std::sqrt(least * most);
}

}  // namespace rinkaku::water

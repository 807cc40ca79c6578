#include "water/waterline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "water/brushes.h"
#include "water/scatter.h"

namespace rinkaku::water {
namespace {

std::array<std::uint8_t, 4> coded(const std::array<double, 3>& colour, double lighter, double opacity) {
  std::array<std::uint8_t, 4> c{};
  for (int i = 0; i < 3; ++i)
    c[i] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(colour[i] + lighter, 0.0, 1.0)));
  c[3] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(opacity, 0.0, 1.0)));
  return c;
}

// A number from -1 to 1 that comes back every so many seconds.
double swing(double seconds, double period_s, double phase) {
  return std::sin(2 * std::numbers::pi * (seconds / period_s + phase));
}

}  // namespace

Waterline::Waterline(const Surface& surface, std::span<const Segment> bodies, const WaterlineOptions& options)
    : options_(options) {
  const double spacing_m = 0.3 * options.size.length_m;
  std::vector<Segment> shores;
  for (const BorderEdge& e : surface.edges()) {
    if (!e.open) shores.push_back({e.a, e.b});
  }
  add_spots(surface, shores, spacing_m);
  add_spots(surface, bodies, spacing_m);
}

void Waterline::add_spots(const Surface& surface, std::span<const Segment> segments, double spacing_m) {
  // However many there are asked for: more than this no picture shows.
  double length = 0;
  for (const Segment& s : segments) length += glm::distance(s.a, s.b);
  constexpr double most = 20000;
  spacing_m = std::max(spacing_m, length / most);
  double next = spacing_m / 2;
  for (const Segment& s : segments) {
    const double l = glm::distance(s.a, s.b);
    if (!(l > 0)) continue;
    const glm::dvec3 a = surface.to_world(s.a), b = surface.to_world(s.b);
    for (; next < l; next += spacing_m) {
      const auto serial = static_cast<std::uint32_t>(spots_.size());
      spots_.push_back({a + (b - a) * (next / l), (b - a) / l, serial});
    }
    next -= l;
  }
}

void Waterline::add(std::int64_t frame, const CameraModel& camera, const RigidTransform& camera_from_world,
                    Strokes& strokes) const {
  const double seconds = static_cast<double>(frame) / options_.frames_per_s;
  for (const Spot& spot : spots_) {
    const auto random = [&](std::uint64_t purpose) { return scattered(spot.serial, 200 + purpose); };
    const double period_s = 3 + 3 * random(0);
    const double swell = swing(seconds, period_s, random(1));
    const glm::dvec3 c = camera_from_world * spot.at;
    if (!(c.z > 0.02)) continue;
    const glm::dvec3 along = camera_from_world.rotation * spot.along;
    const glm::dvec2 n(c.x / c.z, c.y / c.z);
    const glm::dvec2 direction(along.x - n.x * along.z, along.y - n.y * along.z);
    const double shortened = std::min(glm::length(direction), 1.0);
    if (!(shortened > 1e-6)) continue;
    const double full = stroke_length_px(options_.size, camera.fx_px, c.z);
    const double length = full * (0.5 + 0.6 * random(2)) * std::max(shortened, 0.4) * (1 + 0.1 * swell);
    const double width = std::max(stroke_width_px(options_.size, full) * (0.16 + 0.26 * random(3)), 1.1);
    Stroke s;
    s.middle_px = to_pixels(camera, n);
    s.half_px = direction / glm::length(direction) * (length / 2);
    s.half_width_px = static_cast<float>(width / 2);
    s.brush = static_cast<float>((brush_densities - 1) * brush_variants + static_cast<int>(random(4) * brush_variants));
    s.depth_m = static_cast<float>(c.z);
    s.colour = coded(options_.colour, 0.06 * (2 * random(5) - 1), 0.45 + 0.3 * random(6) + 0.2 * swell);
    strokes.push_back(s);
  }
}

void add_spray(const SprayOptions& o, std::int64_t frame, const CameraModel& camera,
               const RigidTransform& camera_from_world, Strokes& drops) {
  const double seconds = static_cast<double>(frame) / o.frames_per_s;
  for (int i = 0; i < o.drops; ++i) {
    const auto drop = static_cast<std::uint64_t>(i);
    const double life_s = 1.3 + 0.9 * scattered(drop, 300);
    const double lives = seconds / life_s + scattered(drop, 301);
    const double age = lives - std::floor(lives);
    const std::uint64_t life = drop * 1'000'003u + static_cast<std::uint64_t>(lives);
    const auto random = [&](std::uint64_t purpose) { return scattered(life, 310 + purpose); };
    // A thrown stone's way, up and part of the way down.
    const double height = o.height_m * (0.25 + 0.75 * random(0) * random(1));
    const double rise = height * (1 - std::pow(1 - 1.5 * age, 2));
    const double drift = 0.5 * height * age;
    glm::dvec3 at = o.from_m + (o.to_m - o.from_m) * random(2);
    const double angle = 2 * std::numbers::pi * random(3);
    at += glm::dvec3(drift * std::cos(angle), drift * std::sin(angle), rise);
    const glm::dvec3 c = camera_from_world * at;
    if (!(c.z > 0.02)) continue;
    // It comes and goes over four tenths of its life: a twelfth a frame or less at 24 frames a second.
    const double opacity = 0.75 * std::min({age / 0.4, (1 - age) / 0.4, 1.0});
    const double size_px = camera.fx_px * o.size_m * (0.5 + 0.8 * random(4)) * (0.7 + 0.6 * age) / c.z;
    Stroke s;
    s.middle_px = to_pixels(camera, {c.x / c.z, c.y / c.z});
    const double turn = 2 * std::numbers::pi * random(5);
    s.half_px = glm::vec2(std::cos(turn), std::sin(turn)) * static_cast<float>(size_px / 2);
    s.half_width_px = static_cast<float>(size_px / 2);
    s.brush = static_cast<float>(static_cast<int>(random(6) * brush_variants));
    s.depth_m = static_cast<float>(c.z);
    s.colour = coded(o.colour, 0.05 * (2 * random(7) - 1), opacity);
    drops.push_back(s);
  }
}

}  // namespace rinkaku::water

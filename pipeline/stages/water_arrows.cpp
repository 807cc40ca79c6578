#include "pipeline/stages/water_arrows.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "pipeline/stages/water_set_up.h"

namespace rinkaku::pipeline {
namespace {

// Nearer to the eye than this a point's pixel says nothing any more.
constexpr double nearest_m = 0.01;

std::optional<glm::dvec2> pixel(const CameraModel& camera, const RigidTransform& camera_from_world,
                                const glm::dvec3& point_m) {
  const glm::dvec3 c = camera_from_world * point_m;
  if (!(c.z > nearest_m)) return std::nullopt;
  return to_pixels(camera, distort(camera, {c.x / c.z, c.y / c.z}));
}

}  // namespace

struct WaterArrows::Parts {
  Parts(const Scene& scene, const CameraModel& c, double rate)
      : camera(c), radius(c.has_distortion() ? max_undistorted_radius(c) : 0), frames_per_s(rate), poses(scene) {
    for (const WaterSurfaceScene& one : scene.water->surfaces) {
      surfaces.push_back(make_surface(one, poses, frames_per_s));
      keys.push_back(make_arrows(one, surfaces.back(), camera, poses, frames_per_s));
    }
  }

  std::optional<glm::dvec2> without_lens(glm::dvec2 pixel_px) const {
    if (!camera.has_distortion()) return pixel_px;
    const auto n = undistort(camera, to_normalised(camera, pixel_px), radius);
    if (!n) return std::nullopt;
    return to_pixels(camera, *n);
  }

  CameraModel camera;
  double radius;  // within which the lens shows something
  double frames_per_s;
  KnownPoses poses;
  std::vector<water::Surface> surfaces;
  std::vector<std::vector<water::ArrowKey>> keys;  // of each surface
};

WaterArrows::WaterArrows(const Scene& scene, const CameraModel& camera, double frames_per_s)
    : parts_(std::make_unique<Parts>(scene, camera, frames_per_s)) {}
WaterArrows::~WaterArrows() = default;
WaterArrows::WaterArrows(WaterArrows&&) noexcept = default;
WaterArrows& WaterArrows::operator=(WaterArrows&&) noexcept = default;

std::vector<WaterArrows::Shown> WaterArrows::shown(std::int64_t frame, const RigidTransform& camera_from_world) const {
  std::vector<Shown> all;
  for (std::size_t s = 0; s < parts_->surfaces.size(); ++s) {
    const auto& keys = parts_->keys[s];
    if (keys.empty()) continue;
    const auto after =
        std::find_if(keys.begin(), keys.end(), [frame](const water::ArrowKey& k) { return k.frame > frame; });
    const water::ArrowKey& key = after == keys.begin() ? keys.front() : *(after - 1);
    for (std::size_t i = 0; i < key.arrows.size(); ++i) {
      const water::Arrow& arrow = key.arrows[i];
      const water::Surface& surface = parts_->surfaces[s];
      const auto from = pixel(parts_->camera, camera_from_world, surface.to_world(arrow.at));
      const auto to = pixel(parts_->camera, camera_from_world, surface.to_world(arrow.at + arrow.velocity));
      if (from && to) all.push_back({s, i, key.frame, *from, *to});
    }
  }
  return all;
}

std::optional<WaterArrows::Placed> WaterArrows::placed(const RigidTransform& camera_from_world, glm::dvec2 from_px,
                                                       glm::dvec2 to_px, std::optional<std::size_t> surface) const {
  const auto from = parts_->without_lens(from_px), to = parts_->without_lens(to_px);
  if (!from || !to) return std::nullopt;
  std::optional<Placed> nearest;
  double nearest_z = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < parts_->surfaces.size(); ++s) {
    if (surface && *surface != s) continue;
    const water::Surface& water = parts_->surfaces[s];
    const water::SeenPoint begin = water::back_projected(water, parts_->camera, camera_from_world, *from);
    const water::SeenPoint end = water::back_projected(water, parts_->camera, camera_from_world, *to);
    // An arrow that is moved may be let go beside the water; a new one begins on it.
    if (!begin.found || !end.found || (!surface && !water.contains(begin.at))) continue;
    const glm::dvec3 at = water.to_world(begin.at);
    const double z = (camera_from_world * at).z;
    if (z >= nearest_z) continue;
    nearest_z = z;
    nearest = Placed{s, at, water.to_world(end.at)};
  }
  return nearest;
}

std::optional<glm::dvec2> WaterArrows::pixel_at(std::int64_t frame, const glm::dvec3& point_m) const {
  const auto pose = parts_->poses.at(frame, parts_->frames_per_s);
  if (!pose) return std::nullopt;
  return pixel(parts_->camera, *pose, point_m);
}

}  // namespace rinkaku::pipeline

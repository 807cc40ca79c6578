#include "pipeline/matte/foot_point.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rinkaku::matte {
namespace {

// The middle of the lowest row below which no more than a thousandth of the thing lies.
std::optional<glm::dvec2> lowest_px(const Matte& matte) {
  std::int64_t all = 0;
  for (int y = matte.rect.y_px; y < matte.rect.bottom_px(); ++y) {
    const std::uint8_t* row = matte.alpha_row(y);
    for (int x = matte.rect.x_px; x < matte.rect.right_px(); ++x) all += row[x] > 127 ? 1 : 0;
  }
  if (all == 0) return std::nullopt;
  std::int64_t below = 0;
  for (int y = matte.rect.bottom_px() - 1; y >= matte.rect.y_px; --y) {
    const std::uint8_t* row = matte.alpha_row(y);
    std::int64_t here = 0, sum_x = 0;
    for (int x = matte.rect.x_px; x < matte.rect.right_px(); ++x) {
      if (row[x] <= 127) continue;
      ++here;
      sum_x += x;
    }
    below += here;
    if (here > 0 && below * 1000 >= all) {
      // The thing ends half a pixel below the middle of its last row.
      return glm::dvec2(static_cast<double>(sum_x) / static_cast<double>(here), y + 0.5);
    }
  }
  return std::nullopt;
}

double median(std::array<double, 5> values, int count) {
  std::sort(values.begin(), values.begin() + count);
  return values[static_cast<std::size_t>(count / 2)];
}

}  // namespace

double FootPoint::steady(double depth_m) {
  if (count_ == kept) {
    std::rotate(last_m_.begin(), last_m_.begin() + 1, last_m_.end());
    --count_;
  }
  last_m_[static_cast<std::size_t>(count_++)] = depth_m;
  if (count_ < 3) return depth_m;
  std::array<double, kept> speeds{}, now{};
  for (int i = 0; i + 1 < count_; ++i) {
    const auto at = static_cast<std::size_t>(i);
    speeds[at] = last_m_[at + 1] - last_m_[at];
  }
  const double speed = median(speeds, count_ - 1);
  for (int i = 0; i < count_; ++i) {
    const auto at = static_cast<std::size_t>(i);
    now[at] = last_m_[at] + speed * (count_ - 1 - i);
  }
  return median(now, count_);
}

std::optional<double> FootPoint::distance_m(const Matte& matte, const CameraModel& camera,
                                            const RigidTransform& camera_from_world) {
  if (max_radius_ < 0) max_radius_ = max_undistorted_radius(camera);
  const auto pixel = lowest_px(matte);
  if (!pixel) {
    count_ = 0;
    return std::nullopt;
  }
  const auto straight = undistort(camera, to_normalised(camera, *pixel), max_radius_);
  if (!straight) return std::nullopt;
  const RigidTransform world_from_camera = inverse(camera_from_world);
  const glm::dvec3 along = world_from_camera.rotation * glm::dvec3(straight->x, straight->y, 1);
  const double depth = -world_from_camera.translation_m.z / along.z;
  if (!(depth > 0) || !std::isfinite(depth)) return std::nullopt;
  return steady(depth);
}

}  // namespace rinkaku::matte

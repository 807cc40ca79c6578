#include "outline/fluffy/cutter.h"

#include <cassert>
#include <numeric>

namespace rinkaku::fluffy {

Cutter::Cutter(const Frame& frame, const CutOptions& options) : method_(options.method) {
  triangles_.resize(frame.triangles.size());
  std::iota(triangles_.begin(), triangles_.end(), 0u);
  if (method_ == CutMethod::Exact || method_ == CutMethod::Regions) exact_.emplace(by_corners(frame), options.sine);
  if (method_ == CutMethod::Regions) lists_.emplace(by_corners(frame), options.sine, options.regions);
  if (method_ == CutMethod::Nearest) nearest_.emplace(by_faces(frame), options.sine, options.candidates);
}

std::span<const std::uint32_t> Cutter::find(const glm::dvec3& eye) {
  if (lists_) {
    const std::optional<std::uint32_t> region = lists_->region(eye);
    if (!region) return exact_->find(eye);
    if (region != region_) lists_->list(*region, triangles_);
    region_ = region;
  } else if (exact_) {
    return exact_->find(eye);
  } else if (nearest_) {
    return nearest_->list(eye);
  }
  return triangles_;
}

void Cutter::move(const Frame& frame) {
  assert(method_ == CutMethod::Exact || method_ == CutMethod::None);
  if (exact_) exact_->move(frame.points, frame.normals);
}

}  // namespace rinkaku::fluffy

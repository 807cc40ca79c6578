#include "silhouette/front_view.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

namespace rinkaku::silhouette {

void FrontView::set(const glm::dvec3& eye, std::span<const FrontFace> front) {
  eye_ = eye;
  edge_ = 1 / std::sqrt(glm::dot(eye, eye) - 1);
  forward_ = -glm::normalize(eye);
  const glm::dvec3 aside = std::abs(forward_.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  right_ = glm::normalize(glm::cross(forward_, aside));
  up_ = glm::cross(right_, forward_);
  placed_.clear();
  for (const FrontFace& f : front) {
    placed_.push_back({f.face, {project(f.corners[0]), project(f.corners[1]), project(f.corners[2])}});
  }
  cell_first_.assign(kCells * kCells + 1, 0);
  for (const Placed& p : placed_) for_each_cell(p, [&](int cell) { ++cell_first_[cell + 1]; });
  std::partial_sum(cell_first_.begin(), cell_first_.end(), cell_first_.begin());
  cell_items_.resize(cell_first_.back());
  next_.assign(cell_first_.begin(), cell_first_.end() - 1);
  for (std::uint32_t i = 0; i < placed_.size(); ++i) {
    for_each_cell(placed_[i], [&](int cell) { cell_items_[next_[cell]++] = i; });
  }
}

glm::dvec2 FrontView::project(const glm::dvec3& p) const {
  const glm::dvec3 d = p - eye_;
  const double depth = glm::dot(forward_, d);
  return {glm::dot(right_, d) / depth, glm::dot(up_, d) / depth};
}

int FrontView::cell_of(double along) const {
  return std::clamp(static_cast<int>((along / edge_ + 1) * 0.5 * kCells), 0, kCells - 1);
}

bool FrontView::covers(const Placed& placed, const glm::dvec2& p) {
  const auto left_of = [&p](const glm::dvec2& a, const glm::dvec2& b) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0;
  };
  const auto& c = placed.corners;
  return left_of(c[0], c[1]) && left_of(c[1], c[2]) && left_of(c[2], c[0]);
}

template <typename Visit>
void FrontView::for_each_cell(const Placed& placed, const Visit& visit) const {
  const auto& c = placed.corners;
  const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [low, high] = std::minmax({c[0].y, c[1].y, c[2].y});
  for (int row = cell_of(low); row <= cell_of(high); ++row) {
    for (int column = cell_of(left); column <= cell_of(right); ++column) visit(row * kCells + column);
  }
}

}  // namespace rinkaku::silhouette

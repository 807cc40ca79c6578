#include "outline/curvature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rinkaku::outline {
namespace {

// In units of scaled points.
constexpr float kSharpest = 1e7f;

float finite(double value) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -most, most));
}

}  // namespace

CurvatureSolver::CurvatureSolver(const mesh::Topology& topology, CurvatureMethod method)
    : stars_(face_stars(topology)),
      method_(method),
      rest_scale_(std::min(curvature_scale(stars_, topology.points), 0x1p127)),
      corrected_(stars_) {
  const std::size_t count = stars_.point_count();
  if (method == CurvatureMethod::Meyer) meyer_.emplace(stars_);
  if (method == CurvatureMethod::Quadric) quadric_.emplace(stars_);
  if (method == CurvatureMethod::Auto) uneven_.emplace(stars_);
  scaled_.resize(count);
  values_.resize(count);
  for (auto* each :
       {&curvature_.mean, &curvature_.gauss, &curvature_.largest, &curvature_.smallest, &curvature_.area}) {
    each->resize(count);
  }
}

double curvature_scale(const FaceStars& stars, std::span<const glm::vec3> points) {
  glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (stars.first[p] == stars.first[p + 1]) continue;
    low = glm::vec3(std::min(low.x, points[p].x), std::min(low.y, points[p].y), std::min(low.z, points[p].z));
    high = glm::vec3(std::max(high.x, points[p].x), std::max(high.y, points[p].y), std::max(high.z, points[p].z));
  }
  const glm::dvec3 size = glm::dvec3(high) - glm::dvec3(low);
  const double largest = std::max({size.x, size.y, size.z});
  if (!(largest > 0)) return 0;
  return std::exp2(std::floor(std::log2(CorrectedCurvature::kSize / largest)));
}

double CurvatureSolver::scale_points(std::span<const glm::vec3> points) {
  const double scale = curvature_scale(stars_, points);
  // Beyond float's powers of two only where the object is smaller than any that can be told apart.
  const float factor = static_cast<float>(std::min(scale, 0x1p127));
  for (std::size_t p = 0; p < points.size(); ++p) scaled_[p] = glm::vec4(points[p] * factor, 0);
  return factor;
}

const Curvature& CurvatureSolver::solve(std::span<const glm::vec3> points) {
  const double scale = scale_points(points);
  if (meyer_) {
    meyer_->run(stars_, scaled_, values_);
  } else {
    corrected_.run(stars_, scaled_);
    const std::span<const Measures> measures = corrected_.measures();
    for (std::size_t p = 0; p < values_.size(); ++p) values_[p] = from_measures(measures[p]);
    if (quadric_) quadric_->run(scaled_, corrected_.normals(), values_);
    if (uneven_) uneven_->average(stars_, scaled_, corrected_.normals(), measures, values_);
  }
  finish(scale);
  return curvature_;
}

const Curvature& CurvatureSolver::solve_at(std::span<const glm::vec3> points, std::span<const std::uint32_t> wanted) {
  if (method_ != CurvatureMethod::Icnc || !(rest_scale_ > 0)) return solve(points);
  const auto factor = static_cast<float>(rest_scale_);
  corrected_.run_at(stars_, points, factor, wanted);
  const std::span<const Measures> measures = corrected_.measures();
  for (const std::uint32_t p : wanted) {
    values_[p] = from_measures(measures[p]);
    finish(factor, p);
  }
  return curvature_;
}

void CurvatureSolver::finish(double scale) {
  for (std::size_t p = 0; p < values_.size(); ++p) finish(scale, p);
}

void CurvatureSolver::finish(double scale, std::size_t p) {
  const double scale_sq = scale * scale;
  const float mean = std::clamp(values_[p].mean, -kSharpest, kSharpest);
  const float gauss = std::clamp(values_[p].gauss, -kSharpest * kSharpest, kSharpest * kSharpest);
  const float apart = std::sqrt(std::max(mean * mean - gauss, 0.0f));
  curvature_.mean[p] = finite(mean * scale);
  curvature_.gauss[p] = finite(gauss * scale_sq);
  curvature_.largest[p] = finite((mean + apart) * scale);
  curvature_.smallest[p] = finite((mean - apart) * scale);
  const double area = meyer_ ? meyer_->area(p) : corrected_.measures()[p].flat_area / 3;
  curvature_.area[p] = scale > 0 ? finite(area / scale_sq) : 0.0f;
}

Curvature curvature(const mesh::Topology& topology, CurvatureMethod method) {
  CurvatureSolver solver(topology, method);
  return solver.solve(topology.points);
}

double k95(const Curvature& curvature) {
  std::vector<std::uint32_t> order(curvature.mean.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto size = [&](std::uint32_t p) { return std::abs(curvature.mean[p]); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return size(a) < size(b); });
  const double total = std::accumulate(curvature.area.begin(), curvature.area.end(), 0.0);
  double below = 0;
  for (const std::uint32_t p : order) {
    below += curvature.area[p];
    if (below >= 0.95 * total) return size(p);
  }
  return 0;
}

}  // namespace rinkaku::outline

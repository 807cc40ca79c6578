#include "outline/line_width.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rinkaku::outline {
namespace {

float curvature_at(const Curvature& curvature, CurvatureKind kind, std::size_t p) {
  switch (kind) {
    case CurvatureKind::Mean:
      return curvature.mean[p];
    case CurvatureKind::Gauss:
      return std::copysign(std::sqrt(std::abs(curvature.gauss[p])), curvature.gauss[p]);
    case CurvatureKind::Largest:
      return curvature.largest[p];
    case CurvatureKind::Smallest:
      return curvature.smallest[p];
  }
  return 0;
}

// `bend`: the curvature in K95.
float factor(float bend, const WidthOptions& options) {
  float part = std::min(std::abs(bend) / options.saturation, 1.0f);
  if (options.curve != 1) part = std::pow(part, options.curve);
  const float thicker = 1 + options.exaggeration * part;
  const bool thins =
      (options.sign == CurvatureSign::Convex && bend < 0) || (options.sign == CurvatureSign::Concave && bend > 0);
  return thins ? std::max(options.least, 1 / thicker) : thicker;
}

void find_factors(const Curvature& curvature, double k95, const WidthOptions& options, std::vector<float>& factors) {
  for (std::size_t p = 0; p < factors.size(); ++p) {
    const double bend = curvature_at(curvature, options.kind, p) / k95;
    factors[p] = factor(static_cast<float>(std::clamp(bend, -1e30, 1e30)), options);
  }
}

// Each point's value becomes the mean of itself and its neighbours' mean.
void smooth(const mesh::Topology& topology, std::vector<float>& values, std::vector<float>& sums,
            const std::vector<std::uint32_t>& neighbours) {
  std::fill(sums.begin(), sums.end(), 0.0f);
  for (const mesh::Edge& edge : topology.edges) {
    sums[edge.a] += values[edge.b];
    sums[edge.b] += values[edge.a];
  }
  for (std::size_t p = 0; p < values.size(); ++p) {
    if (neighbours[p] > 0) values[p] = (values[p] + sums[p] / static_cast<float>(neighbours[p])) / 2;
  }
}

}  // namespace

std::vector<float> line_width_factors(const mesh::Topology& topology, const Curvature& curvature, double k95,
                                      const WidthOptions& options) {
  std::vector<float> factors(topology.points.size(), 1.0f);
  if (!(k95 > 0)) return factors;
  find_factors(curvature, k95, options, factors);
  std::vector<std::uint32_t> neighbours(factors.size(), 0);
  for (const mesh::Edge& edge : topology.edges) {
    ++neighbours[edge.a];
    ++neighbours[edge.b];
  }
  std::vector<float> sums(factors.size());
  for (int i = 0; i < options.smoothing; ++i) smooth(topology, factors, sums, neighbours);
  return factors;
}

CurvatureWidths::CurvatureWidths(const mesh::Topology& rest, const WidthOptions& options)
    : options_(options),
      solver_(rest),
      k95_(k95(solver_.solve(rest.points))),
      first_neighbour_(rest.points.size() + 1, 0),
      factors_(rest.points.size(), 1.0f),
      smoothed_(rest.points.size()) {
  for (const mesh::Edge& edge : rest.edges) {
    ++first_neighbour_[edge.a + 1];
    ++first_neighbour_[edge.b + 1];
  }
  for (std::size_t p = 0; p < factors_.size(); ++p) first_neighbour_[p + 1] += first_neighbour_[p];
  neighbours_.resize(rest.edges.size() * 2);
  std::vector<std::uint32_t> next(first_neighbour_.begin(), first_neighbour_.end() - 1);
  for (const mesh::Edge& edge : rest.edges) {
    neighbours_[next[edge.a]++] = edge.b;
    neighbours_[next[edge.b]++] = edge.a;
  }
}

std::span<const float> CurvatureWidths::at(std::span<const glm::vec3> points) {
  if (!(k95_ > 0)) return factors_;
  find_factors(solver_.solve(points), k95_, options_, factors_);
  for (int i = 0; i < options_.smoothing; ++i) smooth();
  return factors_;
}

void CurvatureWidths::smooth() {
  for (std::size_t p = 0; p < factors_.size(); ++p) {
    const std::uint32_t first = first_neighbour_[p], end = first_neighbour_[p + 1];
    float sum = 0;
    for (std::uint32_t i = first; i < end; ++i) sum += factors_[neighbours_[i]];
    smoothed_[p] = end > first ? (factors_[p] + sum / static_cast<float>(end - first)) / 2 : factors_[p];
  }
  factors_.swap(smoothed_);
}

}  // namespace rinkaku::outline

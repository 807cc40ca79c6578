#include "outline/line_width.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

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

float factor_at(std::size_t p, const Curvature& curvature, double k95, const WidthOptions& options) {
  const double bend = curvature_at(curvature, options.kind, p) / k95;
  return factor(static_cast<float>(std::clamp(bend, -1e30, 1e30)), options);
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
  for (std::size_t p = 0; p < factors.size(); ++p) factors[p] = factor_at(p, curvature, k95, options);
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
      smoothed_(rest.points.size()),
      all_(rest.points.size()),
      seen_at_(rest.points.size(), 0) {
  std::iota(all_.begin(), all_.end(), 0u);
  rings_.reserve(all_.size());
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
  const Curvature& curvature = solver_.solve(points);
  for (const std::uint32_t p : all_) factors_[p] = factor_at(p, curvature, k95_, options_);
  for (int i = 0; i < options_.smoothing; ++i) smooth(all_);
  return factors_;
}

void CurvatureWidths::at(std::span<const glm::vec3> points, std::span<const std::uint32_t> wanted,
                         std::span<float> factors) {
  if (k95_ > 0) grow(wanted);
  if (k95_ > 0 && ring_ends_.size() > static_cast<std::size_t>(options_.smoothing)) {
    const Curvature& curvature = solver_.solve_at(points, rings_);
    for (const std::uint32_t p : rings_) factors_[p] = factor_at(p, curvature, k95_, options_);
    for (std::size_t i = ring_ends_.size() - 1; i-- > 0;) smooth(std::span(rings_).first(ring_ends_[i]));
  } else {
    at(points);
  }
  for (const std::uint32_t p : wanted) factors[p] = factors_[p];
}

// Stops early where the rings become most of the surface.
void CurvatureWidths::grow(std::span<const std::uint32_t> wanted) {
  ++call_;
  rings_.clear();
  ring_ends_.clear();
  const auto add = [&](std::uint32_t p) {
    if (seen_at_[p] == call_) return;
    seen_at_[p] = call_;
    rings_.push_back(p);
  };
  for (const std::uint32_t p : wanted) add(p);
  ring_ends_.push_back(static_cast<std::uint32_t>(rings_.size()));
  std::size_t done = 0;
  const std::size_t most = factors_.size() / 3;
  for (int i = 0; i < options_.smoothing && rings_.size() < most; ++i) {
    const std::size_t end = rings_.size();
    for (; done < end; ++done) {
      const std::uint32_t p = rings_[done];
      for (std::uint32_t k = first_neighbour_[p]; k < first_neighbour_[p + 1]; ++k) add(neighbours_[k]);
    }
    ring_ends_.push_back(static_cast<std::uint32_t>(rings_.size()));
  }
}

void CurvatureWidths::smooth(std::span<const std::uint32_t> of) {
  for (const std::uint32_t p : of) {
    const std::uint32_t first = first_neighbour_[p], end = first_neighbour_[p + 1];
    float sum = 0;
    for (std::uint32_t i = first; i < end; ++i) sum += factors_[neighbours_[i]];
    smoothed_[p] = end > first ? (factors_[p] + sum / static_cast<float>(end - first)) / 2 : factors_[p];
  }
  for (const std::uint32_t p : of) factors_[p] = smoothed_[p];
}

}  // namespace rinkaku::outline

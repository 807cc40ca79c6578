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

float factor_at(std::size_t p, const Curvature& curvature, double k95, const WidthOptions& options) {
  const double bend = curvature_at(curvature, options.kind, p) / k95;
  return factor(static_cast<float>(std::clamp(bend, -1e30, 1e30)), options);
}

}  // namespace

std::vector<float> line_width_factors(const mesh::Topology& topology, const Curvature& curvature, double k95,
                                      const WidthOptions& options) {
  std::vector<float> factors(topology.points.size(), 1.0f);
  if (!(k95 > 0)) return factors;
  for (std::size_t p = 0; p < factors.size(); ++p) factors[p] = factor_at(p, curvature, k95, options);
  RingSmoothing smoothing(topology, options.smoothing);
  smoothing.everywhere();
  smoothing.smooth(factors);
  return factors;
}

CurvatureWidths::CurvatureWidths(const mesh::Topology& rest, const WidthOptions& options)
    : options_(options),
      solver_(rest),
      k95_(k95(solver_.solve(rest.points))),
      smoothing_(rest, options.smoothing),
      factors_(rest.points.size(), 1.0f) {}

std::span<const float> CurvatureWidths::at(std::span<const glm::vec3> points) {
  if (!(k95_ > 0)) return factors_;
  const Curvature& curvature = solver_.solve(points);
  for (const std::uint32_t p : smoothing_.everywhere()) factors_[p] = factor_at(p, curvature, k95_, options_);
  smoothing_.smooth(factors_);
  return factors_;
}

void CurvatureWidths::at(std::span<const glm::vec3> points, std::span<const std::uint32_t> wanted,
                         std::span<float> factors) {
  if (k95_ > 0) {
    const std::span<const std::uint32_t> needed = smoothing_.around(wanted);
    const bool everywhere = needed.size() == factors_.size();
    const Curvature& curvature = everywhere ? solver_.solve(points) : solver_.solve_at(points, needed);
    for (const std::uint32_t p : needed) factors_[p] = factor_at(p, curvature, k95_, options_);
    smoothing_.smooth(factors_);
  }
  for (const std::uint32_t p : wanted) factors[p] = factors_[p];
}

}  // namespace rinkaku::outline

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
float factor(double bend, const WidthOptions& options) {
  const double part = std::pow(std::min(std::abs(bend) / options.saturation, 1.0), options.curve);
  const float thicker = 1 + options.exaggeration * static_cast<float>(part);
  const bool thins =
      (options.sign == CurvatureSign::Convex && bend < 0) || (options.sign == CurvatureSign::Concave && bend > 0);
  return thins ? std::max(options.least, 1 / thicker) : thicker;
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
  for (std::size_t p = 0; p < factors.size(); ++p) {
    factors[p] = factor(curvature_at(curvature, options.kind, p) / k95, options);
  }
  std::vector<std::uint32_t> neighbours(factors.size(), 0);
  for (const mesh::Edge& edge : topology.edges) {
    ++neighbours[edge.a];
    ++neighbours[edge.b];
  }
  std::vector<float> sums(factors.size());
  for (int i = 0; i < options.smoothing; ++i) smooth(topology, factors, sums, neighbours);
  return factors;
}

}  // namespace rinkaku::outline

#include "water/plots.h"

#include <algorithm>
#include <cmath>

namespace rinkaku::water {
namespace {

constexpr int levels = 8;  // 256 steps along the side
constexpr int steps = 1 << levels;
constexpr double handful = 8;

}  // namespace

Plots::Plots(const Surface& surface, const StrokeDensity& density, int strokes) : least_(surface.least()) {
  const glm::dvec2 span = surface.most() - surface.least();
  step_m_ = std::max(span.x, span.y) / steps;
  // Strokes wanted in each square of each level, coarsest first.
  std::vector<std::vector<float>> wanted(levels + 1);
  for (int l = 0; l <= levels; ++l) wanted[l].assign(std::size_t{1} << (2 * l), 0.0f);
  double sum = 0;
  for (int y = 0; y < steps; ++y) {
    for (int x = 0; x < steps; ++x) {
      const glm::dvec2 p = least_ + (glm::dvec2(x, y) + 0.5) * step_m_;
      if (!surface.contains(p)) continue;
      const double d = density.at(p);
      wanted[levels][static_cast<std::size_t>(y) * steps + x] = static_cast<float>(d);
      sum += d;
    }
  }
  plot_of_step_.assign(static_cast<std::size_t>(steps) * steps, -1);
  per_m2_.assign(plot_of_step_.size(), 0);
  if (!(sum > 0)) return;
  for (float& w : wanted[levels]) w = static_cast<float>(w * strokes / sum);
  for (std::size_t i = 0; i < per_m2_.size(); ++i) {
    per_m2_[i] = static_cast<float>(wanted[levels][i] / (step_m_ * step_m_));
  }
  for (int l = levels; l > 0; --l) {
    const int side = 1 << l;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        wanted[l - 1][static_cast<std::size_t>(y / 2) * (side / 2) + x / 2] +=
            wanted[l][static_cast<std::size_t>(y) * side + x];
      }
    }
  }
  double carry = 0.5;
  divide(0, 0, 0, wanted, carry);
}

void Plots::divide(int level, int x, int y, std::span<const std::vector<float>> wanted, double& carry) {
  const int side = 1 << level;
  const double w = wanted[level][static_cast<std::size_t>(y) * side + x];
  if (!(w > 0)) return;
  if (w > handful && level < levels) {
    for (int i = 0; i < 4; ++i) divide(level + 1, 2 * x + i % 2, 2 * y + i / 2, wanted, carry);
    return;
  }
  const int span = steps / side;
  Plot plot;
  plot.least = least_ + glm::dvec2(x, y) * (span * step_m_);
  plot.side_m = span * step_m_;
  plot.wanted = w;
  carry += w;
  plot.strokes = static_cast<int>(carry);
  carry -= plot.strokes;
  for (int j = y * span; j < (y + 1) * span; ++j) {
    for (int i = x * span; i < (x + 1) * span; ++i) {
      plot_of_step_[static_cast<std::size_t>(j) * steps + i] = static_cast<std::int32_t>(plots_.size());
    }
  }
  plots_.push_back(plot);
}

int Plots::find(glm::dvec2 p) const {
  const glm::dvec2 s = (p - least_) / step_m_;
  if (!(s.x >= 0 && s.y >= 0 && s.x < steps && s.y < steps)) return -1;
  return plot_of_step_[static_cast<std::size_t>(s.y) * steps + static_cast<std::size_t>(s.x)];
}

double Plots::per_m2(glm::dvec2 p) const {
  const glm::dvec2 s = (p - least_) / step_m_;
  if (!(s.x >= 0 && s.y >= 0 && s.x < steps && s.y < steps)) return 0;
  return per_m2_[static_cast<std::size_t>(s.y) * steps + static_cast<std::size_t>(s.x)];
}

}  // namespace rinkaku::water

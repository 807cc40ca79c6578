#include "water/plots.h"

#include <algorithm>
#include <cmath>

namespace rinkaku::water {
namespace {

constexpr int steps = 256;  // along the side
constexpr double handful = 12;

std::size_t corner(int x, int y) { return static_cast<std::size_t>(y) * (steps + 1) + x; }

}  // namespace

Plots::Plots(const Surface& surface, const StrokeDensity& density, int strokes) : least_(surface.least()) {
  const glm::dvec2 span = surface.most() - surface.least();
  step_m_ = std::max(span.x, span.y) / steps;
  std::vector<float> wanted(static_cast<std::size_t>(steps) * steps);
  plot_of_step_.assign(wanted.size(), none);
  double sum = 0;
  for (int y = 0; y < steps; ++y) {
    for (int x = 0; x < steps; ++x) {
      const glm::dvec2 p = least_ + (glm::dvec2(x, y) + 0.5) * step_m_;
      const double d = density.at(p);
      const std::size_t i = static_cast<std::size_t>(y) * steps + x;
      plot_of_step_[i] = d > 0 ? none : unseen;
      if (!surface.contains(p)) continue;
      wanted[i] = static_cast<float>(d);
      sum += d;
    }
  }
  if (!(sum > 0)) return;
  for (float& w : wanted) w = static_cast<float>(w * strokes / sum);
  find_rim(surface, wanted);
  // What is wanted left of and above each corner.
  std::vector<double> sums(static_cast<std::size_t>(steps + 1) * (steps + 1), 0.0);
  for (int y = 0; y < steps; ++y) {
    for (int x = 0; x < steps; ++x) {
      sums[corner(x + 1, y + 1)] = sums[corner(x, y + 1)] + sums[corner(x + 1, y)] - sums[corner(x, y)] +
                                   wanted[static_cast<std::size_t>(y) * steps + x];
    }
  }
  double carry = 0.5;
  divide({0, 0, steps, steps}, sums, carry);
}

void Plots::divide(const Box& box, const std::vector<double>& sums, double& carry) {
  const double w = sums[corner(box.right, box.bottom)] - sums[corner(box.left, box.bottom)] -
                   sums[corner(box.right, box.top)] + sums[corner(box.left, box.top)];
  if (!(w > 1e-9)) return;
  const int wide = box.right - box.left, high = box.bottom - box.top;
  if (w > handful && (wide > 1 || high > 1)) {
    Box first = box, second = box;
    if (wide >= high) {
      first.right = second.left = box.left + wide / 2;
    } else {
      first.bottom = second.top = box.top + high / 2;
    }
    divide(first, sums, carry);
    divide(second, sums, carry);
    return;
  }
  Plot plot;
  plot.least = least_ + glm::dvec2(box.left, box.top) * step_m_;
  plot.size_m = glm::dvec2(wide, high) * step_m_;
  plot.wanted = w;
  carry += w;
  plot.strokes = static_cast<int>(carry);
  carry -= plot.strokes;
  for (int j = box.top; j < box.bottom; ++j) {
    for (int i = box.left; i < box.right; ++i) {
      std::int32_t& at = plot_of_step_[static_cast<std::size_t>(j) * steps + i];
      if (at != unseen) at = static_cast<std::int32_t>(plots_.size());
    }
  }
  plots_.push_back(plot);
}

void Plots::find_rim(const Surface& surface, const std::vector<float>& wanted) {
  const auto at = [&](int x, int y) {
    return x < 0 || y < 0 || x >= steps || y >= steps ? 0.0f : wanted[static_cast<std::size_t>(y) * steps + x];
  };
  for (int y = 0; y < steps; ++y) {
    for (int x = 0; x < steps; ++x) {
      const double w = at(x, y);
      if (!(w > 0)) continue;
      const glm::dvec2 middle = least_ + (glm::dvec2(x, y) + 0.5) * step_m_;
      for (const glm::dvec2 out : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
        if (at(x + static_cast<int>(out.x), y + static_cast<int>(out.y)) > 0) continue;
        // Nothing flows in over a shore.
        const glm::dvec2 across = middle + out * (1.5 * step_m_);
        if (surface.crossed_shore(middle, across).found) continue;
        rim_.push_back({middle + out * (step_m_ / 2), -out * step_m_, w / (step_m_ * step_m_)});
      }
    }
  }
}

int Plots::find(glm::dvec2 p) const {
  const glm::dvec2 s = (p - least_) / step_m_;
  if (!(s.x >= 0 && s.y >= 0 && s.x < steps && s.y < steps)) return none;
  return plot_of_step_[static_cast<std::size_t>(s.y) * steps + static_cast<std::size_t>(s.x)];
}

}  // namespace rinkaku::water

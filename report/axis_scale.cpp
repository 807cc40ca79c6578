#include "report/axis_scale.h"

#include <algorithm>
#include <cmath>

#include "report/table.h"

namespace rinkaku::report {
namespace {

std::string decade(int exponent) {
  if (exponent < -3 || exponent > 4) return "10^{" + std::to_string(exponent) + "}";
  return readable(std::pow(10.0, exponent));
}

void mark_log(AxisScale& scale) {
  const double decades = std::log10(scale.most / scale.least);
  const int first = static_cast<int>(std::floor(std::log10(scale.least)));
  for (int e = first; std::pow(10.0, e) <= scale.most; ++e) {
    for (int digit = 1; digit < 10; ++digit) {
      const double at = digit * std::pow(10.0, e);
      if (at < scale.least || at > scale.most || (scale.zero_at > 0 && at < 3 * scale.zero_at)) continue;
      const bool told = digit == 1 || (decades < 2.2 && (digit == 2 || digit == 5)) || (decades < 0.6 && digit < 8);
      const bool plain = e >= -3 && e <= 4;
      std::string text;
      if (told) text = digit == 1 ? decade(e) : plain ? readable(at) : std::to_string(digit) + "·" + decade(e);
      scale.marks.push_back({at, text});
    }
  }
  if (scale.zero_at > 0) scale.marks.push_back({scale.zero_at, "0"});
}

void mark_straight(AxisScale& scale) {
  const double rough = (scale.most - scale.least) / 6, unit = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = unit * (rough / unit > 5 ? 10 : rough / unit > 2 ? 5 : rough / unit > 1 ? 2 : 1);
  for (double i = std::ceil(scale.least / step); i * step <= scale.most; ++i) {
    scale.marks.push_back({i * step, readable(i * step)});
  }
}

}  // namespace

double AxisScale::part(double value) const {
  const double v = shown(value);
  return log ? std::log(v / least) / std::log(most / least) : (v - least) / (most - least);
}

AxisScale axis_scale(const Axis& axis, std::span<const double> values) {
  AxisScale scale;
  double least = 0, most = 0, positive = 0;
  bool first = true, zeros = false, negative = false;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    least = first ? v : std::min(least, v), most = first ? v : std::max(most, v), first = false;
    zeros |= v == 0, negative |= v < 0;
    if (v > 0) positive = positive > 0 ? std::min(positive, v) : v;
  }
  scale.log = axis.log && positive > 0 && !negative;
  if (scale.log) {
    if (zeros) scale.zero_at = positive / 8;
    const double low = zeros ? scale.zero_at : positive;
    const double room = std::max(1.25, std::pow(most / low, 0.07));
    scale.least = low / room, scale.most = most * room;
    mark_log(scale);
  } else {
    least = std::min(least, 0.0);
    if (!(most > least)) most = least + 1;
    scale.least = least - 0.04 * (most - least), scale.most = most + 0.08 * (most - least);
    mark_straight(scale);
  }
  return scale;
}

}  // namespace rinkaku::report

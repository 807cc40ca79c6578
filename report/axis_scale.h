#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/section.h"

namespace rinkaku::report {

/// The span of an axis and its marks.
struct AxisScale {
  struct Mark {
    double at = 0;
    std::string text;  ///< empty: a small mark
  };
  bool log = false;
  double least = 0, most = 1;
  double zero_at = 0;  ///< where a zero stands; not 0 on a log axis that has some
  std::vector<Mark> marks;

  /// 0 at `least`, 1 at `most`.
  double part(double value) const;
  /// Where a value is drawn: itself, or zero_at.
  double shown(double value) const { return log && !(value > 0) ? zero_at : value; }
};

/// Finds a scale that holds all of the values with some room. A log axis whose values are all 0, or negative, becomes
/// a straight one.
AxisScale axis_scale(const Axis& axis, std::span<const double> values);

}  // namespace rinkaku::report

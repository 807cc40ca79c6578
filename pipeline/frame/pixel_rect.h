#pragma once

#include <algorithm>

namespace rinkaku {

/// A rectangle of whole pixels; empty if width or height is 0.
struct PixelRect {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;
  bool operator==(const PixelRect&) const = default;
  bool empty() const { return width_px <= 0 || height_px <= 0; }
  int right_px() const { return x_px + width_px; }    ///< one past the last column
  int bottom_px() const { return y_px + height_px; }  ///< one past the last row
};

inline PixelRect intersection(const PixelRect& a, const PixelRect& b) {
  const int left = std::max(a.x_px, b.x_px), top = std::max(a.y_px, b.y_px);
  return {left, top, std::max(0, std::min(a.right_px(), b.right_px()) - left),
          std::max(0, std::min(a.bottom_px(), b.bottom_px()) - top)};
}

inline PixelRect united(const PixelRect& a, const PixelRect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  const int left = std::min(a.x_px, b.x_px), top = std::min(a.y_px, b.y_px);
  return {left, top, std::max(a.right_px(), b.right_px()) - left, std::max(a.bottom_px(), b.bottom_px()) - top};
}

}  // namespace rinkaku

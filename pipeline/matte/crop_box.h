#pragma once

#include <opencv2/core.hpp>

#include "pipeline/frame/pixel_rect.h"

namespace rinkaku::matte {

/// The part of a picture that is looked at more closely: a box around something, with a margin, that moves smoothly.
///
/// Its sides follow within a few frames, faster outwards than inwards, so that what moves isn't cut off. It is upright
/// (9:16), square or wide (16:9), whichever needs the least room around the thing, and stays so until another is
/// clearly better; at the picture's borders it is cut.
class CropBox {
 public:
  bool empty() const { return rect_.empty(); }
  const PixelRect& rect() const { return rect_; }

  /// Around `thing` at once. `whole` is the picture's size.
  void begin(const PixelRect& thing, const cv::Size& whole);
  /// A step towards `thing`, which was found inside the box. Where it touches the box it may go on outside.
  void follow(const PixelRect& thing);
  void lose() { rect_ = {}; }

 private:
  struct Sides {
    double left = 0, top = 0, right = 0, bottom = 0;
  };
  static Sides with_margin(const PixelRect& thing);
  void set(const Sides& sides);

  cv::Size whole_;
  Sides sides_;    // before they are fitted to a shape
  int shape_ = 0;  // which of the three
  PixelRect rect_;
};

}  // namespace rinkaku::matte

#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/frame/pixel_rect.h"

namespace rinkaku::passes {

using rinkaku::PixelRect;

/// CG drawn on nothing: premultiplied 8-bit RGBA of a rectangle of the picture, rows from the top without gaps.
struct Layer {
  PixelRect rect;
  std::vector<std::uint8_t> rgba;
};

}  // namespace rinkaku::passes

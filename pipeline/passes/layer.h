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

/// How far away each pixel of a layer's rectangle is: metres along the camera's axis, 0 where nothing was drawn.
struct DepthLayer {
  PixelRect rect;
  std::vector<float> depth_m;
};

/// What a layer can be taken apart into.
struct LayerParts {
  Layer lines;       ///< its lines alone, where nothing covers them
  DepthLayer depth;  ///< of surfaces, holdouts too; fluff, soft edges and lines along the contour have none
};

}  // namespace rinkaku::passes

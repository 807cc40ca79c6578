#pragma once

#include "pipeline/frame/frame.h"
#include "pipeline/passes/layer.h"

namespace rinkaku::passes {

/// 8-bit RGBA with straight alpha (sRGB) of the given size.
PictureFormat rgba_format(int width_px, int height_px, Rational sample_aspect);

/// Writes a premultiplied layer into a frame of rgba_format() as straight alpha, times `opacity`, and nothing (0, 0, 0,
/// 0) around it. Colours are rounded to the nearest 1/255 that multiplies back to the layer's.
void to_straight_alpha(const Layer& layer, double opacity, Frame& frame);

}  // namespace rinkaku::passes

#pragma once

#include "pipeline/frame/frame.h"
#include "pipeline/frame/matte.h"

namespace rinkaku::report {

/// What a camera would have filmed of a thing before a lit screen: the thing of `frame`, freed from what lies behind it
/// by its true matte and a clean plate, over a green screen that is a third brighter at the top than below.
/// Preconditions: all three are of one size, the frame of 8-bit 4:2:0.
Frame before_screen(const Frame& frame, const Frame& clean, const Matte& truth);

}  // namespace rinkaku::report

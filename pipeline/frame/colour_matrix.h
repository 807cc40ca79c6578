#pragma once

#include <array>

#include "pipeline/frame/picture_format.h"

namespace rinkaku {

/// What one component of a premultiplied colour is, in the picture's own code values:
/// red * R + green * G + blue * B + alpha * A with R, G, B, A in 0..255 (the alpha term carries the offset, so that the
/// sum is premultiplied as well).
struct ComponentWeights {
  float red = 0;
  float green = 0;
  float blue = 0;
  float alpha = 0;
};

/// The weights of each component of a picture, from its matrix, range and depth (ITU-T H.273, equations 8.3).
/// See Blender for what is taken where they are not specified.
std::array<ComponentWeights, 4> component_weights(const PictureFormat& format);

/// The matrix (H.273 code point) and range that a picture is taken to have.
int effective_matrix(const PictureFormat& format);
bool is_full_range(const PictureFormat& format);

}  // namespace rinkaku

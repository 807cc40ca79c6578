#pragma once

#include <utility>
#include <vector>

#include "pipeline/frame/frame.h"
#include "pipeline/passes/layer.h"

namespace rinkaku::passes {

/// Whether blend() can write into such a picture: 1 to 4 components of 8 to 16 bits each in whole bytes.
bool can_blend(const PixelFormat& pixels);

/// Lays premultiplied CG over a frame, on the frame's own planes: converted to its matrix and range, chroma averaged
/// over each subsampled block together with its alpha.
///
/// Samples under alpha 0, and chroma blocks under alpha 0 everywhere, keep their bits. A matrix that is not specified
/// is taken as BT.709 from 1280 pixels of width or 577 of height on, else as BT.601; a range that is not specified as
/// limited for Y'CbCr, full for grey and RGB. `layer` must lie inside the picture. Precondition: frame made writable,
/// can_blend(). Keeps scratch memory between calls: one object a thread.
class Blender {
 public:
  void blend(Frame& frame, const Layer& layer, double opacity = 1);

 private:
  std::vector<std::pair<int, int>>
      spans_;  // of each row of the layer: the first column that holds anything, and the end
  std::vector<std::int16_t> sums_;
};

}  // namespace rinkaku::passes

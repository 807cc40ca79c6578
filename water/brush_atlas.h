#pragma once

#include <cstdint>
#include <vector>

#include "water/brushes.h"

namespace rinkaku::water {

/// A sheet's brushes in several sizes, each half the last one, in one picture: a stroke is painted with the size whose
/// texels are about as large as pixels. A brush whose hairs are finer than pixels would tremble as it moves, and reads
/// memory all over the place.
///
/// Around each brush lies a texel without paint, so that bilinear sampling fades out at its sides. Four bytes a texel:
/// paint, light, 0, 255.
struct BrushAtlas {
  struct Level {
    int width_px = 0, height_px = 0;  ///< of a brush
    int left_px = 0, top_px = 0;      ///< of the first one's first texel of paint
    int step_px = 0;                  ///< from one brush to the next, to the right
  };
  int width_px = 0, height_px = 0;
  std::vector<Level> levels;  ///< the largest first
  std::vector<std::uint8_t> texels;

  /// Which size is for strokes so long and so wide.
  const Level& level_for(float stroke_length_px, float stroke_width_px) const;
};

/// Cost: some 5 ms.
BrushAtlas brush_atlas(const BrushSheet& sheet);

}  // namespace rinkaku::water

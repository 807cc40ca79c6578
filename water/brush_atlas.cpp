#include "water/brush_atlas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rinkaku::water {
namespace {

constexpr int margin = 1, least_rows = 4;
// Texels smaller than this part of a pixel would be left out now and then.
constexpr float least_texel_px = 0.7f;

struct Texel {
  float paint = 0, light = 0;  // light as it weighs in: times the paint
};
using Brush = std::vector<Texel>;

Brush layer(const BrushSheet& sheet, int number) {
  const std::size_t size = static_cast<std::size_t>(sheet.width_px) * sheet.height_px;
  Brush brush(size);
  const std::uint8_t* from = sheet.texels.data() + size * number * 2;
  for (Texel& t : brush) {
    t.paint = from[0];
    t.light = t.paint * (from[1] - 128.0f);
    from += 2;
  }
  return brush;
}

Brush halved(const Brush& brush, int width, int height) {
  Brush half(static_cast<std::size_t>(width / 2) * (height / 2));
  for (int y = 0; y < height / 2; ++y) {
    for (int x = 0; x < width / 2; ++x) {
      Texel& to = half[static_cast<std::size_t>(y) * (width / 2) + x];
      for (const int j : {0, 1}) {
        for (const int i : {0, 1}) {
          const Texel& t = brush[static_cast<std::size_t>(2 * y + j) * width + 2 * x + i];
          to.paint += t.paint / 4, to.light += t.light / 4;
        }
      }
    }
  }
  return half;
}

void store(BrushAtlas& atlas, const BrushAtlas::Level& level, int number, const Brush& brush) {
  const int left = level.left_px + number * level.step_px;
  for (int y = 0; y < level.height_px; ++y) {
    for (int x = 0; x < level.width_px; ++x) {
      const Texel& t = brush[static_cast<std::size_t>(y) * level.width_px + x];
      std::uint8_t* to =
          atlas.texels.data() + (static_cast<std::size_t>(level.top_px + y) * atlas.width_px + left + x) * 4;
      to[0] = static_cast<std::uint8_t>(std::lround(t.paint));
      to[1] = static_cast<std::uint8_t>(std::lround(128 + (t.paint > 0 ? t.light / t.paint : 0)));
    }
  }
}

}  // namespace

const BrushAtlas::Level& BrushAtlas::level_for(float stroke_length_px, float stroke_width_px) const {
  for (const Level& l : levels) {
    // Lines run along a brush, which therefore may be squeezed twice as much that way.
    const bool fine = stroke_width_px < least_texel_px * static_cast<float>(l.height_px) ||
                      stroke_length_px < 0.5f * least_texel_px * static_cast<float>(l.width_px);
    if (!fine) return l;
  }
  return levels.back();
}

BrushAtlas brush_atlas(const BrushSheet& sheet) {
  BrushAtlas atlas;
  for (int w = sheet.width_px, h = sheet.height_px; std::min(w, h) >= least_rows; w /= 2, h /= 2) {
    const int step = w + 2 * margin;
    atlas.levels.push_back({w, h, margin, atlas.height_px + margin, step});
    atlas.width_px = std::max(atlas.width_px, step * sheet.layers);
    atlas.height_px += h + 2 * margin;
    if (w % 2 != 0 || h % 2 != 0) break;
  }
  atlas.texels.resize(static_cast<std::size_t>(atlas.width_px) * atlas.height_px * 4);
  for (std::size_t i = 0; i < atlas.texels.size(); i += 4) atlas.texels[i + 1] = 128, atlas.texels[i + 3] = 255;
  for (int number = 0; number < sheet.layers; ++number) {
    Brush brush = layer(sheet, number);
    for (const BrushAtlas::Level& level : atlas.levels) {
      if (&level != &atlas.levels.front()) brush = halved(brush, 2 * level.width_px, 2 * level.height_px);
      store(atlas, level, number, brush);
    }
  }
  return atlas;
}

}  // namespace rinkaku::water

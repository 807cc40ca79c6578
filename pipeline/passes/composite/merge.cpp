#include "pipeline/passes/composite/merge.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

#include "pipeline/passes/composite/wide.h"

namespace rinkaku::passes {
namespace {

// value / 255, rounded, for value in 0..65025.
inline int over_255(int value) { return (value + 128 + ((value + 128) >> 8)) >> 8; }

// top over under, both premultiplied.
RINKAKU_WIDE void row_over(const std::uint8_t* top, std::uint8_t* under, int pixels) {
  for (int x = 0; x < pixels; ++x) {
    const int rest = 255 - top[4 * x + 3];
    for (int c = 0; c < 4; ++c) {
      under[4 * x + c] = static_cast<std::uint8_t>(top[4 * x + c] + over_255(under[4 * x + c] * rest));
    }
  }
}

// What a matte leaves of the pixels behind it. Soft pixels get the thing's own colour in exchange.
void row_cut(const std::uint8_t* alpha, const std::uint8_t* own_rgb, std::uint8_t* behind, int pixels) {
  for (int x = 0; x < pixels; ++x) {
    const int a = alpha[x];
    std::uint8_t* const at = behind + 4 * x;
    if (a == 0) {
      // Most of a row: skip 8 at a time.
      while (x + 9 <= pixels) {
        std::uint64_t eight;
        std::memcpy(&eight, alpha + x + 1, 8);
        if (eight != 0) break;
        x += 8;
      }
      continue;
    }
    if (at[3] == 0) continue;
    if (a == 255) {
      std::memset(at, 0, 4);
      continue;
    }
    const int rest = 255 - a;
    if (own_rgb == nullptr) {
      for (int c = 0; c < 4; ++c) at[c] = static_cast<std::uint8_t>(over_255(at[c] * rest));
      continue;
    }
    const int share = over_255(at[3] * a);
    for (int c = 0; c < 3; ++c) {
      const int value = over_255(at[c] * rest) + over_255(own_rgb[3 * x + c] * share);
      at[c] = static_cast<std::uint8_t>(std::min<int>(value, at[3]));
    }
  }
}

void cut(const Matte& matte, bool own_colours, Layer& behind) {
  const PixelRect rect = intersection(matte.rect, behind.rect);
  for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
    const std::size_t pixel = static_cast<std::size_t>(y) * matte.width_px + rect.x_px;
    std::uint8_t* at =
        behind.rgba.data() +
        (static_cast<std::size_t>(y - behind.rect.y_px) * behind.rect.width_px + rect.x_px - behind.rect.x_px) * 4;
    row_cut(matte.alpha.data() + pixel, own_colours ? matte.own_rgb.data() + 3 * pixel : nullptr, at, rect.width_px);
  }
}

// The line around a thing, over what lies behind it.
void lay_line(const Matte& matte, Layer& under) {
  const PixelRect& rect = matte.line_rect;
  if (rect.empty()) return;
  const auto& rgb = matte.line_rgb;
  for (int y = 0; y < rect.height_px; ++y) {
    const std::uint8_t* line = matte.line.data() + static_cast<std::size_t>(y) * rect.width_px;
    std::uint8_t* at =
        under.rgba.data() + (static_cast<std::size_t>(rect.y_px + y - under.rect.y_px) * under.rect.width_px +
                             rect.x_px - under.rect.x_px) *
                                4;
    for (int x = 0; x < rect.width_px; ++x, at += 4) {
      if (line[x] == 0) continue;
      const std::uint8_t top[4] = {static_cast<std::uint8_t>(over_255(rgb[0] * line[x])),
                                   static_cast<std::uint8_t>(over_255(rgb[1] * line[x])),
                                   static_cast<std::uint8_t>(over_255(rgb[2] * line[x])), line[x]};
      row_over(top, at, 1);
    }
  }
}

// Inside under's rectangle.
void over(const Layer& top, Layer& under) {
  const PixelRect rect = intersection(top.rect, under.rect);
  for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
    const auto at = [y, &rect](const PixelRect& in) {
      return (static_cast<std::size_t>(y - in.y_px) * in.width_px + rect.x_px - in.x_px) * 4;
    };
    row_over(top.rgba.data() + at(top.rect), under.rgba.data() + at(under.rect), rect.width_px);
  }
}

void clear(Layer& layer, const PixelRect& rect) {
  layer.rect = rect;
  layer.rgba.resize(static_cast<std::size_t>(rect.width_px) * rect.height_px * 4);
  std::fill(layer.rgba.begin(), layer.rgba.end(), std::uint8_t{0});
}

}  // namespace

void merge(const MergeInput& input, Layer& out) {
  assert(input.layers.size() == input.mattes.size() + 1);
  PixelRect rect;
  for (const Layer& layer : input.layers) rect = united(rect, layer.rect);
  for (const Matte& matte : input.mattes) rect = united(rect, matte.line_rect);
  clear(out, rect.empty() ? PixelRect{} : rect);
  if (rect.empty()) return;
  for (std::size_t i = input.layers.size(); i-- > 0;) {
    if (i < input.mattes.size()) {
      lay_line(input.mattes[i], out);
      cut(input.mattes[i], input.own_colours, out);
    }
    over(input.layers[i], out);
  }
}

void put_behind(const Layer& world, Layer& layer, Layer& scratch) {
  scratch.rect = world.rect;
  scratch.rgba.assign(world.rgba.begin(), world.rgba.end());
  over(layer, scratch);
  std::swap(layer, scratch);
}

void fade(Layer& layer, double opacity) {
  if (opacity >= 1 || layer.rect.empty()) return;
  const int share = static_cast<int>(std::lround(std::max(opacity, 0.0) * 255));
  for (std::uint8_t& value : layer.rgba) value = static_cast<std::uint8_t>(over_255(value * share));
}

}  // namespace rinkaku::passes

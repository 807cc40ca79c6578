#include "pipeline/passes/composite/blend.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <utility>

#include "pipeline/frame/colour_matrix.h"
#include "pipeline/passes/composite/wide.h"

namespace rinkaku::passes {
namespace {

// The layer's sums over the pixels of each block of one row of blocks: R, G, B, A, in 0..255 a pixel. Blocks are of 16
// pixels at most, so 16 bits hold them.
struct BlockRow {
  const std::int16_t* red;
  const std::int16_t* green;
  const std::int16_t* blue;
  const std::int16_t* alpha;
  int blocks;
};

// Adds one row of premultiplied pixels to sums, pixel by pixel.
RINKAKU_WIDE void add_row(const std::uint8_t* rgba, int pixels, std::int16_t* red, std::int16_t* green,
                          std::int16_t* blue, std::int16_t* alpha) {
  static_assert(std::endian::native == std::endian::little);
  for (int i = 0; i < pixels; ++i) {
    std::uint32_t pixel;  // whole words, so that the compiler can take several at a time
    std::memcpy(&pixel, rgba + 4 * i, 4);
    red[i] = static_cast<std::int16_t>(red[i] + static_cast<int>(pixel & 255));
    green[i] = static_cast<std::int16_t>(green[i] + static_cast<int>(pixel >> 8 & 255));
    blue[i] = static_cast<std::int16_t>(blue[i] + static_cast<int>(pixel >> 16 & 255));
    alpha[i] = static_cast<std::int16_t>(alpha[i] + static_cast<int>(pixel >> 24));
  }
}

// Adds up the pixels of each block, in place.
RINKAKU_WIDE void add_within_blocks(std::int16_t* sums, int blocks, int log2_block) {
  if (log2_block == 1) {
    for (int b = 0; b < blocks; ++b) sums[b] = static_cast<std::int16_t>(sums[2 * b] + sums[2 * b + 1]);
    return;
  }
  for (int b = 0; b < blocks; ++b) {
    int sum = 0;
    for (int k = 0; k < 1 << log2_block; ++k) sum += sums[(b << log2_block) + k];
    sums[b] = static_cast<std::int16_t>(sum);
  }
}

// The columns of a row that hold anything: first, and one past the last.
std::pair<int, int> covered(const std::uint8_t* rgba, int pixels) {
  // Four pixels at a time while there is nothing at all.
  const auto empty = [rgba](int i) {
    std::uint64_t two[2];
    std::memcpy(two, rgba + std::ptrdiff_t{4} * i, 16);
    return (two[0] | two[1]) == 0;
  };
  int first = 0, last = pixels;
  while (first + 4 <= last && empty(first)) first += 4;
  while (first < last && rgba[4 * first + 3] == 0) ++first;
  while (last - 4 >= first && empty(last - 4)) last -= 4;
  while (last > first && rgba[4 * last - 1] == 0) --last;
  return {first, last};
}

// What a component's blend multiplies with, opacity and the size of a block taken in.
struct Factors {
  float red, green, blue, alpha, cover, largest;
  Factors(const ComponentWeights& w, float scale, int depth_bits)
      : red(w.red * scale),
        green(w.green * scale),
        blue(w.blue * scale),
        alpha(w.alpha * scale),
        cover(-scale * (1.0f / 255.0f)),
        largest(static_cast<float>((1 << depth_bits) - 1) + 0.5f) {}

  // colour + (1 - alpha) * plate for block i. Alpha 0 gives plate * 1 + 0, exactly.
  // Inlined into each loop, so that it is compiled for that loop's registers.
  [[gnu::always_inline]] int blended(const BlockRow& row, int i, float plate) const {
    const float a = static_cast<float>(row.alpha[i]);
    const float colour = red * static_cast<float>(row.red[i]) + green * static_cast<float>(row.green[i]) +
                         blue * static_cast<float>(row.blue[i]) + alpha * a;
    const float value = colour + (1.0f + cover * a) * plate + 0.5f;
    return static_cast<int>(std::min(std::max(value, 0.0f), largest));
  }
};

// The common case: a plane of bytes that holds this component alone.
RINKAKU_WIDE void blend_bytes(std::uint8_t* samples, const BlockRow row, const Factors f) {
  for (int i = 0; i < row.blocks; ++i) {
    samples[i] = static_cast<std::uint8_t>(f.blended(row, i, static_cast<float>(samples[i])));
  }
}

void blend_component_row(std::uint8_t* samples, const Component& component, bool big_endian, const BlockRow& row,
                         const ComponentWeights& weights, float scale) {
  const Factors factors(weights, scale, component.depth_bits);
  const int step = component.step_bytes, shift = component.shift_bits;
  const bool two_bytes = component.depth_bits + shift > 8;
  if (!two_bytes && shift == 0 && step == 1 && component.depth_bits == 8) {
    blend_bytes(samples, row, factors);
    return;
  }
  const bool swap = big_endian != (std::endian::native == std::endian::big);
  const int mask = ((1 << component.depth_bits) - 1) << shift;
  for (int i = 0; i < row.blocks; ++i) {
    std::uint8_t* at = samples + static_cast<std::ptrdiff_t>(i) * step;
    if (!two_bytes) {
      const int value = factors.blended(row, i, static_cast<float>((*at & mask) >> shift));
      // Bits beside the component's own (packed formats share words) stay as they are.
      *at = static_cast<std::uint8_t>((*at & ~mask) | value << shift);
      continue;
    }
    std::uint16_t word;
    std::memcpy(&word, at, 2);
    if (swap) word = static_cast<std::uint16_t>(word << 8 | word >> 8);
    const int value = factors.blended(row, i, static_cast<float>((word & mask) >> shift));
    word = static_cast<std::uint16_t>((word & ~mask) | value << shift);
    if (swap) word = static_cast<std::uint16_t>(word << 8 | word >> 8);
    std::memcpy(at, &word, 2);
  }
}

}  // namespace

bool can_blend(const PixelFormat& pixels) {
  if (pixels.components < 1 || pixels.components > 4) return false;
  for (int c = 0; c < pixels.components; ++c) {
    const Component& component = pixels.component[c];
    const int bits = component.depth_bits + component.shift_bits;
    if (component.depth_bits < 1 || component.depth_bits > 16 || bits > 16 || component.step_bytes < 1) return false;
  }
  return true;
}

void Blender::blend(Frame& frame, const Layer& layer, double opacity_wish) {
  assert(frame.let_go && can_blend(frame.format.pixels));
  const PictureFormat& format = frame.format;
  const PixelFormat& pixels = format.pixels;
  const PixelRect& rect = layer.rect;
  assert(rect == intersection(rect, {0, 0, format.width_px, format.height_px}));
  if (rect.empty() || opacity_wish <= 0) return;
  const float opacity = static_cast<float>(std::min(opacity_wish, 1.0));
  const std::array<ComponentWeights, 4> weights = component_weights(format);

  auto pixels_of = [&](int y) {
    return layer.rgba.data() + static_cast<std::size_t>(y - rect.y_px) * rect.width_px * 4;
  };
  spans_.clear();
  for (int y = rect.y_px; y < rect.bottom_px(); ++y) spans_.push_back(covered(pixels_of(y), rect.width_px));

  // Components with the same grid share their sums: luma (and alpha) first, then chroma.
  for (int chroma = 0; chroma < 2; ++chroma) {
    const bool chroma_grid = chroma == 1;
    const int log2_w = chroma_grid ? pixels.log2_chroma_width : 0;
    const int log2_h = chroma_grid ? pixels.log2_chroma_height : 0;
    std::array<int, 4> member{};
    int members = 0;
    for (int c = 0; c < pixels.components; ++c) {
      if (format.is_chroma(c) == chroma_grid) member[members++] = c;
    }
    if (members == 0) continue;

    // Room for a row of blocks, pixel by pixel.
    const std::size_t row_pixels = static_cast<std::size_t>(rect.width_px) + (std::size_t{2} << log2_w);
    sums_.resize(row_pixels * 4);
    std::int16_t* const red = sums_.data();
    std::int16_t* const green = red + row_pixels;
    std::int16_t* const blue = green + row_pixels;
    std::int16_t* const alpha = blue + row_pixels;

    for (int row = rect.y_px >> log2_h; row <= (rect.bottom_px() - 1) >> log2_h; ++row) {
      const int top = row << log2_h, bottom = std::min((row + 1) << log2_h, format.height_px);
      const int first_y = std::max(top, rect.y_px), end_y = std::min(bottom, rect.bottom_px());
      int first = rect.width_px, last = 0;
      for (int y = first_y; y < end_y; ++y) {
        const auto [row_first, row_last] = spans_[static_cast<std::size_t>(y - rect.y_px)];
        if (row_first == row_last) continue;
        first = std::min(first, row_first), last = std::max(last, row_last);
      }
      if (first >= last) continue;
      const int first_block = (rect.x_px + first) >> log2_w;
      const int blocks = ((rect.x_px + last - 1) >> log2_w) - first_block + 1;
      const int in_block = rect.x_px + first - (first_block << log2_w);
      for (std::int16_t* sums : {red, green, blue, alpha}) std::fill_n(sums, blocks << log2_w, 0);
      for (int y = first_y; y < end_y; ++y) {
        add_row(pixels_of(y) + std::ptrdiff_t{4} * first, last - first, red + in_block, green + in_block,
                blue + in_block, alpha + in_block);
      }
      if (log2_w > 0) {
        for (std::int16_t* sums : {red, green, blue, alpha}) add_within_blocks(sums, blocks, log2_w);
      }
      // The picture's last block may be cut off by its edge; it is then blended by itself.
      const int last_width =
          std::min((first_block + blocks) << log2_w, format.width_px) - ((first_block + blocks - 1) << log2_w);
      const int whole = last_width == 1 << log2_w ? blocks : blocks - 1;
      auto blend_blocks = [&](int from, int count, int block_width) {
        const BlockRow run{red + from, green + from, blue + from, alpha + from, count};
        const float scale = opacity / static_cast<float>(block_width * (bottom - top));
        for (int m = 0; m < members; ++m) {
          const Component& component = pixels.component[member[m]];
          const Plane& plane = frame.planes[component.plane];
          std::uint8_t* samples = plane.data + row * plane.stride_bytes + component.offset_bytes +
                                  static_cast<std::ptrdiff_t>(first_block + from) * component.step_bytes;
          blend_component_row(samples, component, pixels.big_endian, run, weights[member[m]], scale);
        }
      };
      blend_blocks(0, whole, 1 << log2_w);
      if (whole < blocks) blend_blocks(whole, 1, last_width);
    }
  }
}

}  // namespace rinkaku::passes

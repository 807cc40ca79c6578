#include "tests/pipeline/passes/blend_reference.h"

#include <algorithm>
#include <cmath>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include "pipeline/ffmpeg/formats.h"

namespace rinkaku::test {
namespace {

std::uint8_t* sample_address(const Frame& frame, int component, int x, int y) {
  const Component& c = frame.format.pixels.component[component];
  const Plane& plane = frame.planes[c.plane];
  return plane.data + y * plane.stride_bytes + static_cast<std::ptrdiff_t>(x) * c.step_bytes + c.offset_bytes;
}

}  // namespace

int sample_bytes(const Component& c) { return c.depth_bits + c.shift_bits > 8 ? 2 : 1; }

PictureFormat picture_format(const std::string& name, int width_px, int height_px, int matrix,
                             ColourTags::Range range) {
  PictureFormat format;
  format.width_px = width_px;
  format.height_px = height_px;
  format.pixels = ffmpeg::to_pixel_format(av_get_pix_fmt(name.c_str()));
  format.colour.matrix = matrix;
  format.colour.range = range;
  return format;
}

int sample(const Frame& frame, int component, int x, int y) {
  const Component& c = frame.format.pixels.component[component];
  const std::uint8_t* at = sample_address(frame, component, x, y);
  int word = at[0];
  if (sample_bytes(c) == 2) word = frame.format.pixels.big_endian ? at[0] * 256 + at[1] : at[1] * 256 + at[0];
  return (word >> c.shift_bits) & ((1 << c.depth_bits) - 1);
}

void set_sample(Frame& frame, int component, int x, int y, int value) {
  const Component& c = frame.format.pixels.component[component];
  std::uint8_t* at = sample_address(frame, component, x, y);
  const int word = value << c.shift_bits;
  if (sample_bytes(c) == 1) {
    at[0] = static_cast<std::uint8_t>(word);
  } else {
    at[frame.format.pixels.big_endian ? 1 : 0] = static_cast<std::uint8_t>(word & 255);
    at[frame.format.pixels.big_endian ? 0 : 1] = static_cast<std::uint8_t>(word >> 8);
  }
}

std::vector<std::uint8_t> all_bytes(const Frame& frame) {
  std::vector<std::uint8_t> bytes;
  for (int p = 0; p < frame.format.pixels.planes; ++p) {
    const Plane& plane = frame.planes[p];
    bytes.insert(bytes.end(), plane.data, plane.data + plane.stride_bytes * plane.rows);
  }
  return bytes;
}

Frame random_frame(FramePool& pool, const PictureFormat& format, std::mt19937& random) {
  Frame frame = pool.allocate(format);
  for (int p = 0; p < format.pixels.planes; ++p) {
    const Plane& plane = frame.planes[p];
    for (std::ptrdiff_t i = 0; i < plane.stride_bytes * plane.rows; ++i) {
      plane.data[i] = static_cast<std::uint8_t>(random());
    }
  }
  return frame;
}

passes::Layer random_layer(const passes::PixelRect& rect, std::mt19937& random) {
  passes::Layer layer{rect, std::vector<std::uint8_t>(static_cast<std::size_t>(rect.width_px) * rect.height_px * 4)};
  for (int y = 0; y < rect.height_px; ++y) {
    const bool empty_row = random() % 5 == 0;
    for (int x = 0; x < rect.width_px; ++x) {
      const auto kind = random() % 3;
      const unsigned alpha = empty_row || kind == 0 ? 0 : kind == 1 ? 255 : random() % 256;
      std::uint8_t* rgba = layer.rgba.data() + (static_cast<std::size_t>(y) * rect.width_px + x) * 4;
      for (int c = 0; c < 3; ++c) rgba[c] = static_cast<std::uint8_t>(random() % (alpha + 1));
      rgba[3] = static_cast<std::uint8_t>(alpha);
    }
  }
  return layer;
}

passes::Layer even_layer(const passes::PixelRect& rect, int r, int g, int b, int a) {
  passes::Layer layer{rect, {}};
  for (int i = 0; i < rect.width_px * rect.height_px; ++i) {
    for (int v : {r, g, b, a}) layer.rgba.push_back(static_cast<std::uint8_t>(v));
  }
  return layer;
}

Mean layer_mean(const PictureFormat& format, const passes::Layer& layer, int component, int x, int y) {
  const bool chroma = format.is_chroma(component);
  const int w = chroma ? 1 << format.pixels.log2_chroma_width : 1,
            h = chroma ? 1 << format.pixels.log2_chroma_height : 1;
  Mean mean;
  int pixels = 0;
  for (int py = y * h; py < std::min((y + 1) * h, format.height_px); ++py) {
    for (int px = x * w; px < std::min((x + 1) * w, format.width_px); ++px) {
      ++pixels;
      const int lx = px - layer.rect.x_px, ly = py - layer.rect.y_px;
      if (lx < 0 || ly < 0 || lx >= layer.rect.width_px || ly >= layer.rect.height_px) continue;
      const std::uint8_t* rgba = layer.rgba.data() + (static_cast<std::size_t>(ly) * layer.rect.width_px + lx) * 4;
      mean.r += rgba[0] / 255.0, mean.g += rgba[1] / 255.0, mean.b += rgba[2] / 255.0, mean.a += rgba[3] / 255.0;
    }
  }
  return {mean.r / pixels, mean.g / pixels, mean.b / pixels, mean.a / pixels};
}

double code_value(const PictureFormat& format, int component, const Mean& m, int matrix, bool full) {
  const PixelFormat& pixels = format.pixels;
  const double codes = std::pow(2.0, pixels.component[component].depth_bits), step = codes / 256;
  if (pixels.has_alpha && component == pixels.components - 1) return m.a * (codes - 1);
  if (pixels.model == ColourModel::Rgb) {
    return (component == 0 ? m.r : component == 1 ? m.g : m.b) * (codes - 1);
  }
  double y, pb, pr;
  if (matrix == 8) {  // YCgCo, equations 44 to 46
    y = 0.5 * m.g + 0.25 * (m.r + m.b), pb = 0.5 * m.g - 0.25 * (m.r + m.b), pr = 0.5 * (m.r - m.b);
  } else {
    double kr = 0.299, kb = 0.114;
    if (matrix == 1) kr = 0.2126, kb = 0.0722;
    if (matrix == 7) kr = 0.212, kb = 0.087;
    if (matrix == 9) kr = 0.2627, kb = 0.0593;
    y = kr * m.r + (1 - kr - kb) * m.g + kb * m.b;
    pb = 0.5 * (m.b - y) / (1 - kb), pr = 0.5 * (m.r - y) / (1 - kr);
  }
  if (component == 0) return full ? (codes - 1) * y : step * (219 * y + 16 * m.a);
  const double p = component == 1 ? pb : pr;
  return full ? (codes - 1) * p + codes / 2 * m.a : step * (224 * p + 128 * m.a);
}

}  // namespace rinkaku::test

#include "pipeline/matte/picture.h"

#include <cstddef>

#include <opencv2/imgproc.hpp>

#include "pipeline/frame/colour_matrix.h"

namespace rinkaku::matte {
namespace {

bool is_plain(const Frame& frame, int component) {
  const Component& c = frame.format.pixels.component[static_cast<std::size_t>(component)];
  const Plane& plane = frame.planes[static_cast<std::size_t>(c.plane)];
  return c.step_bytes == 1 && c.depth_bits == 8 && c.shift_bits == 0 && plane.stride_bytes > 0;
}

// A component's samples brought to 8 bits: the plane itself where it holds nothing else, else written to `scratch`.
cv::Mat component_plane(const Frame& frame, int index, cv::Mat& scratch) {
  const Component& c = frame.format.pixels.component[static_cast<std::size_t>(index)];
  const Plane& plane = frame.planes[static_cast<std::size_t>(c.plane)];
  const int width = frame.format.component_width_px(index), height = frame.format.component_height_px(index);
  if (is_plain(frame, index)) {
    return {height, width, CV_8U, plane.data + c.offset_bytes, static_cast<std::size_t>(plane.stride_bytes)};
  }
  scratch.create(height, width, CV_8U);
  const bool wide = c.depth_bits + c.shift_bits > 8, big = frame.format.pixels.big_endian;
  const unsigned mask = (1u << c.depth_bits) - 1;
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* at = plane.data + y * plane.stride_bytes + c.offset_bytes;
    std::uint8_t* out = scratch.ptr<std::uint8_t>(y);
    for (int x = 0; x < width; ++x, at += c.step_bytes) {
      unsigned raw = at[0];
      if (wide) raw = big ? raw << 8 | at[1] : raw | static_cast<unsigned>(at[1]) << 8;
      raw = (raw >> c.shift_bits) & mask;
      out[x] = static_cast<std::uint8_t>(c.depth_bits >= 8 ? raw >> (c.depth_bits - 8) : raw * 255 / mask);
    }
  }
  return scratch;
}

// The format's coding in 8 bits. RGB and grey are taken as full-range BT.601.
void set_coding(const PictureFormat& format, Picture& picture) {
  PictureFormat coding = format;
  coding.pixels.components = 3;
  coding.pixels.has_alpha = false;
  for (Component& c : coding.pixels.component) c.depth_bits = 8;
  if (format.pixels.model != ColourModel::Yuv) {
    constexpr int bt601 = 6;
    coding.pixels.model = ColourModel::Yuv;
    coding.colour.matrix = bt601;
    coding.colour.range = ColourTags::Range::Full;
  }
  const auto weights = component_weights(coding);
  cv::Matx33f linear;
  cv::Vec3f offset;
  for (int c = 0; c < 3; ++c) {
    const ComponentWeights& w = weights[static_cast<std::size_t>(c)];
    linear(c, 0) = w.red, linear(c, 1) = w.green, linear(c, 2) = w.blue;
    offset[c] = w.alpha * 255;
  }
  const cv::Matx33f back = linear.inv();
  const cv::Vec3f back_offset = back * offset;
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 3; ++k) {
      picture.ycc_from_rgb(c, k) = linear(c, k);
      picture.rgb_from_ycc(c, k) = back(c, k);
    }
    picture.ycc_from_rgb(c, 3) = offset[c];
    picture.rgb_from_ycc(c, 3) = -back_offset[c];
  }
  picture.black = offset[0];
}

}  // namespace

const Picture& PictureReader::read(const Frame& frame) {
  if (!(format_ == frame.format)) {
    format_ = frame.format;
    set_coding(format_, picture_);
  }
  if (frame.format.pixels.model == ColourModel::Rgb) {
    read_rgb(frame);
  } else {
    read_ycc(frame);
  }
  return picture_;
}

void PictureReader::read_ycc(const Frame& frame) {
  picture_.luma = component_plane(frame, 0, planes_[0]);
  if (frame.format.pixels.model == ColourModel::Grey) {
    picture_.log2_chroma_width = picture_.log2_chroma_height = 0;
    planes_[1].create(picture_.luma.size(), CV_8U);
    planes_[1].setTo(128);
    picture_.cb = picture_.cr = planes_[1];
    return;
  }
  picture_.log2_chroma_width = frame.format.pixels.log2_chroma_width;
  picture_.log2_chroma_height = frame.format.pixels.log2_chroma_height;
  picture_.cb = component_plane(frame, 1, planes_[1]);
  picture_.cr = component_plane(frame, 2, planes_[2]);
}

void PictureReader::read_rgb(const Frame& frame) {
  cv::Mat rgb[3], scratch[3];
  for (int c = 0; c < 3; ++c) rgb[c] = component_plane(frame, c, scratch[c]);
  const cv::Matx34f& m = picture_.ycc_from_rgb;
  picture_.log2_chroma_width = picture_.log2_chroma_height = 0;
  for (int c = 0; c < 3; ++c) {
    planes_[c].create(rgb[0].size(), CV_8U);
    for (int y = 0; y < rgb[0].rows; ++y) {
      const auto *r = rgb[0].ptr<std::uint8_t>(y), *g = rgb[1].ptr<std::uint8_t>(y), *b = rgb[2].ptr<std::uint8_t>(y);
      auto* out = planes_[c].ptr<std::uint8_t>(y);
      for (int x = 0; x < rgb[0].cols; ++x) {
        const float value = m(c, 0) * r[x] + m(c, 1) * g[x] + m(c, 2) * b[x] + m(c, 3) + 0.5f;
        out[x] = static_cast<std::uint8_t>(std::min(value, 255.0f));
      }
    }
  }
  picture_.luma = planes_[0];
  picture_.cb = planes_[1];
  picture_.cr = planes_[2];
}

cv::Mat recoded(const Picture& from, const cv::Matx34f& ycc_from_rgb) {
  cv::Mat full[3];
  full[0] = from.luma;
  cv::resize(from.cb, full[1], from.luma.size(), 0, 0, cv::INTER_LINEAR);
  cv::resize(from.cr, full[2], from.luma.size(), 0, 0, cv::INTER_LINEAR);
  cv::Mat merged, floats;
  cv::merge(full, 3, merged);
  merged.convertTo(floats, CV_32F);
  cv::Matx44f to = cv::Matx44f::eye(), back = cv::Matx44f::eye();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) {
      to(r, c) = ycc_from_rgb(r, c);
      back(r, c) = from.rgb_from_ycc(r, c);
    }
  }
  const cv::Matx44f both = to * back;
  cv::Mat out;
  cv::transform(floats, out, cv::Mat(both).rowRange(0, 3));
  return out;
}

}  // namespace rinkaku::matte

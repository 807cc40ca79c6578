#include <random>

#include "pipeline/frame/picture_format.h"
#include "tests/pipeline/source/media_tools.h"

extern "C" {
#include <libavutil/imgutils.h>
}

namespace rinkaku {
namespace {

unsigned read_sample(const Frame& frame, int component, int x, int y) {
  const PixelFormat& pixels = frame.format.pixels;
  const Component& c = pixels.component[static_cast<std::size_t>(component)];
  const Plane& plane = frame.planes[static_cast<std::size_t>(c.plane)];
  const std::uint8_t* at = plane.data + y * plane.stride_bytes + x * c.step_bytes + c.offset_bytes;
  unsigned value = at[0];
  if (c.depth_bits + c.shift_bits > 8) value = pixels.big_endian ? at[0] << 8 | at[1] : at[1] << 8 | at[0];
  return value >> c.shift_bits & ((1u << c.depth_bits) - 1);
}

// Every format that is said to be addressable reads as FFmpeg's own accessor reads it.
TEST(PixelFormat, AddressesSamplesAsFfmpegDoes) {
  constexpr int width = 12, height = 6;
  int formats = 0;
  for (const AVPixFmtDescriptor* d = av_pix_fmt_desc_next(nullptr); d; d = av_pix_fmt_desc_next(d)) {
    const AVPixelFormat id = av_pix_fmt_desc_get_id(d);
    if (!ffmpeg::addressable(id) || ffmpeg::is_j(id)) continue;
    ++formats;
    Frame frame = FramePool().allocate(test::picture(d->name, width, height));
    std::mt19937 random(7);
    const std::uint8_t* data[4] = {};
    int strides[4] = {};
    for (int p = 0; p < frame.format.pixels.planes; ++p) {
      const Plane& plane = frame.planes[static_cast<std::size_t>(p)];
      ASSERT_EQ(plane.row_bytes, av_image_get_linesize(id, width, p)) << d->name << " plane " << p;
      for (std::ptrdiff_t i = 0; i < plane.stride_bytes * plane.rows; ++i) {
        plane.data[i] = static_cast<std::uint8_t>(random());
      }
      data[p] = plane.data;
      strides[p] = static_cast<int>(plane.stride_bytes);
    }
    for (int c = 0; c < frame.format.pixels.components; ++c) {
      const int columns = frame.format.component_width_px(c);
      for (int y = 0; y < frame.format.component_height_px(c); ++y) {
        std::vector<std::uint16_t> expected(static_cast<std::size_t>(columns));
        av_read_image_line2(expected.data(), data, strides, d, 0, y, c, columns, 0, 2);
        for (int x = 0; x < columns; ++x) {
          ASSERT_EQ(read_sample(frame, c, x, y), expected[static_cast<std::size_t>(x)])
              << d->name << " component " << c << " at " << x << "," << y;
        }
      }
    }
  }
  EXPECT_GT(formats, 100);
}

TEST(PixelFormat, ConvertsWhatHasNoSamplesOfItsOwn) {
  using ffmpeg::nearest_addressable;
  EXPECT_EQ(nearest_addressable(AV_PIX_FMT_PAL8, true), AV_PIX_FMT_RGB24);
  EXPECT_EQ(nearest_addressable(AV_PIX_FMT_PAL8, false), AV_PIX_FMT_RGBA);
  EXPECT_EQ(nearest_addressable(AV_PIX_FMT_MONOBLACK, true), AV_PIX_FMT_GRAY8);
  EXPECT_EQ(nearest_addressable(AV_PIX_FMT_RGB565LE, true), AV_PIX_FMT_RGB24);
  EXPECT_EQ(nearest_addressable(AV_PIX_FMT_GBRPF32LE, true), AV_PIX_FMT_RGB48LE);
  EXPECT_EQ(nearest_addressable(AV_PIX_FMT_GRAYF32LE, true), AV_PIX_FMT_GRAY16LE);
  EXPECT_EQ(nearest_addressable(AV_PIX_FMT_XYZ12LE, true), AV_PIX_FMT_RGB48LE);
  EXPECT_EQ(nearest_addressable(AV_PIX_FMT_YUV420P10LE, true), AV_PIX_FMT_YUV420P10LE);
}

TEST(PixelFormat, YuvjIsYuv) {
  EXPECT_EQ(ffmpeg::to_pixel_format(AV_PIX_FMT_YUVJ420P).name, "yuv420p");
  EXPECT_EQ(ffmpeg::to_pixel_format(AV_PIX_FMT_YUVJ420P), ffmpeg::to_pixel_format(AV_PIX_FMT_YUV420P));
}

}  // namespace
}  // namespace rinkaku

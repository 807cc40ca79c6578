#include "pipeline/track/luma.h"

#include <functional>

#include <gtest/gtest.h>

#include "tests/pipeline/track/track_test_support.h"

namespace rinkaku::track {
namespace {

// A frame of this layout with every byte set from `value(plane, row, byte)`.
Frame filled(const PixelFormat& pixels, int width, int height, const std::function<int(int, int, int)>& value) {
  PictureFormat format;
  format.width_px = width;
  format.height_px = height;
  format.pixels = pixels;
  FramePool pool;
  Frame frame = pool.allocate(format);
  for (int p = 0; p < pixels.planes; ++p) {
    for (int y = 0; y < frame.planes[static_cast<std::size_t>(p)].rows; ++y) {
      for (int x = 0; x < frame.planes[static_cast<std::size_t>(p)].row_bytes; ++x) {
        frame.planes[static_cast<std::size_t>(p)].data[y * frame.planes[static_cast<std::size_t>(p)].stride_bytes + x] =
            static_cast<std::uint8_t>(value(p, y, x));
      }
    }
  }
  return frame;
}

TEST(Luma, OfEightBitPlanarIsTheFramesOwnPlane) {
  PixelFormat yuv{
      "yuv420p", ColourModel::Yuv, 3, 3, false, false, 1, 1, {{{0, 1, 0, 0, 8}, {1, 1, 0, 0, 8}, {2, 1, 0, 0, 8}}}};
  const Frame frame = filled(yuv, 7, 5, [](int p, int y, int x) { return 50 * p + 10 * y + x; });
  cv::Mat scratch;
  const cv::Mat grey = luma(frame, scratch);
  EXPECT_EQ(grey.data, frame.planes[0].data);
  EXPECT_TRUE(scratch.empty());
  EXPECT_EQ(grey.size(), cv::Size(7, 5));
  EXPECT_EQ(grey.at<std::uint8_t>(4, 6), 46);
}

TEST(Luma, OfTenBitDropsTheLowestBits) {
  PixelFormat yuv{"yuv420p10le",
                  ColourModel::Yuv,
                  3,
                  3,
                  false,
                  false,
                  1,
                  1,
                  {{{0, 2, 0, 0, 10}, {1, 2, 0, 0, 10}, {2, 2, 0, 0, 10}}}};
  // 0x02D7 = 727: a quarter is 181.
  const Frame little = filled(yuv, 3, 3, [](int, int, int x) { return x % 2 ? 0x02 : 0xD7; });
  cv::Mat scratch;
  EXPECT_EQ(luma(little, scratch).at<std::uint8_t>(2, 2), 181);
  yuv.big_endian = true;
  const Frame big = filled(yuv, 3, 3, [](int, int, int x) { return x % 2 ? 0xD7 : 0x02; });
  EXPECT_EQ(luma(big, scratch).at<std::uint8_t>(2, 2), 181);
  // P010: the same value six bits higher.
  PixelFormat p010{
      "p010le", ColourModel::Yuv, 2, 3, false, false, 1, 1, {{{0, 2, 0, 6, 10}, {1, 4, 0, 6, 10}, {1, 4, 2, 6, 10}}}};
  const int raw = 727 << 6;
  const Frame shifted = filled(p010, 4, 4, [&](int, int, int x) { return x % 2 ? raw >> 8 : raw & 255; });
  EXPECT_EQ(luma(shifted, scratch).at<std::uint8_t>(3, 3), 181);
}

TEST(Luma, OfPackedYuvIsPickedOut) {
  // UYVY: Y at bytes 1 and 3.
  PixelFormat uyvy{
      "uyvy422", ColourModel::Yuv, 1, 3, false, false, 1, 0, {{{0, 2, 1, 0, 8}, {0, 4, 0, 0, 8}, {0, 4, 2, 0, 8}}}};
  const Frame frame = filled(uyvy, 6, 2, [](int, int, int x) { return x % 2 ? 100 + x / 2 : 7; });
  cv::Mat scratch;
  const cv::Mat grey = luma(frame, scratch);
  for (int x = 0; x < 6; ++x) EXPECT_EQ(grey.at<std::uint8_t>(1, x), 100 + x);
}

TEST(Luma, OfRgbIsWeighted) {
  PixelFormat rgb{
      "rgb24", ColourModel::Rgb, 1, 3, false, false, 0, 0, {{{0, 3, 0, 0, 8}, {0, 3, 1, 0, 8}, {0, 3, 2, 0, 8}}}};
  const Frame frame = filled(rgb, 5, 3, [](int, int, int x) { return x % 3 == 0 ? 200 : x % 3 == 1 ? 100 : 50; });
  cv::Mat scratch;
  // 0.299 * 200 + 0.587 * 100 + 0.114 * 50 = 124.2
  EXPECT_EQ(luma(frame, scratch).at<std::uint8_t>(2, 4), 124);
  const Frame white = filled(rgb, 5, 3, [](int, int, int) { return 255; });
  EXPECT_EQ(luma(white, scratch).at<std::uint8_t>(0, 0), 255);
}

TEST(Luma, OfFewBitsIsStretched) {
  // RGB565 little-endian, all ones.
  PixelFormat rgb{
      "rgb565le", ColourModel::Rgb, 1, 3, false, false, 0, 0, {{{0, 2, 1, 3, 5}, {0, 2, 0, 5, 6}, {0, 2, 0, 0, 5}}}};
  const Frame frame = filled(rgb, 3, 2, [](int, int, int) { return 255; });
  cv::Mat scratch;
  EXPECT_EQ(luma(frame, scratch).at<std::uint8_t>(1, 2), 255);
}

}  // namespace
}  // namespace rinkaku::track

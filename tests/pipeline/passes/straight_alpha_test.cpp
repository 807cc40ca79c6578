#include "pipeline/passes/composite/straight_alpha.h"

#include <random>

#include <gtest/gtest.h>

extern "C" {
#include <libavutil/pixfmt.h>
}

#include "pipeline/ffmpeg/formats.h"
#include "tests/pipeline/passes/blend_reference.h"

namespace rinkaku::test {
namespace {

using passes::Layer;

const std::uint8_t* pixel(const Frame& frame, int x, int y) {
  return frame.planes[0].data + y * frame.planes[0].stride_bytes + 4 * x;
}

Frame straight(FramePool& pool, const Layer& layer, double opacity = 1) {
  std::mt19937 random(2);
  Frame frame = random_frame(pool, passes::rgba_format(35, 29, {1, 1}), random);
  passes::to_straight_alpha(layer, opacity, frame);
  return frame;
}

TEST(StraightAlpha, FormatIsFFmpegsRgba) {
  const PictureFormat format = passes::rgba_format(35, 29, {4, 3});
  EXPECT_EQ(format.pixels, ffmpeg::to_pixel_format(AV_PIX_FMT_RGBA));
  EXPECT_EQ(format.width_px, 35);
  EXPECT_EQ(format.height_px, 29);
  EXPECT_EQ(format.sample_aspect, (Rational{4, 3}));
}

// Every premultiplied value there is: colour 0..alpha under alpha 1..255.
TEST(StraightAlpha, MultipliesBackToTheLayer) {
  FramePool pool;
  Frame frame = pool.allocate(passes::rgba_format(256, 256, {1, 1}));
  Layer layer = even_layer({0, 0, 256, 256}, 0, 0, 0, 0);
  for (int a = 0; a < 256; ++a) {
    for (int c = 0; c <= a; ++c) {
      std::uint8_t* rgba = layer.rgba.data() + (a * 256 + c) * 4;
      rgba[0] = static_cast<std::uint8_t>(c);
      rgba[1] = static_cast<std::uint8_t>(a - c);
      rgba[2] = static_cast<std::uint8_t>(a);
      rgba[3] = static_cast<std::uint8_t>(a);
    }
  }
  passes::to_straight_alpha(layer, 1, frame);
  for (int a = 1; a < 256; ++a) {
    for (int c = 0; c <= a; ++c) {
      const std::uint8_t* out = pixel(frame, c, a);
      ASSERT_EQ(out[3], a);
      ASSERT_EQ(std::lround(out[0] * a / 255.0), c) << "alpha " << a;
      ASSERT_EQ(std::lround(out[1] * a / 255.0), a - c) << "alpha " << a;
      ASSERT_EQ(out[2], 255);
    }
  }
}

TEST(StraightAlpha, IsNothingOutsideTheLayer) {
  FramePool pool;
  const Frame frame = straight(pool, even_layer({3, 4, 10, 8}, 10, 20, 30, 200));
  for (int y = 0; y < 29; ++y) {
    for (int x = 0; x < 35; ++x) {
      const bool inside = x >= 3 && x < 13 && y >= 4 && y < 12;
      const std::uint8_t* out = pixel(frame, x, y);
      ASSERT_EQ(out[3], inside ? 200 : 0) << x << ", " << y;
      ASSERT_EQ(out[0], inside ? 13 : 0) << x << ", " << y;  // 10 * 255 / 200 = 12.75
    }
  }
}

TEST(StraightAlpha, OfAnEmptyLayerIsNothing) {
  FramePool pool;
  const Frame frame = straight(pool, Layer{});
  for (int y = 0; y < 29; ++y) {
    for (int x = 0; x < 35; ++x) ASSERT_EQ(pixel(frame, x, y)[3], 0);
  }
}

TEST(StraightAlpha, OpacityFadesAlphaAndKeepsColour) {
  FramePool pool;
  const Layer layer = even_layer({0, 0, 35, 29}, 60, 30, 0, 120);
  for (double opacity : {0.0, 0.25, 0.5, 1.0}) {
    const Frame frame = straight(pool, layer, opacity);
    // Half a code value for rounding, and the opacity itself is rounded to 1/256.
    EXPECT_NEAR(pixel(frame, 5, 5)[3], 120 * opacity, 0.5 + 120.0 / 512) << opacity;
    EXPECT_EQ(pixel(frame, 5, 5)[0], 128) << opacity;  // 60 * 255 / 120 = 127.5
  }
}

// A driver may round colour a step above alpha.
TEST(StraightAlpha, ColourAboveAlphaIsCutOff) {
  FramePool pool;
  EXPECT_EQ(pixel(straight(pool, even_layer({0, 0, 35, 29}, 11, 5, 5, 10)), 0, 0)[0], 255);
}

}  // namespace
}  // namespace rinkaku::test

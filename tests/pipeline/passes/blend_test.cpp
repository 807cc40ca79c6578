#include "pipeline/passes/composite/blend.h"

#include <cmath>
#include <cstring>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

extern "C" {
#include <libavutil/pixfmt.h>
}

#include "pipeline/ffmpeg/formats.h"
#include "tests/pipeline/passes/blend_reference.h"

namespace rinkaku::test {
namespace {

using passes::Blender;
using passes::Layer;
using passes::PixelRect;
using Range = ColourTags::Range;

// Half a code value for rounding, and a hundredth for sums in float: at 16 bits a float holds 1/256 of a code value.
constexpr double rounding = 0.51;

// Blends, and checks every byte of the frame against the reference.
void expect_blended(Frame frame, const Layer& layer, double opacity, int matrix, bool full) {
  FramePool pool;
  Frame before = frame;
  before.let_go = nullptr;
  pool.make_writable(before);
  const std::vector<std::uint8_t> bytes_before = all_bytes(frame);
  Blender().blend(frame, layer, opacity);

  const PictureFormat& format = frame.format;
  for (int c = 0; c < format.pixels.components; ++c) {
    const double largest = std::pow(2.0, format.pixels.component[c].depth_bits) - 1;
    for (int y = 0; y < format.component_height_px(c); ++y) {
      for (int x = 0; x < format.component_width_px(c); ++x) {
        const int was = sample(before, c, x, y), is = sample(frame, c, x, y);
        Mean mean = layer_mean(format, layer, c, x, y);
        if (mean.a == 0) {
          ASSERT_EQ(is, was) << format.pixels.name << " component " << c << " at " << x << ", " << y;
          continue;
        }
        mean = {mean.r * opacity, mean.g * opacity, mean.b * opacity, mean.a * opacity};
        const double wish = code_value(format, c, mean, matrix, full) + (1 - mean.a) * was;
        ASSERT_NEAR(is, std::clamp(wish, 0.0, largest), rounding)
            << format.pixels.name << " component " << c << " at " << x << ", " << y;
        set_sample(before, c, x, y, is);
      }
    }
  }
  // With the samples that the layer touches made the same, all other bytes and bits must be the same as well: those
  // beside the picture, unused bytes of packed pixels, unused bits of words. (set_sample clears a word's unused bits,
  // so formats that have some are compared sample by sample only, and in KeepsBitsBesideTheSamples.)
  if (format.pixels.component[0].shift_bits > 0) return;
  for (int p = 0, at = 0; p < format.pixels.planes; ++p) {
    const Plane &now = frame.planes[p], &then = before.planes[p];
    for (int y = 0; y < now.rows; ++y) {
      ASSERT_EQ(std::memcmp(now.data + y * now.stride_bytes, then.data + y * then.stride_bytes,
                            static_cast<std::size_t>(now.row_bytes)),
                0)
          << format.pixels.name << " plane " << p << " row " << y;
      for (std::ptrdiff_t i = now.row_bytes; i < now.stride_bytes; ++i) {
        ASSERT_EQ(now.data[y * now.stride_bytes + i], bytes_before[at + y * now.stride_bytes + i])
            << format.pixels.name << " beside row " << y;
      }
    }
    at += static_cast<int>(now.stride_bytes * now.rows);
  }
}

// random_frame() fills whole words; samples of 9 to 15 bits may only use their own. A plate's alpha is opaque: straight
// alpha below that would ask for another formula.
Frame valid_random_frame(FramePool& pool, const PictureFormat& format, std::mt19937& random) {
  Frame frame = random_frame(pool, format, random);
  for (int c = 0; c < format.pixels.components; ++c) {
    if (sample_bytes(format.pixels.component[c]) == 1) continue;
    for (int y = 0; y < format.component_height_px(c); ++y) {
      for (int x = 0; x < format.component_width_px(c); ++x) set_sample(frame, c, x, y, sample(frame, c, x, y));
    }
  }
  for (int y = 0; format.pixels.has_alpha && y < format.height_px; ++y) {
    const int last = format.pixels.components - 1;
    for (int x = 0; x < format.width_px; ++x) {
      set_sample(frame, last, x, y, (1 << format.pixels.component[last].depth_bits) - 1);
    }
  }
  return frame;
}

class BlendFormat : public testing::TestWithParam<const char*> {};

TEST_P(BlendFormat, AgreesWithTheReferenceAndTouchesNothingElse) {
  std::mt19937 random(7);
  FramePool pool;
  const std::tuple<int, int> sizes[] = {{35, 29}, {36, 28}, {1, 1}, {17, 2}, {2, 33}};
  for (int matrix : {6, 1, 9}) {
    for (Range range : {Range::Limited, Range::Full}) {
      for (auto [width, height] : sizes) {
        const PictureFormat format = picture_format(GetParam(), width, height, matrix, range);
        ASSERT_TRUE(passes::can_blend(format.pixels)) << GetParam();
        const bool full = range == Range::Full || format.pixels.model == ColourModel::Rgb;
        for (int i = 0; i < 6; ++i) {
          PixelRect rect{static_cast<int>(random() % width), static_cast<int>(random() % height), 0, 0};
          rect.width_px = 1 + static_cast<int>(random() % (width - rect.x_px));
          rect.height_px = 1 + static_cast<int>(random() % (height - rect.y_px));
          if (i == 0) rect = {0, 0, width, height};
          const double opacity = i % 3 == 0 ? 1.0 : (1 + random() % 999) / 1000.0;
          expect_blended(valid_random_frame(pool, format, random), random_layer(rect, random), opacity, matrix, full);
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, BlendFormat,
                         testing::Values("yuv420p", "yuv422p", "yuv444p", "yuv440p", "yuv411p", "yuv410p",
                                         "yuv420p10le", "yuv420p10be", "yuv422p12le", "yuv444p16be", "gray", "gray10le",
                                         "gray16be", "nv12", "nv21", "p010le", "p016be", "yuyv422", "uyvy422", "rgb24",
                                         "bgr0", "0rgb", "gbrp", "gbrp10le", "rgb48be", "rgba", "yuva420p"),
                         [](const auto& format) { return std::string("of_") + format.param; });

TEST(Blend, KnowsTheOtherMatrices) {
  std::mt19937 random(8);
  FramePool pool;
  for (int matrix : {5, 7, 8}) {  // FCC's (4) is below
    for (Range range : {Range::Limited, Range::Full}) {
      const PictureFormat format = picture_format("yuv420p", 35, 29, matrix, range);
      expect_blended(random_frame(pool, format, random), random_layer({3, 5, 30, 20}, random), 1, matrix,
                     range == Range::Full);
    }
  }
}

TEST(Blend, KeepsBitsBesideTheSamples) {
  std::mt19937 random(9);
  FramePool pool;
  const PictureFormat format = picture_format("p010le", 35, 29, 1, Range::Limited);
  Frame frame = random_frame(pool, format, random);  // junk in the low six bits
  const std::vector<std::uint8_t> before = all_bytes(frame);
  Blender().blend(frame, even_layer({0, 0, 35, 29}, 200, 100, 50, 255));
  const std::vector<std::uint8_t> after = all_bytes(frame);
  for (std::size_t i = 0; i < before.size(); i += 2) ASSERT_EQ(before[i] & 63, after[i] & 63) << "byte " << i;
}

struct KnownColour {
  const char* what;
  const char* pixels;
  int matrix;
  Range range;
  int r, g, b;
  int y, cb, cr;
};

// Limited range, 8 bits: BT.601's and BT.709's colour bars at 100 %, as every table of them has it. Ten bits: the same
// formula times 4 before rounding (BT.601 red's luma is 81.48).
const KnownColour known_colours[] = {
    {"601_red", "yuv420p", 6, Range::Limited, 255, 0, 0, 81, 90, 240},
    {"601_green", "yuv420p", 6, Range::Limited, 0, 255, 0, 145, 54, 34},
    {"601_blue", "yuv420p", 5, Range::Limited, 0, 0, 255, 41, 240, 110},
    {"709_red", "yuv420p", 1, Range::Limited, 255, 0, 0, 63, 102, 240},
    {"709_green", "yuv422p", 1, Range::Limited, 0, 255, 0, 173, 42, 26},
    {"709_blue", "yuv444p", 1, Range::Limited, 0, 0, 255, 32, 240, 118},
    {"white", "yuv420p", 1, Range::Limited, 255, 255, 255, 235, 128, 128},
    {"black", "yuv420p", 6, Range::Limited, 0, 0, 0, 16, 128, 128},
    {"full_white", "yuv420p", 6, Range::Full, 255, 255, 255, 255, 128, 128},
    {"full_red", "yuv420p", 6, Range::Full, 255, 0, 0, 76, 85, 255},  // JPEG's red
    {"ten_bits_601_red", "yuv420p10le", 6, Range::Limited, 255, 0, 0, 326, 361, 960},
    {"ten_bits_white", "yuv420p10be", 9, Range::Limited, 255, 255, 255, 940, 512, 512},
};

TEST(Blend, GivesKnownColoursUnderAlpha255) {
  std::mt19937 random(10);
  FramePool pool;
  for (const KnownColour& known : known_colours) {
    Frame frame = random_frame(pool, picture_format(known.pixels, 35, 29, known.matrix, known.range), random);
    Blender().blend(frame, even_layer({0, 0, 35, 29}, known.r, known.g, known.b, 255));
    for (int c = 0; c < 3; ++c) {
      const int wish = c == 0 ? known.y : c == 1 ? known.cb : known.cr;
      for (int y = 0; y < frame.format.component_height_px(c); ++y) {
        for (int x = 0; x < frame.format.component_width_px(c); ++x) {
          ASSERT_EQ(sample(frame, c, x, y), wish) << known.what << " component " << c;
        }
      }
    }
  }
}

TEST(Blend, FccRed) {
  FramePool pool;
  std::mt19937 random(11);
  Frame frame = random_frame(pool, picture_format("yuv444p", 8, 8, 4, Range::Limited), random);
  Blender().blend(frame, even_layer({0, 0, 8, 8}, 255, 0, 0, 255));
  EXPECT_EQ(sample(frame, 0, 3, 3), 82);  // 16 + 219 * 0.30 = 81.7
  EXPECT_EQ(sample(frame, 1, 3, 3), 90);  // 128 - 224 * 0.30 / (2 * 0.89) = 90.2
  EXPECT_EQ(sample(frame, 2, 3, 3), 240);
}

TEST(Blend, TakesUnspecifiedTagsAsPlayersDo) {
  FramePool pool;
  auto red_luma = [&](const char* pixels, int width, int height) {
    Frame frame = pool.allocate(picture_format(pixels, width, height, 2, Range::Unspecified));
    Blender().blend(frame, even_layer({0, 0, 2, 2}, 255, 0, 0, 255));
    return sample(frame, 0, 0, 0);
  };
  EXPECT_EQ(red_luma("yuv420p", 1280, 720), 63);
  EXPECT_EQ(red_luma("yuv420p", 720, 576), 81);
  EXPECT_EQ(red_luma("yuv420p", 640, 480), 81);
  EXPECT_EQ(red_luma("gray", 640, 480), 76);  // full range: 0.299 * 255
  // The sink tags untagged pictures by this rule; blending by another one would tint the CG.
  for (auto [width, height] : {std::pair{1024, 600}, {1024, 576}, {1279, 576}, {1280, 300}, {480, 640}, {480, 720}}) {
    const bool is_709 = ffmpeg::assumed_matrix(width, height) == AVCOL_SPC_BT709;
    EXPECT_EQ(red_luma("yuv420p", width, height), is_709 ? 63 : 81) << width << "x" << height;
  }
}

TEST(Blend, OpacityZeroChangesNothing) {
  std::mt19937 random(12);
  FramePool pool;
  for (double opacity : {0.0, -1.0}) {
    Frame frame = random_frame(pool, picture_format("yuv420p", 35, 29, 1, Range::Limited), random);
    const std::vector<std::uint8_t> before = all_bytes(frame);
    Blender().blend(frame, random_layer({0, 0, 35, 29}, random), opacity);
    EXPECT_EQ(all_bytes(frame), before);
  }
}

TEST(Blend, OpacityHalfIsHalfway) {
  FramePool pool;
  Frame frame = pool.allocate(picture_format("rgb24", 2, 2, 0, Range::Full));
  for (int c = 0; c < 3; ++c) set_sample(frame, c, 0, 0, 100);
  Blender().blend(frame, even_layer({0, 0, 1, 1}, 200, 100, 0, 255), 0.5);
  EXPECT_EQ(sample(frame, 0, 0, 0), 150);
  EXPECT_EQ(sample(frame, 1, 0, 0), 100);
  EXPECT_EQ(sample(frame, 2, 0, 0), 50);
}

TEST(Blend, OpacityOverOneIsOne) {
  FramePool pool;
  Frame frame = pool.allocate(picture_format("gray", 2, 2, 1, Range::Full));
  set_sample(frame, 0, 0, 0, 80);
  Blender().blend(frame, even_layer({0, 0, 1, 1}, 128, 128, 128, 128), 7);
  EXPECT_EQ(sample(frame, 0, 0, 0), 168);  // 128 + 80 * 127 / 255
}

// A chroma block that is covered by a quarter takes a quarter of the colour, not the corner pixel's all or nothing.
TEST(Blend, AveragesChromaOverTheBlock) {
  FramePool pool;
  Frame frame = pool.allocate(picture_format("yuv420p", 4, 4, 6, Range::Limited));
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < frame.format.component_height_px(c); ++y) {
      for (int x = 0; x < frame.format.component_width_px(c); ++x) set_sample(frame, c, x, y, 100);
    }
  }
  Blender().blend(frame, even_layer({1, 1, 1, 1}, 255, 0, 0, 255));
  EXPECT_EQ(sample(frame, 2, 0, 0), 135);  // 100 * 3/4 + 240 / 4
  EXPECT_EQ(sample(frame, 2, 1, 0), 100);
  EXPECT_EQ(sample(frame, 0, 1, 1), 81);
  EXPECT_EQ(sample(frame, 0, 0, 0), 100);
}

// Without this, a picture whose width is odd would get too little colour in its last column.
TEST(Blend, AveragesOnlyOverPixelsOfThePicture) {
  FramePool pool;
  Frame frame = pool.allocate(picture_format("yuv420p", 3, 3, 6, Range::Limited));
  Blender().blend(frame, even_layer({2, 2, 1, 1}, 255, 0, 0, 255));
  EXPECT_EQ(sample(frame, 1, 1, 1), 90);
  EXPECT_EQ(sample(frame, 2, 1, 1), 240);
}

TEST(Blend, RefusesFormatsItCannotWrite) {
  PixelFormat pixels;
  EXPECT_TRUE(passes::can_blend(pixels));
  PixelFormat deep = pixels;
  deep.component[0].depth_bits = 32;
  EXPECT_FALSE(passes::can_blend(deep));
  PixelFormat shifted = pixels;
  shifted.component[2].depth_bits = 16;
  shifted.component[2].shift_bits = 4;
  EXPECT_FALSE(passes::can_blend(shifted));
  PixelFormat none = pixels;
  none.components = 0;
  EXPECT_FALSE(passes::can_blend(none));
}

}  // namespace
}  // namespace rinkaku::test

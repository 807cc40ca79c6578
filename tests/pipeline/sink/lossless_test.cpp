#include "tests/pipeline/sink/sink_tools.h"

namespace rinkaku {
namespace {

using Range = ColourTags::Range;

struct Case {
  const char* pixels;
  int width, height;
  ColourTags colour;
  const char* codec;
  const char* file;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.codec << " " << c.pixels << " " << c.width << "x" << c.height;
}

constexpr ColourTags bt709{1, 1, 1, Range::Limited, 1};
constexpr ColourTags bt601_full{6, 6, 6, Range::Full, 2};
constexpr ColourTags bt709_full{1, 1, 1, Range::Full, 1};
constexpr ColourTags untagged{};

class Lossless : public testing::TestWithParam<Case> {};

// What goes in comes out, sample for sample and tag for tag, by our own reader and by the ffmpeg program.
TEST_P(Lossless, IsBitIdentical) {
  const Case& c = GetParam();
  const test::TemporaryFolder folder;
  const std::string path = folder / c.file;
  const PictureFormat format = test::picture(c.pixels, c.width, c.height, c.colour);
  const auto frames = test::noise_frames(format, 7);
  EXPECT_EQ(test::write_all({.path = path, .codec = c.codec}, test::incoming(format), frames), "");
  auto source = source::open(path);
  const auto back = test::all_frames(*source);
  ASSERT_EQ(back.size(), frames.size());
  std::string expected;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_TRUE(test::samples(back[i]) == test::samples(frames[i])) << "frame " << i;
    EXPECT_NEAR(back[i].time_s(), frames[i].time_s(), 5e-4);  // Matroska counts milliseconds
    expected += test::samples(frames[i]);
  }
  EXPECT_TRUE(test::decoded_by_ffmpeg(path) == expected);
  EXPECT_EQ(source->description().format.pixels, format.pixels);
  const ColourTags& colour = source->description().format.colour;
  EXPECT_EQ(colour.primaries, c.colour.primaries);
  EXPECT_EQ(colour.transfer, c.colour.transfer);
  EXPECT_EQ(colour.matrix, c.colour.matrix);
  EXPECT_EQ(colour.range, c.colour.range);
  EXPECT_EQ(source->damage(), "");
}

INSTANTIATE_TEST_SUITE_P(
    Ffv1, Lossless,
    testing::Values(
        Case{"yuv420p", 64, 48, bt709, "ffv1", "a.mkv"}, Case{"yuv420p", 35, 29, bt601_full, "ffv1", "a.mkv"},
        Case{"yuv420p", 35, 29, untagged, "ffv1", "a.mkv"}, Case{"yuv422p", 35, 29, bt709_full, "ffv1", "a.mkv"},
        Case{"yuv422p", 64, 48, bt709, "ffv1", "a.mkv"}, Case{"yuv444p", 35, 29, bt709, "ffv1", "a.mkv"},
        Case{"yuv444p", 35, 29, bt601_full, "ffv1", "a.mkv"}, Case{"yuv420p10le", 35, 29, bt709, "ffv1", "a.mkv"},
        Case{"yuv420p10le", 64, 48, bt601_full, "ffv1", "a.mkv"}, Case{"gray", 35, 29, untagged, "ffv1", "a.mkv"},
        Case{"gray", 64, 48, bt709, "ffv1", "a.mkv"}, Case{"yuva420p", 35, 29, bt709, "ffv1", "a.mkv"}));
INSTANTIATE_TEST_SUITE_P(Ffvhuff, Lossless,
                         testing::Values(Case{"yuv420p", 64, 48, bt709, "ffvhuff", "a.mkv"},
                                         Case{"yuv420p", 64, 48, bt601_full, "ffvhuff", "a.mkv"},
                                         Case{"yuv422p", 64, 48, bt709, "ffvhuff", "a.mkv"},
                                         Case{"yuv444p", 35, 29, bt709, "ffvhuff", "a.mkv"},
                                         Case{"yuv420p10le", 64, 48, bt709, "ffvhuff", "a.mkv"},
                                         Case{"yuv420p", 64, 48, untagged, "ffvhuff", "a.avi"}));

// Packed and big-endian layouts, and an RGB order that FFV1 knows only otherwise.
TEST(LosslessConversion, IsSaidAndLosesNothing) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("rgb24", 35, 29);
  const auto frames = test::noise_frames(format, 3);
  const std::string path = folder / "a.mkv";
  const std::string notice = test::write_all({.path = path, .codec = "ffv1"}, test::incoming(format), frames);
  EXPECT_NE(notice.find("rgb24"), std::string::npos);
  EXPECT_NE(notice.find("without loss"), std::string::npos);
  std::string expected;
  for (const Frame& frame : frames) expected += test::samples(frame);
  EXPECT_TRUE(test::decoded_by_ffmpeg(path, "-pix_fmt rgb24") == expected);
}

TEST(LossyConversion, IsSaid) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("yuv444p", 64, 48, bt709);
  const std::string notice = test::write_all({.path = folder / "a.mp4", .codec = "mpeg4"}, test::incoming(format),
                                             test::noise_frames(format, 3));
  EXPECT_NE(notice.find("mpeg4 takes no yuv444p: pictures are converted to yuv420p"), std::string::npos);
  EXPECT_EQ(notice.find("without loss"), std::string::npos);
}

class Tags : public testing::TestWithParam<std::pair<const char*, const char*>> {};

// Full range is never pressed into limited range, whatever the codec.
TEST_P(Tags, AreKeptByLossyCodecs) {
  const auto [codec, file] = GetParam();
  const test::TemporaryFolder folder;
  PictureFormat format = test::picture("yuv420p", 64, 48, bt601_full);
  format.sample_aspect = {16, 11};
  auto frames = test::noise_frames(format, 3);
  for (Frame& frame : frames) {
    std::fill_n(frame.planes[0].data, frame.planes[0].stride_bytes * 48, std::uint8_t{255});
  }
  const std::string path = folder / file;
  EXPECT_EQ(test::write_all({.path = path, .codec = codec}, test::incoming(format), frames), "");
  auto source = source::open(path);
  const PictureFormat& got = source->description().format;
  EXPECT_EQ(got.colour.matrix, 6);
  EXPECT_EQ(got.colour.primaries, 6);
  EXPECT_EQ(got.colour.range, Range::Full);
  EXPECT_EQ(got.sample_aspect, format.sample_aspect);
  EXPECT_GE(source->next()->planes[0].data[0], 250);  // 235 after a conversion
}
INSTANTIATE_TEST_SUITE_P(Codecs, Tags,
                         testing::Values(std::pair{"h264", "a.mp4"}, std::pair{"h264", "a.mkv"},
                                         std::pair{"mpeg4", "a.mp4"}, std::pair{"mpeg4", "a.mkv"}));

}  // namespace
}  // namespace rinkaku

#include "tests/pipeline/source/media_tools.h"
#include "tests/support/test_data.h"

namespace rinkaku {
namespace {

namespace fs = std::filesystem;

// 5 images from a%03d.png of that first number.
void make_images(const test::TemporaryFolder& folder, int first) {
  test::ffmpeg("-f lavfi -i testsrc2=size=35x29:rate=25,format=rgb24 -frames:v 5 -start_number " +
               std::to_string(first) + " " + (folder / "a%03d.png").string());
}

TEST(ImageSequence, StartsAtTheLowestNumberThereIs) {
  const test::TemporaryFolder folder;
  make_images(folder, 98);
  auto source = source::open(folder / "a%03d.png", {.image_rate = {30000, 1001}});
  EXPECT_EQ(source->description().frame_count, 5);
  EXPECT_EQ(source->description().frame_rate, (Rational{30000, 1001}));
  EXPECT_EQ(source->description().format.pixels.name, "rgb24");
  const auto frames = test::all_frames(*source);
  ASSERT_EQ(frames.size(), 5u);
  const std::string expected = test::decoded_by_ffmpeg(folder / "a098.png");
  EXPECT_EQ(test::samples(frames[0]), expected);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(frames[i].number, static_cast<std::int64_t>(i));
    EXPECT_NEAR(frames[i].time_s(), static_cast<double>(i) * 1001 / 30000, 1e-9);
  }
  EXPECT_EQ(source->damage(), "");
}

TEST(ImageSequence, StopsAtAGapAndSaysSo) {
  const test::TemporaryFolder folder;
  make_images(folder, 7);
  fs::remove(folder / "a009.png");
  auto source = source::open(folder / "a%03d.png");
  EXPECT_EQ(test::all_frames(*source).size(), 2u);
  EXPECT_NE(source->damage().find("a009.png is missing"), std::string::npos);
  EXPECT_NE(source->damage().find("2 later pictures"), std::string::npos);
}

TEST(ImageSequence, GlobIsReadInTheNamesOrder) {
  const test::TemporaryFolder folder;
  make_images(folder, 1);
  auto numbered = source::open(folder / "a%03d.png");
  auto globbed = source::open(folder / "*.png");
  const auto a = test::all_frames(*numbered), b = test::all_frames(*globbed);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(test::samples(a[i]), test::samples(b[i]));
}

TEST(ImageSequence, AFileOfThatVeryNameComesFirst) {
  const test::TemporaryFolder folder;
  make_images(folder, 1);
  fs::copy(folder / "a003.png", folder / "b[1].png");
  fs::copy(folder / "a003.png", folder / "c%d.png");
  for (const char* name : {"b[1].png", "c%d.png"}) {
    auto source = source::open(folder / name);
    EXPECT_EQ(test::all_frames(*source).size(), 1u) << name;
  }
}

TEST(ImageSequence, PicturesOfAnotherSizeAreBroughtToTheFirstOnes) {
  const test::TemporaryFolder folder;
  make_images(folder, 1);
  test::ffmpeg("-f lavfi -i testsrc2=size=70x58,format=gray -frames:v 1 -update 1 " + (folder / "a003.png").string());
  auto source = source::open(folder / "a%03d.png");
  const auto frames = test::all_frames(*source);
  ASSERT_EQ(frames.size(), 5u);
  for (const Frame& frame : frames) EXPECT_EQ(frame.format, source->description().format);
  EXPECT_NE(source->damage().find("1 picture of another size"), std::string::npos);
}

TEST(ImageSequence, PaletteBecomesRgb) {
  const test::TemporaryFolder folder;
  const std::string image = folder / "pal.png";
  test::ffmpeg(
      "-f lavfi -i "
      "'testsrc=size=64x48:duration=0.04,split[a][b];[a]palettegen=reserve_transparent=0[p];[b][p]paletteuse' "
      "-frames:v 1 -pix_fmt pal8 " +
      image);
  auto source = source::open(image);
  EXPECT_EQ(source->description().format.pixels.name, "rgb24");
  EXPECT_NE(source->description().notice.find("pal8"), std::string::npos);
  const auto frames = test::all_frames(*source);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(test::samples(frames[0]), test::decoded_by_ffmpeg(image, "-pix_fmt rgb24"));
}

TEST(ImageSequence, SixteenBitImageKeepsItsSamples) {
  RINKAKU_NEEDS_DATA();
  const std::string image = test::data("recordings/clips/mdn_chromakey_backdrop.png").string();
  auto source = source::open(image);
  EXPECT_EQ(source->description().format.pixels.name, "rgb48be");
  const auto frames = test::all_frames(*source);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(test::samples(frames[0]), test::decoded_by_ffmpeg(image));
}

}  // namespace
}  // namespace rinkaku

#include <set>

#include "tests/pipeline/sink/sink_tools.h"

namespace rinkaku {
namespace {

TEST(ImageSink, StraightAlphaIsKept) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("rgba", 35, 29);
  const auto frames = test::noise_frames(format, 5);
  EXPECT_EQ(test::write_all({.path = folder / "a%03d.png"}, test::incoming(format), frames), "");
  for (const Frame& frame : frames) {
    const std::string file = folder / ("a00" + std::to_string(frame.number) + ".png");
    EXPECT_TRUE(test::decoded_by_ffmpeg(file, "-pix_fmt rgba") == test::samples(frame)) << file;
  }
  auto source = source::open(folder / "a%03d.png");
  EXPECT_EQ(source->description().format.pixels.name, "rgba");
  EXPECT_EQ(test::all_frames(*source).size(), 5u);
}

TEST(ImageSink, FilesAreNamedByTheFramesNumbers) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("rgb24", 16, 16);
  auto frames = test::noise_frames(format, 12);
  frames.erase(frames.begin(), frames.begin() + 10);
  test::write_all({.path = folder / "a%d.png"}, test::incoming(format), frames);
  EXPECT_TRUE(std::filesystem::exists(folder / "a10.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "a11.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a0.png"));
}

TEST(ImageSink, ExistingPicturesAreNotWrittenOver) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("rgb24", 16, 16);
  const auto frames = test::noise_frames(format, 2);
  sink::Options options{.path = folder / "a%02d.png"};
  test::write_all(options, test::incoming(format), frames);
  const std::string line = test::error_of(Error::Kind::Input, [&] { sink::open(options, test::incoming(format)); });
  EXPECT_NE(line.find("--force"), std::string::npos);
  options.overwrite = true;
  test::write_all(options, test::incoming(format), frames);
}

TEST(ImageSink, UnfinishedLeavesNothing) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("rgb24", 16, 16);
  {
    auto sink = sink::open({.path = folder / "a%02d.png", .threads = 1}, test::incoming(format));
    for (const Frame& frame : test::noise_frames(format, 3)) sink->write(frame);
  }
  EXPECT_TRUE(test::is_empty(folder.path()));
}

// A run that fails or is killed half way has changed nothing but hidden files.
TEST(ImageSink, OldPicturesStayUntilTheNewAreWhole) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("rgb24", 16, 16);
  const auto frames = test::noise_frames(format, 6);
  const sink::Options options{.path = folder / "a%d.png", .threads = 1, .overwrite = true};
  test::write_all(options, test::incoming(format), {frames[2], frames[3]});
  const std::string kept = test::decoded_by_ffmpeg(folder / "a2.png");
  const auto seen = [&folder] {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(".")) names.insert(name);
    }
    return names;
  };
  {
    std::vector<Frame> other = test::noise_frames(format, 6);
    for (Frame& frame : other) frame.planes[0].data[0] ^= 1;
    auto sink = sink::open(options, test::incoming(format));
    for (const Frame& frame : other) sink->write(frame);
    EXPECT_EQ(seen(), (std::set<std::string>{"a2.png", "a3.png"}));
    EXPECT_TRUE(test::decoded_by_ffmpeg(folder / "a2.png") == kept);
  }
  EXPECT_TRUE(test::decoded_by_ffmpeg(folder / "a2.png") == kept);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
  test::write_all(options, test::incoming(format), frames);
  EXPECT_EQ(seen().size(), 6u);
}

TEST(ImageSink, NameWithoutNumberTakesOneFrame) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("rgb24", 16, 16);
  const auto frames = test::noise_frames(format, 2);
  test::write_all({.path = folder / "a.png"}, test::incoming(format), {frames[0]});
  EXPECT_TRUE(test::decoded_by_ffmpeg(folder / "a.png") == test::samples(frames[0]));
  const std::string line = test::error_of(
      Error::Kind::Input, [&] { test::write_all({.path = folder / "b.png"}, test::incoming(format), frames); });
  EXPECT_NE(line.find("%04d"), std::string::npos);
}

TEST(ImageSink, YuvKeepsItsColours) {
  const test::TemporaryFolder folder;
  // BT.709, limited: (16, 128, 128) is black, (235, 128, 128) white, and (63, 102, 240) pure red.
  PictureFormat format = test::picture("yuv444p", 16, 16, {1, 1, 1, ColourTags::Range::Limited, 0});
  Frame frame = test::noise(format, 0);
  const std::uint8_t red[3] = {63, 102, 240};
  for (std::size_t p = 0; p < 3; ++p) std::fill_n(frame.planes[p].data, frame.planes[p].stride_bytes * 16, red[p]);
  test::write_all({.path = folder / "a.png"}, test::incoming(format), {frame});
  const std::string rgb = test::decoded_by_ffmpeg(folder / "a.png", "-pix_fmt rgb24");
  EXPECT_GE(static_cast<unsigned char>(rgb[0]), 253);
  EXPECT_LE(static_cast<unsigned char>(rgb[1]), 2);
  EXPECT_LE(static_cast<unsigned char>(rgb[2]), 2);
}

TEST(ImageSink, JpegDropsAlphaAndSaysSo) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("rgba", 16, 16);
  const std::string notice =
      test::write_all({.path = folder / "a.jpg"}, test::incoming(format), test::noise_frames(format, 1));
  EXPECT_NE(notice.find("alpha is lost"), std::string::npos);
}

}  // namespace
}  // namespace rinkaku

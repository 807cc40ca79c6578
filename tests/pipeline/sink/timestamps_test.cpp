#include <cmath>

#include "tests/pipeline/sink/sink_tools.h"

namespace rinkaku {
namespace {

std::vector<double> times(const std::string& path) {
  auto source = source::open(path);
  std::vector<double> out;
  for (const Frame& frame : test::all_frames(*source)) out.push_back(frame.time_s());
  return out;
}

// Frames at uneven times in a unit too fine for MPEG-4, from a start that is not 0.
std::vector<Frame> uneven_frames(const PictureFormat& format) {
  std::vector<Frame> frames;
  std::int64_t pts = 45001;
  for (int i = 0; i < 40; ++i) {
    frames.push_back(test::noise(format, i, {1, 90000}));
    frames.back().pts = pts;
    frames.back().duration = 1501 + 3001 * (i % 3);
    pts += frames.back().duration;
  }
  return frames;
}

struct Case {
  const char* codec;
  const char* file;
  double tolerance_s;
};
class VariableRate : public testing::TestWithParam<Case> {};

TEST_P(VariableRate, KeepsEveryTime) {
  const Case& c = GetParam();
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("yuv420p", 64, 48);
  const auto frames = uneven_frames(format);
  sink::Incoming coming = test::incoming(format);
  coming.time_base = {1, 90000};
  coming.variable_frame_rate = true;
  const std::string path = folder / c.file;
  EXPECT_EQ(test::write_all({.path = path, .codec = c.codec}, coming, frames), "");
  const auto got = times(path);
  ASSERT_EQ(got.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_NEAR(got[i], frames[i].time_s(), c.tolerance_s) << i;
}
// MP4 keeps the unit; Matroska rounds to a millisecond.
INSTANTIATE_TEST_SUITE_P(Containers, VariableRate,
                         testing::Values(Case{"mpeg4", "a.mp4", 1e-9}, Case{"libx264", "a.mp4", 1e-9},
                                         Case{"mpeg4", "a.mkv", 5.1e-4}, Case{"libx264", "a.mkv", 5.1e-4},
                                         Case{"ffv1", "a.mkv", 5.1e-4}));

TEST(Timestamps, AviRefusesUnevenTimes) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("yuv420p", 64, 48);
  sink::Incoming coming = test::incoming(format);
  coming.time_base = {1, 90000};
  coming.variable_frame_rate = true;
  const sink::Options options{.path = folder / "a.avi"};
  auto line = test::error_of(Error::Kind::Input, [&] { sink::open(options, coming); });
  EXPECT_NE(line.find("write to a name ending in .mkv or .mp4"), std::string::npos);
  // Also where the container did not tell.
  coming.variable_frame_rate = false;
  line = test::error_of(Error::Kind::Input, [&] { test::write_all(options, coming, uneven_frames(format)); });
  EXPECT_NE(line.find("uneven"), std::string::npos);
  EXPECT_TRUE(test::is_empty(folder.path()));
}

TEST(Timestamps, AviKeepsEvenTimesThatMillisecondsBlur) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("yuv420p", 64, 48);
  auto frames = test::noise_frames(format, 60, {1, 1000});
  for (Frame& frame : frames) frame.pts = std::llround(static_cast<double>(frame.number) * 1001 / 60);
  sink::Incoming coming = test::incoming(format, {60000, 1001});
  coming.time_base = {1, 1000};
  test::write_all({.path = folder / "a.avi"}, coming, frames);
  const auto got = times(folder / "a.avi");
  ASSERT_EQ(got.size(), 60u);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_NEAR(got[i], static_cast<double>(i) * 1001 / 60000, 1e-9);
}

class OddRate : public testing::TestWithParam<const char*> {};

TEST_P(OddRate, OfRealClipsIsKept) {
  RINKAKU_NEEDS_DATA();
  for (const char* clip : {"recordings/clips/mdn_chromakey_person.mp4", "recordings/clips/opencv_tree.avi"}) {
    const test::TemporaryFolder folder;
    const std::string from = test::data(clip).string(), to = folder / GetParam();
    test::transcode(from, {.path = to, .codec = "mpeg4"});
    const auto before = times(from), after = times(to);
    ASSERT_EQ(before.size(), after.size());
    const double shift = after[0] - before[0];  // Matroska moves all streams if sound starts before 0
    for (std::size_t i = 0; i < before.size(); ++i) ASSERT_NEAR(after[i] - shift, before[i], 1.1e-3) << i;
    EXPECT_LT(std::abs(shift), 0.05);
  }
}
INSTANTIATE_TEST_SUITE_P(Containers, OddRate, testing::Values("a.mp4", "a.mkv", "a.avi", "a.mov"));

TEST(Timestamps, PartOfAVideoStartsAtZero) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("yuv420p", 64, 48);
  auto frames = test::noise_frames(format, 30);
  frames.erase(frames.begin(), frames.begin() + 10);
  test::write_all({.path = folder / "a.mp4"}, test::incoming(format), frames);
  const auto got = times(folder / "a.mp4");
  ASSERT_EQ(got.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(got[i], static_cast<double>(i) / 25, 1e-9);
}

TEST(Timestamps, FallingTimesAreRefused) {
  const test::TemporaryFolder folder;
  const PictureFormat format = test::picture("yuv420p", 64, 48);
  auto frames = test::noise_frames(format, 3);
  frames[2].pts = 1;
  test::error_of(Error::Kind::Runtime,
                 [&] { test::write_all({.path = folder / "a.mp4"}, test::incoming(format), frames); });
  EXPECT_TRUE(test::is_empty(folder.path()));
}

}  // namespace
}  // namespace rinkaku

// A picture or a video in the plate's place: where, how large, which frame of it.
#include <algorithm>
#include <cmath>
#include <functional>

#include "pipeline/frame/error.h"
#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

using test::ShotFolder;

const PictureFormat small = test::picture("yuv420p", 64, 48, test::bt709_limited);
const PictureFormat grey = test::picture("gray", 64, 48, test::bt709_full);

// Somebody in the picture's upper left corner of 8 x 8 pixels.
void write_corner_mattes(const ShotFolder& folder, int count, Rational rate) {
  std::vector<Frame> frames = test::noise_frames(grey, count, {rate.den, rate.num});
  for (Frame& frame : frames) {
    for (int y = 0; y < 48; ++y) {
      std::uint8_t* row = frame.planes[0].data + y * frame.planes[0].stride_bytes;
      std::fill_n(row, 64, std::uint8_t{0});
      if (y < 8) std::fill_n(row, 8, std::uint8_t{255});
    }
  }
  test::write_all({.path = folder.file("mattes.mkv"), .codec = "ffv1"}, test::incoming(grey, rate), frames);
}

void write_plate(const ShotFolder& folder, int count, Rational rate) {
  test::write_all({.path = folder.file("in.mkv"), .codec = "ffv1"}, test::incoming(small, rate),
                  test::noise_frames(small, count, {rate.den, rate.num}));
  write_corner_mattes(folder, count, rate);
}

// One grey for each column, in a picture of any size.
Frame columns(const PictureFormat& format, int number, Rational rate, const std::function<int(int)>& grey_of) {
  Frame frame = test::noise(format, number, {rate.den, rate.num});
  for (int y = 0; y < format.height_px; ++y) {
    for (int x = 0; x < format.width_px; ++x) {
      frame.planes[0].data[y * frame.planes[0].stride_bytes + x] = static_cast<std::uint8_t>(grey_of(x));
    }
  }
  return frame;
}

std::string scene_with(const std::string& background) {
  return "[plate]\nvideo = \"in.mkv\"\n[background]\n" + background +
         "\n[[foreground]]\nmethod = \"file\"\nfile = { video = \"mattes.mkv\" }\n";
}

std::vector<Frame> rendered(const ShotFolder& folder, const std::string& background, RenderOptions options = {}) {
  options.output = "out.mkv", options.codec = "ffv1", options.overwrite = true;
  folder.render(scene_with(background), options);
  return folder.frames("out.mkv");
}

// Limited range's luma of a grey.
double luma(int value) { return 16 + 219.0 * value / 255; }

TEST(Background, PictureCoversThePlateAndItsMiddleIsKept) {
  const ShotFolder folder;
  write_plate(folder, 2, {25, 1});
  // 128 x 64 covers 64 x 48 at three quarters of its size, 96 x 48: 16 columns go on each side, 21 of its own.
  const PictureFormat wide = test::picture("gray", 128, 64, test::bt709_full);
  const Frame picture = columns(wide, 0, {25, 1}, [](int x) { return x < 20 || x >= 108 ? 255 : x < 64 ? 60 : 180; });
  test::write_all({.path = folder.file("world.png")}, test::incoming(wide), {picture});
  const auto plate = folder.frames("in.mkv"), out = rendered(folder, "image = \"world.png\"");
  ASSERT_EQ(out.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const int got = test::sample(out[i], 0, x, y);
        if (x < 8 && y < 8) {
          ASSERT_EQ(got, test::sample(plate[i], 0, x, y)) << "the plate's own";
        } else if (x < 30 || x >= 34) {
          // A bicubic filter reaches two samples beyond the seam; 8 bits are rounded twice.
          ASSERT_NEAR(got, luma(x < 32 ? 60 : 180), 1) << x << ", " << y;
        }
      }
    }
  }
}

// Of a video whose n-th frame is 20 n + 40.
std::vector<int> shown(const std::vector<Frame>& out) {
  std::vector<int> numbers;
  for (const Frame& frame : out) {
    numbers.push_back(static_cast<int>(std::lround(((test::sample(frame, 0, 40, 30) - 16) * 255.0 / 219 - 40) / 20)));
  }
  return numbers;
}

void write_world(const ShotFolder& folder, const std::string& name, int count, Rational rate) {
  const PictureFormat format = test::picture("gray", 40, 90, test::bt709_full);
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(columns(format, i, rate, [i](int) { return 20 * i + 40; }));
  }
  test::write_all({.path = folder.file(name), .codec = name.ends_with(".mkv") ? "ffv1" : ""},
                  test::incoming(format, rate), frames);
}

TEST(Background, VideoPlaysAtItsOwnPaceAndBeginsAgain) {
  const ShotFolder folder;
  write_plate(folder, 12, {50, 1});
  write_world(folder, "world.mkv", 5, {25, 1});
  EXPECT_EQ(shown(rendered(folder, "video = \"world.mkv\"")), (std::vector<int>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 0, 0}));
  write_world(folder, "fast.mkv", 9, {100, 1});
  EXPECT_EQ(shown(rendered(folder, "video = \"fast.mkv\"")), (std::vector<int>{0, 2, 4, 6, 8, 1, 3, 5, 7, 0, 2, 4}));
}

// Matroska rounds times to milliseconds, and 24 don't divide a thousand: many rounds stay in step all the same.
TEST(Background, VideoStaysInStepOverManyRounds) {
  const ShotFolder folder;
  write_plate(folder, 60, {24, 1});
  write_world(folder, "world.mkv", 5, {24, 1});
  const std::vector<int> numbers = shown(rendered(folder, "video = \"world.mkv\""));
  ASSERT_EQ(numbers.size(), 60u);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(numbers[static_cast<std::size_t>(i)], i % 5) << i;
}

TEST(Background, VideoStandsWhereItWouldAlsoIfRenderingBeginsLater) {
  const ShotFolder folder;
  write_plate(folder, 9, {25, 1});
  write_world(folder, "world.mkv", 5, {25, 1});
  EXPECT_EQ(shown(rendered(folder, "video = \"world.mkv\"", {.first_frame = 3})), (std::vector<int>{3, 4, 0, 1, 2, 3}));
}

TEST(Background, OfASequenceEachFrameOfThePlateHasTheNext) {
  const ShotFolder folder;
  write_plate(folder, 7, {50, 1});
  std::filesystem::create_directory(folder / "world");
  write_world(folder, "world/%03d.png", 5, {25, 1});
  EXPECT_EQ(shown(rendered(folder, "images = \"world/%03d.png\"")), (std::vector<int>{0, 1, 2, 3, 4, 0, 1}));
}

void expect_refused(const ShotFolder& folder, const std::string& background, const std::string& line) {
  try {
    rendered(folder, background);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_status(), 2);
    EXPECT_NE(std::string(error.what()).find(line), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out.mkv"));
}

TEST(Background, WhatIsMissingOrNoPictureIsRefusedAndNothingWritten) {
  const ShotFolder folder;
  write_plate(folder, 2, {25, 1});
  expect_refused(folder, "image = \"nowhere.png\"", "nowhere.png");
  expect_refused(folder, "video = \"nowhere.mkv\"", "nowhere.mkv");
  expect_refused(folder, "images = \"nowhere/%03d.png\"", "nowhere");
  folder.write("text.png", "no picture");
  expect_refused(folder, "image = \"text.png\"", "text.png");
}

}  // namespace
}  // namespace rinkaku::pipeline

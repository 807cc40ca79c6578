#include "pipeline/source/v4l2/camera.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"
#include "tests/support/fake_camera/fake_camera.h"
#include "tests/support/test_data.h"

namespace rinkaku::source::v4l2 {
namespace {

using test::fake_sample;

constexpr const char* path = "/dev/rinkaku_fake_camera";

class CameraTest : public ::testing::Test {
 protected:
  void SetUp() override {
    set("FAKE_CAMERA", path);
    set("FAKE_CAMERA_FPS", "200");  // so that tests don't wait for pictures
  }
  void TearDown() override {
    for (const std::string& name : set_) unsetenv(name.c_str());
  }
  void set(const std::string& name, const std::string& value) {
    setenv(name.c_str(), value.c_str(), 1);
    set_.push_back(name);
  }
  static std::unique_ptr<Source> open(const ModeWish& wish = {}, const std::vector<ControlWish>& controls = {}) {
    return open_camera({path, wish, controls});
  }
  static std::string complaint(const CameraOptions& options) {
    try {
      open_camera(options);
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_status(), 2);
      return error.what();
    }
    return "nothing was thrown";
  }

 private:
  std::vector<std::string> set_;
};

std::size_t open_descriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

std::uint8_t at(const Frame& frame, std::size_t plane, int x, int y) {
  return frame.planes[plane].data[y * frame.planes[plane].stride_bytes + x];
}

TEST_F(CameraTest, PackedSamplesGetPlanesOfTheirOwn) {
  struct Case {
    const char* format;
    std::size_t y, u, v;  // where the samples of a pair of pixels lie
  };
  for (const Case& c : {Case{"YUYV", 0, 1, 3}, Case{"UYVY", 1, 0, 2}}) {
    set("FAKE_CAMERA_FORMATS", c.format);
    const auto camera = open({.width_px = 320, .height_px = 240});
    EXPECT_EQ(camera->description().format.pixels.name, "yuv422p");
    const Frame frame = *camera->next();
    // Pictures differ by one value in all samples.
    const int shift = at(frame, 0, 0, 0) - fake_sample(0, c.y);
    const auto expected = [shift](std::size_t i) { return static_cast<std::uint8_t>(fake_sample(0, i) + shift); };
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 160; ++x) {
        const std::size_t pair = static_cast<std::size_t>(y) * 640 + static_cast<std::size_t>(x) * 4;
        ASSERT_EQ(at(frame, 0, 2 * x, y), expected(pair + c.y)) << c.format << " " << x << " " << y;
        ASSERT_EQ(at(frame, 0, 2 * x + 1, y), expected(pair + c.y + 2)) << c.format << " " << x << " " << y;
        ASSERT_EQ(at(frame, 1, x, y), expected(pair + c.u)) << c.format << " " << x << " " << y;
        ASSERT_EQ(at(frame, 2, x, y), expected(pair + c.v)) << c.format << " " << x << " " << y;
      }
    }
  }
}

TEST_F(CameraTest, PlanarSamplesKeepTheirValues) {
  constexpr std::size_t luma_bytes = 320 * 240;
  for (const std::string format : {"NV12", "YU12", "GREY"}) {
    set("FAKE_CAMERA_FORMATS", format);
    const auto camera = open({.width_px = 320, .height_px = 240});
    EXPECT_EQ(camera->description().format.pixels.name, format == "GREY" ? "gray" : "yuv420p");
    const Frame frame = *camera->next();
    const int shift = at(frame, 0, 0, 0) - fake_sample(0, 0);
    const auto expected = [shift](std::size_t i) { return static_cast<std::uint8_t>(fake_sample(0, i) + shift); };
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 320; ++x) {
        ASSERT_EQ(at(frame, 0, x, y), expected(static_cast<std::size_t>(y) * 320 + static_cast<std::size_t>(x)));
      }
    }
    for (int y = 0; y < 120 && format != "GREY"; ++y) {
      for (int x = 0; x < 160; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * 160 + static_cast<std::size_t>(x);
        const bool pairs = format == "NV12";
        ASSERT_EQ(at(frame, 1, x, y), expected(luma_bytes + (pairs ? 2 * i : i)));
        ASSERT_EQ(at(frame, 2, x, y), expected(luma_bytes + (pairs ? 2 * i + 1 : luma_bytes / 4 + i)));
      }
    }
  }
}

TEST_F(CameraTest, MotionJpegIsDecodedAsFfmpegDecodesIt) {
  const test::TemporaryFolder folder;
  const std::string picture = (folder / "in.jpg").string();
  ASSERT_EQ(
      std::system(("ffmpeg -v error -f lavfi -i testsrc2=size=320x240 -frames:v 1 -pix_fmt yuvj422p '" + picture + "'")
                      .c_str()),
      0);
  set("FAKE_CAMERA_FORMATS", "MJPG");
  set("FAKE_CAMERA_FRAMES", picture);
  const auto camera = open({.width_px = 320, .height_px = 240});
  const auto file = source::open(picture);
  EXPECT_EQ(camera->description().format.pixels, file->description().format.pixels);
  EXPECT_EQ(camera->description().format.colour.range, ColourTags::Range::Full);
  const Frame got = *camera->next(), expected = *file->next();
  for (std::size_t p = 0; p < 3; ++p) {
    for (int y = 0; y < expected.planes[p].rows; ++y) {
      for (int x = 0; x < expected.planes[p].row_bytes; ++x) ASSERT_EQ(at(got, p, x, y), at(expected, p, x, y));
    }
  }
}

TEST_F(CameraTest, TimesAreTheDriversAndRise) {
  const auto camera = open();
  std::int64_t last_pts = -1, last_ns = 0;
  for (int i = 0; i < 20; ++i) {
    const Frame frame = *camera->next();
    EXPECT_EQ(frame.number, i);
    EXPECT_GT(frame.pts, last_pts);
    EXPECT_GT(frame.captured_ns, last_ns);
    if (i > 0) {
      // The fake camera's beat is even: its stamps lie whole periods of 5 ms apart, to a microsecond of rounding.
      const std::int64_t off = (frame.pts - last_pts + 2500) % 5000 - 2500;
      EXPECT_LE(std::abs(off), 1);
    }
    last_pts = frame.pts;
    last_ns = frame.captured_ns;
  }
}

TEST_F(CameraTest, GapsInTheDriversCountAreMissedFrames) {
  set("FAKE_CAMERA_LOSE_EVERY", "4");
  const auto camera = open();
  std::int64_t frames = 0;
  for (; frames < 30; ++frames) ASSERT_TRUE(camera->next());
  const Health health = camera->health();
  EXPECT_EQ(health.frames, 30);
  // Every fourth is lost: 30 arrive while 9 or 10 don't, more only if this thread slept through some.
  EXPECT_GE(health.missed, 9);
  EXPECT_NE(camera->damage().find("were lost before they came"), std::string::npos);
}

TEST_F(CameraTest, DamagedFramesAreCountedAndNotShown) {
  set("FAKE_CAMERA_DAMAGE_EVERY", "5");
  const auto camera = open();
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(camera->next());
  EXPECT_GE(camera->health().damaged, 4);
}

TEST_F(CameraTest, ComesBackAfterUnpluggingWithoutLeakingDescriptors) {
  set("FAKE_CAMERA_UNPLUG_EVERY", "6");
  set("FAKE_CAMERA_AWAY_MS", "20");
  const auto camera = open();
  const std::size_t before = open_descriptors();
  std::int64_t last_pts = -1, number = 0;
  while (camera->health().reconnects < 5) {
    const auto frame = camera->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->number, number++);
    EXPECT_GT(frame->pts, last_pts);
    last_pts = frame->pts;
  }
  EXPECT_EQ(open_descriptors(), before);
}

TEST_F(CameraTest, BrokenStreamIsStartedAnew) {
  set("FAKE_CAMERA_BREAK_EVERY", "5");
  const auto camera = open();
  for (int i = 0; i < 15; ++i) ASSERT_TRUE(camera->next());
  EXPECT_GE(camera->health().reconnects, 2);
}

TEST_F(CameraTest, StopsWaitingForASilentCamera) {
  set("FAKE_CAMERA_SILENT_AFTER", "2");
  const auto camera = open();
  std::atomic<bool> stop{false};
  camera->stop_when(stop);
  while (camera->health().frames < 2) ASSERT_TRUE(camera->next());
  std::thread later([&stop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    stop = true;
  });
  // The two pictures are taken; after a second of silence it says so.
  while (camera->next()) {
  }
  later.join();
  EXPECT_NE(camera->health().notice.find("sends no picture"), std::string::npos) << camera->health().notice;
}

TEST_F(CameraTest, ControlsAreSetInOrder) {
  // The exposure can be set only once the automatic is off.
  const auto camera = open({}, {{"auto_exposure", std::string("Manual Mode"), "s:1"},
                                {"exposure_time_absolute", std::int64_t{77}, "s:2"},
                                {"brightness", std::int64_t{12}, "s:3"}});
  std::map<std::string, std::int64_t> values;
  for (const Control& control : controls_of(open_device(path))) values[control.name] = control.value;
  EXPECT_EQ(values["auto_exposure"], 0);
  EXPECT_EQ(values["exposure_time_absolute"], 77);
  EXPECT_EQ(values["brightness"], 12);
}

TEST_F(CameraTest, WrongControlsAreNamed) {
  EXPECT_EQ(complaint({path, {}, {{"brightnes", std::int64_t{1}, "s:1"}}}),
            "s:1: Fake Camera has no control 'brightnes'; it has brightness, auto_exposure, exposure_time_absolute");
  EXPECT_EQ(complaint({path, {}, {{"brightness", std::int64_t{256}, "s:1"}}}),
            "s:1: the control 'brightness' can't be 256; give 0 to 255");
  EXPECT_EQ(complaint({path, {}, {{"auto_exposure", std::string("Auto"), "s:1"}}}),
            "s:1: the control 'auto_exposure' can't be 'Auto'; give 'Manual Mode', 'Auto Mode'");
  EXPECT_EQ(
      complaint(
          {path, {}, {{"auto_exposure", std::int64_t{1}, ""}, {"exposure_time_absolute", std::int64_t{5}, "s:1"}}}),
      "s:1: the control 'exposure_time_absolute' can't be set now; switch off the automatic that governs it, "
      "before it in the file");
}

TEST_F(CameraTest, SaysWhatWasAgreed) {
  const auto camera = open({.width_px = 640, .height_px = 480, .rate = {200, 1}});
  EXPECT_EQ(camera->description().notice, std::string(path) + ": Fake Camera, 640x480 YUYV at 200/s");
  const auto other = open({.width_px = 650, .height_px = 480});
  EXPECT_EQ(other->description().notice,
            std::string(path) + ": Fake Camera, 640x480 YUYV at 200/s (it can't do the 650x480 asked for)");
}

TEST_F(CameraTest, BadDevicesAreNamed) {
  EXPECT_EQ(complaint({"/dev/video4711", {}, {}}),
            "/dev/video4711: there is no such camera; 'rinkaku devices' lists the cameras there are");
  EXPECT_EQ(complaint({"/dev/null", {}, {}}),
            "/dev/null: is no video device; 'rinkaku devices' lists the cameras there are");
  set("FAKE_CAMERA_FORMATS", "BA81");
  EXPECT_EQ(complaint({path, {}, {}}), std::string(path) + ": Fake Camera has no format that can be read; it has BA81");
}

}  // namespace
}  // namespace rinkaku::source::v4l2

#include "pipeline/track/steady.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/pipeline/track/track_test_support.h"

namespace rinkaku::track {
namespace {

// A tracker that tells what the test says: the target's sideways place in metres, or nothing.
class Scripted final : public Tracker {
 public:
  using Script = std::function<std::optional<double>(std::int64_t)>;
  explicit Scripted(Script script) : script_(std::move(script)) {}
  std::optional<TrackedPose> track(const Frame& frame) override {
    const auto x = script_(frame.number);
    if (!x) return {};
    TrackedPose pose;
    pose.frame_number = frame.number;
    pose.camera_from_world.translation_m = {*x, 0, 1};
    return pose;
  }

 private:
  Script script_;
};

// Runs frames at 100 per second, so that times are round.
std::vector<std::optional<TrackedPose>> run(const SteadyOptions& options, int frames, Scripted::Script script) {
  auto tracker = make_steady(std::make_unique<Scripted>(std::move(script)), options);
  std::vector<std::optional<TrackedPose>> poses;
  for (int i = 0; i < frames; ++i) {
    Frame frame;
    frame.number = i;
    frame.pts = i;
    frame.time_base = {1, 100};
    poses.push_back(tracker->track(frame));
    if (poses.back()) {
      EXPECT_EQ(poses.back()->frame_number, i) << "a pose carries its frame's number";
    }
  }
  return poses;
}

constexpr SteadyOptions plain{std::nullopt, 0.3, 0.2, 0.05, 1000, {0, 0, 0}, 0.1};

TEST(Steady, GivesNothingBeforeTheFirstSightingAndThenAtOnce) {
  const auto poses = run(plain, 10, [](auto n) { return n < 5 ? std::nullopt : std::optional(1.0); });
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(poses[static_cast<std::size_t>(i)]);
  ASSERT_TRUE(poses[5]);
  EXPECT_EQ(poses[5]->opacity, 1);
  EXPECT_EQ(poses[5]->camera_from_world.translation_m.x, 1);
}

TEST(Steady, HoldsThenFadesThenGivesUp) {
  // Seen up to frame 10; lost for n / 100 s at frame 10 + n.
  const auto poses =
      run(plain, 100, [](auto n) { return n <= 10 ? std::optional(0.01 * static_cast<double>(n)) : std::nullopt; });
  for (std::size_t i = 11; i <= 40; ++i) {
    ASSERT_TRUE(poses[i]) << i;
    EXPECT_TRUE(poses[i]->held);
    EXPECT_EQ(poses[i]->opacity, 1) << i;
    EXPECT_NEAR(poses[i]->camera_from_world.translation_m.x, 0.1, 1e-12);
  }
  for (std::size_t i = 41; i < 60; ++i) {
    ASSERT_TRUE(poses[i]) << i;
    EXPECT_NEAR(poses[i]->opacity, 1 - static_cast<double>(i - 40) / 20, 1e-9) << i;
  }
  for (std::size_t i = 60; i < 100; ++i) EXPECT_FALSE(poses[i]) << i;
}

TEST(Steady, FadesInWhenFoundAfterAFullLoss) {
  const auto poses =
      run(plain, 200, [](auto n) { return n <= 10 || n >= 100 ? std::optional(n < 50 ? 0.0 : 0.5) : std::nullopt; });
  EXPECT_FALSE(poses[99]);
  for (std::size_t i = 100; i < 200; ++i) {
    ASSERT_TRUE(poses[i]);
    EXPECT_NEAR(poses[i]->opacity, std::min(1.0, static_cast<double>(i - 99) / 20), 1e-9);
    EXPECT_NEAR(poses[i]->camera_from_world.translation_m.x, 0.5, 1e-12) << "nothing is left of the old place";
    EXPECT_FALSE(poses[i]->held);
  }
}

TEST(Steady, RisesFromWhereItWasWhenFoundDuringTheFade) {
  const auto poses = run(plain, 120, [](auto n) { return n <= 10 || n >= 50 ? std::optional(0.0) : std::nullopt; });
  EXPECT_NEAR(poses[49]->opacity, 1 - 9.0 / 20, 1e-9);
  double before = poses[49]->opacity;
  for (std::size_t i = 50; i < 120; ++i) {
    EXPECT_GE(poses[i]->opacity, before) << "never back";
    EXPECT_LE(poses[i]->opacity - before, 0.05 + 1e-9);
    before = poses[i]->opacity;
  }
  EXPECT_EQ(before, 1);
}

TEST(Steady, GlidesToAPoseFoundAgainAfterAShortLoss) {
  // 0.02 m away, a fifth of the target's radius: reached in 0.05 s, that is 5 frames, going one way only.
  const auto poses = run(plain, 60, [](auto n) {
    return n <= 10 ? std::optional(0.0) : n < 20 ? std::nullopt : std::optional(0.02);
  });
  double before = 0;
  for (std::size_t i = 20; i < 60; ++i) {
    const double x = poses[i]->camera_from_world.translation_m.x;
    EXPECT_GE(x, before - 1e-12);
    EXPECT_LE(x - before, 0.02 / 5 + 1e-9);
    if (i >= 24) {
      EXPECT_NEAR(x, 0.02, 1e-12);
    }
    before = x;
    EXPECT_EQ(poses[i]->opacity, 1);
  }
}

TEST(Steady, GoesStraightToAPoseThatIsFarAway) {
  const auto poses = run(plain, 60, [](auto n) {
    return n <= 10 ? std::optional(0.0) : n < 20 ? std::nullopt : std::optional(0.5);
  });
  EXPECT_EQ(poses[20]->camera_from_world.translation_m.x, 0.5);
}

TEST(Steady, OneFrameLostShowsNoDifferenceInOpacity) {
  const auto poses =
      run(plain, 60, [](auto n) { return n % 7 == 3 ? std::nullopt : std::optional(0.001 * static_cast<double>(n)); });
  for (const auto& pose : poses) {
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->opacity, 1);
  }
}

TEST(Steady, WithoutHoldAndFadeEndsAtOnce) {
  SteadyOptions options = plain;
  options.hold_s = options.fade_s = options.blend_s = 0;
  const auto poses = run(options, 30, [](auto n) {
    return n <= 10 || n >= 20 ? std::optional(0.1 * static_cast<double>(n)) : std::nullopt;
  });
  EXPECT_FALSE(poses[11]);
  ASSERT_TRUE(poses[20]);
  EXPECT_EQ(poses[20]->opacity, 1);
  EXPECT_EQ(poses[20]->camera_from_world.translation_m.x, 2);
}

TEST(Steady, ChangesNothingWhereNothingIsLostOrSmoothed) {
  SteadyOptions options = plain;
  options.centre_m = {0.3, -0.2, 0.7};
  const auto poses = run(options, 50, [](auto n) { return std::optional(std::sin(static_cast<double>(n))); });
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(poses[i]->camera_from_world.translation_m.x, std::sin(static_cast<double>(i)), 1e-12);
    EXPECT_NEAR(poses[i]->camera_from_world.translation_m.z, 1, 1e-12);
  }
}

TEST(Steady, SurvivesTimesThatStandStillOrRunBack) {
  for (const auto& time : std::vector<std::function<std::int64_t(int)>>{
           [](int) { return 0; }, [](int i) { return -i; }, [](int i) { return i % 2 ? 1'000'000'000 : 0; }}) {
    SteadyOptions options = plain;
    options.smoothing = OneEuroOptions{};
    auto tracker = make_steady(
        std::make_unique<Scripted>([](auto n) { return n % 10 < 8 ? std::optional(0.1) : std::nullopt; }), options);
    for (int i = 0; i < 200; ++i) {
      Frame frame;
      frame.number = i;
      frame.pts = time(i);
      frame.time_base = {1, 100};
      if (const auto pose = tracker->track(frame)) {
        ASSERT_TRUE(std::isfinite(pose->camera_from_world.translation_m.x));
        ASSERT_GE(pose->opacity, 0);
        ASSERT_LE(pose->opacity, 1);
      }
    }
  }
}

TEST(Steady, RefusesOptionsThatCannotBe) {
  const auto make = [](const SteadyOptions& options) {
    return make_steady(std::make_unique<Scripted>([](auto) { return std::nullopt; }), options);
  };
  SteadyOptions options = plain;
  options.hold_s = -1;
  EXPECT_REFUSED(make(options), "hold_s");
  options = plain;
  options.fade_s = std::nan("");
  EXPECT_REFUSED(make(options), "fade_s");
  options = plain;
  options.smoothing = OneEuroOptions{0, 1, 1};
  EXPECT_REFUSED(make(options), "min_cutoff_hz");
}

}  // namespace
}  // namespace rinkaku::track

#include "pipeline/source/playback.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "tests/pipeline/source/media_tools.h"

namespace rinkaku::source {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// Grey frames, 50 a second; a live one waits for each.
class Counting final : public Source {
 public:
  Counting(std::int64_t frames, bool live) : frames_(frames) {
    description_.format = test::picture("gray", 16, 8);
    description_.time_base = {1, 50};
    description_.live = live;
  }
  const Description& description() const override { return description_; }
  std::optional<Frame> next() override {
    if (number_ >= frames_) return std::nullopt;
    if (description_.live) std::this_thread::sleep_for(2ms);
    return test::noise(description_.format, number_++, description_.time_base);
  }

 private:
  std::int64_t frames_, number_ = 0;
  Description description_;
};

TEST(Playback, RecordingsKeepTheirBeat) {
  Playback playback;
  PlayedSource played(std::make_unique<Counting>(6, false), playback);
  const auto start = Clock::now();
  for (int i = 0; i < 6; ++i) EXPECT_EQ(played.next()->number, i);
  // Five periods of 20 ms lie between six frames; a busy machine may take longer.
  EXPECT_GE(Clock::now() - start, 99ms);
}

TEST(Playback, AtTheEndTheLastFrameStaysUntilItIsStopped) {
  Playback playback;
  PlayedSource played(std::make_unique<Counting>(2, false), playback);
  std::atomic<bool> stop{false};
  played.stop_when(stop);
  played.next();
  played.next();
  std::thread later([&] {
    while (!playback.ended()) std::this_thread::sleep_for(1ms);
    playback.repeat();
    std::this_thread::sleep_for(50ms);
    stop = true;
  });
  const auto again = played.next();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->number, 1);
  EXPECT_TRUE(again->repeated);
  EXPECT_FALSE(played.next());
  later.join();
}

TEST(Playback, StepsGiveOneFrameEach) {
  Playback playback;
  PlayedSource played(std::make_unique<Counting>(100, false), playback);
  std::atomic<bool> stop{false};
  played.stop_when(stop);
  EXPECT_EQ(played.next()->number, 0);
  playback.toggle_pause();
  std::atomic<std::int64_t> newest{0};
  std::thread reader([&] {
    while (const auto frame = played.next()) newest = frame->number;
  });
  std::this_thread::sleep_for(60ms);
  EXPECT_EQ(newest, 0);  // at rest
  for (int i = 1; i <= 3; ++i) {
    playback.step();
    while (newest < i) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(30ms);
    EXPECT_EQ(newest, i);
  }
  stop = true;
  reader.join();
}

TEST(Playback, CameraFramesPassUnseenWhileItRests) {
  Playback playback;
  PlayedSource played(std::make_unique<Counting>(1000, true), playback);
  EXPECT_EQ(played.next()->number, 0);
  playback.toggle_pause();
  std::thread later([&] {
    std::this_thread::sleep_for(40ms);
    playback.toggle_pause();
  });
  EXPECT_GT(played.next()->number, 3);  // a frame in 2 ms
  later.join();
}

}  // namespace
}  // namespace rinkaku::source

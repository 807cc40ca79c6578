#include "pipeline/line.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace rinkaku::pipeline {
namespace {

using namespace std::chrono_literals;

// Numbers a frame each 2 ms, as a camera does, `count` of them.
Line::Decode camera(std::int64_t count) {
  return [count, number = std::int64_t{0}]() mutable -> std::optional<Work> {
    if (number == count) return std::nullopt;
    std::this_thread::sleep_for(2ms);
    Work work{};
    work.frame.number = number++;
    return work;
  };
}

TEST(Line, LiveFramesThatComeTooFastAreLeftOutAndTheNewestIsTaken) {
  Line line;
  std::vector<std::int64_t> drawn;
  line.add(Line::Group::Draw, "draw", [&](Work& work) {
    std::this_thread::sleep_for(20ms);
    drawn.push_back(work.frame.number);
  });
  const std::int64_t through = line.run(camera(100), {}, Pace::NewestFrame);
  EXPECT_EQ(through, static_cast<std::int64_t>(drawn.size()));
  EXPECT_EQ(through + line.dropped().before, 100);
  EXPECT_GT(line.dropped().before, 50);  // ten come while one is drawn
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
  EXPECT_EQ(drawn.back(), 99);  // the newest is never the one that is dropped
}

TEST(Line, SlowRecordingLosesItsOwnFramesOnly) {
  Line line;
  std::int64_t shown = 0, recorded = 0;
  line.add(Line::Group::Composite, "show", [&](Work&) { ++shown; });
  line.add(Line::Group::Encode, "encode", [&](Work&) {
    std::this_thread::sleep_for(30ms);
    ++recorded;
  });
  line.run(camera(60), {}, Pace::NewestFrame);
  // What is shown is lost only while this machine is busy elsewhere.
  EXPECT_GE(shown, 40);
  EXPECT_EQ(shown + line.dropped().before, 60);
  EXPECT_EQ(recorded + line.dropped().drawn, shown);
  EXPECT_GT(line.dropped().drawn, 10);
}

TEST(Line, RecordingsLoseNothing) {
  Line line;
  std::int64_t through = 0;
  line.add(Line::Group::Draw, "draw", [&](Work&) { std::this_thread::sleep_for(3ms); });
  line.add(Line::Group::Encode, "encode", [&](Work& work) { EXPECT_EQ(work.frame.number, through++); });
  EXPECT_EQ(line.run(camera(30), {}), 30);
  EXPECT_EQ(line.dropped().before + line.dropped().drawn, 0);
}

TEST(Line, StageTimesTravelWithTheirFrame) {
  Line line;
  line.add(Line::Group::Draw, "draw", [](Work&) { std::this_thread::sleep_for(4ms); });
  line.add(Line::Group::Encode, "encode", [](Work& work) {
    EXPECT_GE(work.stage_ms[0], 2);  // decoding
    EXPECT_GE(work.stage_ms[1], 4);
    EXPECT_EQ(work.stage_ms[2], 0);  // not over yet
  });
  line.run(camera(3), {});
  EXPECT_EQ(line.stage_names(), (std::vector<std::string>{"decode", "draw", "encode"}));
}

}  // namespace
}  // namespace rinkaku::pipeline

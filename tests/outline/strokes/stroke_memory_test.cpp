#include "outline/strokes/stroke_memory.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "outline/strokes/stroke_mesh.h"
#include "tests/outline/allocation_count.h"

namespace rinkaku::outline {
namespace {

// Pixels at a depth of 1: (x, y, 1) is seen at (x, y), moved and zoomed.
glm::mat4 camera(const glm::vec2& moved = {0, 0}, float zoom = 1) {
  glm::mat4 m(0);
  m[0][0] = m[1][1] = zoom;
  m[2] = {moved.x, moved.y, 1, 0};
  return m;
}

// A line through given points, as a frame sees it.
StrokePath traced(const std::vector<glm::vec3>& points, const glm::mat4& to_pixels, bool closed) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < points.size(); ++i) numbers.push_back(i);
  const std::vector<float> widths(points.size(), 3.0f);
  StrokePath path;
  path.trace(numbers, widths, {reinterpret_cast<const std::byte*>(points.data()), sizeof(glm::vec3)}, {}, points.size(),
             to_pixels, closed, {});
  return path;
}

std::vector<glm::vec3> ring(float radius, int start, int count = 120) {
  std::vector<glm::vec3> points;
  for (int i = 0; i <= count; ++i) {
    const float turn =
        2 * std::numbers::pi_v<float> * static_cast<float>((i + start) % count) / static_cast<float>(count);
    points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 1);
  }
  return points;
}

// Where along its stroke the line is at its place nearest to a pixel, in periods.
float phase_at(const StrokePath& path, const StrokeFit& fit, const glm::vec2& px, float period_px) {
  float best = 1e9f, phase = 0;
  for (const StrokeSample& s : path.samples()) {
    const float away = glm::length(s.px - px);
    if (away >= best) continue;
    best = away;
    phase = (fit.scale * s.way_px + fit.offset_px) / period_px;
  }
  return phase - std::floor(phase);
}

TEST(StrokeMemory, LoopThatBeginsElsewhereEachFrameKeepsItsStrokes) {
  constexpr float period = 60;
  StrokeMemory memory;
  float before = 0, worst = 0;
  for (int frame = 0; frame < 40; ++frame) {
    // The camera moves by a pixel and a half a frame, and linking begins at another vertex.
    const glm::vec2 moved(300 + 1.5f * static_cast<float>(frame), 200);
    const StrokePath path = traced(ring(80, 37 * frame), camera(moved), true);
    memory.begin(camera(moved));
    const StrokeFit fit = memory.fit(path, period);
    memory.remember(path, fit);
    const float phase = phase_at(path, fit, moved + glm::vec2(0, 80), period);
    if (frame > 0) {
      const float change = std::abs(phase - before);
      worst = std::max(worst, std::min(change, 1 - change) * period);
    }
    before = phase;
  }
  // Samples lie 3 px apart and are looked up by the nearest.
  EXPECT_LT(worst, 3);
}

TEST(StrokeMemory, LineThatGrowsAtItsBeginningKeepsItsStrokes) {
  StrokeMemory memory;
  float first = 0;
  for (int frame = 0; frame < 20; ++frame) {
    std::vector<glm::vec3> points;
    for (int x = 100 - 4 * frame; x <= 300; x += 4) points.emplace_back(static_cast<float>(x), 50, 1);
    const StrokePath path = traced(points, camera(), false);
    memory.begin(camera());
    const StrokeFit fit = memory.fit(path, 0);
    memory.remember(path, fit);
    const float u = fit.scale * (200 - path.samples()[0].px.x) + fit.offset_px;
    if (frame == 0) first = u;
    EXPECT_NEAR(u, first, 3) << "frame " << frame;  // within a sample
  }
}

TEST(StrokeMemory, StretchedStrokesGoBackToTheirLength) {
  std::vector<glm::vec3> points;
  for (int x = 0; x <= 200; x += 4) points.emplace_back(static_cast<float>(x), 0, 1);
  StrokeMemory memory;
  float smallest = 1, scale = 1;
  for (int frame = 0; frame < 120; ++frame) {
    const float zoom = 1 + 0.02f * static_cast<float>(std::min(frame, 10));
    const StrokePath path = traced(points, camera({0, 0}, zoom), false);
    memory.begin(camera({0, 0}, zoom));
    const StrokeFit fit = memory.fit(path, 0);
    memory.remember(path, fit);
    scale = fit.scale;
    smallest = std::min(smallest, scale);
  }
  EXPECT_LT(smallest, 0.95f) << "while zooming in, strokes are stretched";
  EXPECT_NEAR(scale, 1, 0.01f) << "afterwards they come back";
}

TEST(StrokeMemory, LoopsHoldWholeStrokes) {
  StrokeMemory memory;
  memory.begin(camera({300, 200}));
  const StrokePath path = traced(ring(80, 0), camera({300, 200}), true);
  const StrokeFit fit = memory.fit(path, 60);
  const float strokes = fit.scale * path.length_px() / 60;
  EXPECT_NEAR(strokes, std::round(strokes), 1e-3);
}

TEST(StrokePath, SmoothingTakesTheZigzagOfSmallTriangles) {
  std::vector<glm::vec3> points;
  for (int i = 0; i <= 60; ++i) points.emplace_back(2.0f * static_cast<float>(i), i % 2 == 0 ? 0.0f : 1.6f, 1);
  const StrokePath path = traced(points, camera(), false);
  double most = 0;
  for (std::size_t i = 8; i + 8 < path.samples().size(); ++i) {
    const StrokeSample& s = path.samples()[i];
    most = std::max<double>(most, std::abs(s.px.y + s.shift_px.y - 0.8f));
    EXPECT_LT(std::abs(s.normal.x), 0.2f) << "normals stand nearly upright";
  }
  EXPECT_LT(most, 0.5) << "of the 0.8 px to either side";
}

TEST(StrokePath, BreaksOffBehindTheEye) {
  const std::vector<glm::vec3> points = {{0, 0, 1}, {10, 0, 1}, {20, 0, -1}, {30, 0, 1}};
  const StrokePath path = traced(points, camera(), false);
  ASSERT_FALSE(path.samples().empty());
  for (const StrokeSample& s : path.samples()) EXPECT_GT(s.depth_m, 0);
  EXPECT_NEAR(path.length_px(), 10, 1e-4);
}

TEST(StrokeMesh, BandLiesWhereItShould) {
  std::vector<glm::vec3> points;
  for (int x = 0; x <= 100; x += 10) points.emplace_back(static_cast<float>(x), 0, 1);
  const StrokePath path = traced(points, camera(), false);
  for (const bool outside : {false, true}) {
    StrokeMesh strips;
    strips.add(path, {}, {outside, false, 0, 1, 0});
    float low = 1e9f, high = -1e9f;
    for (const StrokeVertex& v : strips.vertices())
      low = std::min(low, v.push_px.y), high = std::max(high, v.push_px.y);
    // Width 3, and 0.75 px to either side for the smooth edge. To the right of the way is down the screen.
    EXPECT_NEAR(high, outside ? 3 + 0.75 : 1.5 + 0.75, 1e-4);
    EXPECT_NEAR(low, outside ? -1 - 0.75 : -1.5 - 0.75, 1e-4);
    EXPECT_EQ(strips.indices().size(), 6 * (path.samples().size() - 1));
  }
}

TEST(StrokeMemory, AllocatesNothingOnceWarm) {
  StrokeMemory memory;
  StrokeMesh strips;
  const StrokePath path = traced(ring(80, 0), camera({300, 200}), true);
  long before = 0;
  for (int frame = 0; frame < 6; ++frame) {
    if (frame == 3) before = test::allocations();
    memory.begin(camera({300, 200}));
    const StrokeFit fit = memory.fit(path, 60);
    memory.remember(path, fit);
    strips.clear();
    strips.add(path, fit, {true, false, 0.5f, 20, 0});
  }
  EXPECT_EQ(test::allocations(), before);
}

TEST(SmoothNoise, IsTheSameForTheSamePlaceAndAnotherForAnotherDraft) {
  double sum = 0, apart = 0;
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 at(0.37f * static_cast<float>(i), 0.11f * static_cast<float>(i), 3);
    const float here = smooth_noise(at, 1);
    EXPECT_EQ(here, smooth_noise(at, 1));
    EXPECT_LE(std::abs(here), 1);
    EXPECT_LT(std::abs(smooth_noise(at + glm::vec3(0.01f, 0, 0), 1) - here), 0.05f) << "smooth";
    sum += here;
    apart += std::abs(smooth_noise(at, 2) - here);
  }
  EXPECT_NEAR(sum / 1000, 0, 0.05);  // 1000 places some cells apart: 0.4 / sqrt(100) or so
  EXPECT_GT(apart / 1000, 0.2);
}

}  // namespace
}  // namespace rinkaku::outline

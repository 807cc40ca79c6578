#include "outline/strokes/stroke_memory.h"

#include <cmath>
#include <numbers>
#include <numeric>

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

LinePoints line_points(const std::vector<glm::vec3>& points) {
  return {{reinterpret_cast<const std::byte*>(points.data()), sizeof(glm::vec3)}, points.size()};
}

// A line through some of given points, as a frame sees it.
StrokePath traced(const std::vector<glm::vec3>& points, const std::vector<std::uint32_t>& numbers,
                  const glm::mat4& to_pixels, bool closed) {
  const std::vector<float> widths(numbers.size(), 3.0f);
  StrokePath path;
  path.trace(numbers, widths, line_points(points), to_pixels, closed, {});
  return path;
}

// Through all of them.
StrokePath traced(const std::vector<glm::vec3>& points, const glm::mat4& to_pixels, bool closed) {
  std::vector<std::uint32_t> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  return traced(points, numbers, to_pixels, closed);
}

constexpr int ring_count = 120;

std::vector<glm::vec3> ring(float radius) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < ring_count; ++i) {
    const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(ring_count);
    points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 1);
  }
  return points;
}

// Once around, from one of its points.
std::vector<std::uint32_t> around_from(int start) {
  std::vector<std::uint32_t> numbers;
  for (int i = 0; i <= ring_count; ++i) numbers.push_back(static_cast<std::uint32_t>((i + start) % ring_count));
  return numbers;
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
  const std::vector<glm::vec3> points = ring(80);
  StrokeMemory memory;
  float before = 0, worst = 0;
  for (int frame = 0; frame < 40; ++frame) {
    // The camera moves by a pixel and a half a frame, and linking begins at another vertex.
    const glm::vec2 moved(300 + 1.5f * static_cast<float>(frame), 200);
    const StrokePath path = traced(points, around_from(37 * frame), camera(moved), true);
    memory.begin(line_points(points), camera(moved));
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
  std::vector<glm::vec3> points;
  for (int x = 300; x >= 20; x -= 4) points.emplace_back(static_cast<float>(x), 50, 1);
  StrokeMemory memory;
  float first = 0;
  for (int frame = 0; frame < 20; ++frame) {
    std::vector<std::uint32_t> numbers(static_cast<std::size_t>(51 + frame));
    std::iota(numbers.rbegin(), numbers.rend(), 0u);
    const StrokePath path = traced(points, numbers, camera(), false);
    memory.begin(line_points(points), camera());
    const StrokeFit fit = memory.fit(path, 0);
    memory.remember(path, fit);
    const float u = fit.scale * (200 - path.samples()[0].px.x) + fit.offset_px;
    if (frame == 0) first = u;
    EXPECT_NEAR(u, first, 3) << "frame " << frame;  // within a sample
  }
}

// Nothing but the shape moves, farther from frame to frame than a line is looked for: it is looked for where the shape
// has taken it.
TEST(StrokeMemory, LineOnAShapeThatMovesKeepsItsStrokes) {
  constexpr float period = 60;
  StrokeMemory memory;
  float before = 0;
  for (int frame = 0; frame < 12; ++frame) {
    std::vector<glm::vec3> points = ring(80);
    for (glm::vec3& p : points) {
      p.x += 300 + 25 * static_cast<float>(frame);
      p.y = 200 + p.y * (1 + 0.01f * static_cast<float>(frame));
    }
    const StrokePath path = traced(points, around_from(53 * frame), camera(), true);
    memory.begin(line_points(points), camera());
    const StrokeFit fit = memory.fit(path, period);
    memory.remember(path, fit);
    const float phase = phase_at(path, fit, glm::vec2(points[30]), period);
    if (frame > 0) {
      const float change = std::abs(phase - before);
      EXPECT_LT(std::min(change, 1 - change) * period, 3) << "frame " << frame << ", a sample";
    }
    before = phase;
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
    memory.begin(line_points(points), camera({0, 0}, zoom));
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
  const std::vector<glm::vec3> points = ring(80);
  memory.begin(line_points(points), camera({300, 200}));
  const StrokePath path = traced(points, around_from(0), camera({300, 200}), true);
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
    strips.add(path, {}, {.outside = outside});
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
  const std::vector<glm::vec3> points = ring(80);
  const StrokePath path = traced(points, around_from(0), camera({300, 200}), true);
  long before = 0;
  for (int frame = 0; frame < 6; ++frame) {
    if (frame == 3) before = test::allocations();
    memory.begin(line_points(points), camera({300, 200}));
    const StrokeFit fit = memory.fit(path, 60);
    memory.remember(path, fit);
    strips.clear();
    strips.add(path, fit, {.outside = true, .wobble = 0.5f, .wave = 20});
  }
  EXPECT_EQ(test::allocations(), before);
}

// What a wobble is fixed to is the shape, so its picture moves along when the shape does.
TEST(StrokeMesh, WobblesGoWithTheShape) {
  const auto widths_of = [](const std::vector<glm::vec3>& points, const LinePoints* rest) {
    const StrokePath path = traced(points, camera(), false);
    StrokeMesh strips;
    strips.add(path, {}, {.wobble = 0.6f, .wave = 15, .rest = rest});
    std::vector<float> widths;
    for (const StrokeVertex& v : strips.vertices()) widths.push_back(v.half_px);
    return widths;
  };
  std::vector<glm::vec3> points, moved;
  for (int x = 0; x <= 100; x += 10) points.emplace_back(static_cast<float>(x), 0, 1);
  for (const glm::vec3& p : points) moved.push_back(p + glm::vec3(37, 21, 0));
  const LinePoints rest = line_points(points);
  const std::vector<float> before = widths_of(points, nullptr);
  EXPECT_EQ(widths_of(moved, &rest), before);
  EXPECT_NE(widths_of(moved, nullptr), before) << "in a place of its own it would wobble otherwise";
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

#include "outline/fluffy/draw_order.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "outline/fluffy/cutter.h"
#include "tests/outline/allocation_count.h"
#include "tests/outline/fluffy/frames.h"

namespace rinkaku::test {
namespace {

std::vector<std::uint32_t> all_of(const fluffy::Frame& frame) {
  std::vector<std::uint32_t> triangles(frame.triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0u);
  return triangles;
}

glm::vec3 middle(const fluffy::Frame& frame, const std::uint32_t* indices, std::uint32_t layers) {
  glm::vec3 sum(0);
  for (int k = 0; k < 3; ++k) sum += frame.points[frame.vertices[indices[k] / layers].point];
  return sum / 3.0f;
}

TEST(DrawOrder, GoesFromFarToNear) {
  const fluffy::Frame frame = frame_of(sphere(3));
  fluffy::DrawOrder order(frame, 1);
  const glm::dvec3 eye(0.5, 3, 1);
  const auto indices = order.sorted(all_of(frame), eye);
  ASSERT_EQ(indices.size(), frame.triangles.size() * 3);
  // 16 bits for the two units between the farthest and the nearest.
  constexpr float resolution = 2.0f / 65535 + 1e-6f;
  float last = 1e9f;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const float distance = glm::length(middle(frame, &indices[i], 1) - glm::vec3(eye));
    EXPECT_LE(distance, last + resolution);
    last = distance;
  }
}

TEST(DrawOrder, LayersGoOutwardsWhereTheSkinFacesTheEyeElseInwards) {
  const fluffy::Frame frame = frame_of(sphere(2));
  constexpr std::uint32_t layers = 4;
  fluffy::DrawOrder order(frame, layers);
  const glm::dvec3 eye(0, 0, 50);
  const auto indices = order.sorted(all_of(frame), eye);
  ASSERT_EQ(indices.size(), frame.triangles.size() * layers * 3);
  for (std::size_t i = 0; i < indices.size(); i += layers * 3) {
    const glm::vec3 at = middle(frame, &indices[i], layers);
    if (std::abs(at.z) < 0.1f) continue;  // on edge either is right
    for (std::uint32_t k = 0; k < layers; ++k) {
      EXPECT_EQ(indices[i + k * 3] % layers, at.z > 0 ? k : layers - 1 - k);
      EXPECT_EQ(middle(frame, &indices[i + k * 3], layers), at);
    }
  }
}

TEST(DrawOrder, FewerLayersKeepTheOutermost) {
  const fluffy::Frame frame = frame_of(sphere(1));
  constexpr std::uint32_t layers = 7;
  fluffy::DrawOrder order(frame, layers);
  for (const std::uint32_t step : {1u, 2u, 3u, 8u}) {
    const auto indices = order.sorted(all_of(frame), {0, 0, 9}, step);
    const std::uint32_t drawn = (layers + step - 1) / step;
    ASSERT_EQ(indices.size(), frame.triangles.size() * drawn * 3);
    std::uint32_t highest = 0;
    for (const std::uint32_t index : indices) {
      EXPECT_EQ((layers - 1 - index % layers) % step, 0u);
      highest = std::max(highest, index % layers);
    }
    EXPECT_EQ(highest, layers - 1);
  }
}

TEST(DrawOrder, FindingAndSortingAllocateNothingOnceWarm) {
  const fluffy::Frame frame = frame_of(sphere(4));
  for (const auto method : {fluffy::CutMethod::Exact, fluffy::CutMethod::Regions, fluffy::CutMethod::Nearest}) {
    fluffy::CutOptions options;
    options.method = method;
    options.sine = 0.5;
    options.regions = {.cells = 3, .shells = 2, .inner_radii = 1.5};
    fluffy::Cutter cutter(frame, options);
    fluffy::DrawOrder order(frame, 5);
    const long before = allocations();
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 eye(3 * std::cos(i * 0.1), 3 * std::sin(i * 0.1), 1);
      EXPECT_FALSE(order.sorted(cutter.find(eye), eye).empty());
    }
    EXPECT_EQ(allocations(), before);
  }
}

TEST(DrawOrder, NothingIsNothing) {
  const fluffy::Frame frame = frame_of(sphere(1));
  fluffy::DrawOrder order(frame, 2);
  EXPECT_TRUE(order.sorted({}, {0, 0, 9}).empty());
}

}  // namespace
}  // namespace rinkaku::test

#include <gtest/gtest.h>

#include "silhouette/fan_distance.h"
#include "silhouette/reduce.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

using test::surface_of;

TEST(FanDistance, RaisedCentreIsItsHeightAway) {
  // A pyramid over a square becomes the flat square.
  const std::vector<glm::dvec3> ring{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
  EXPECT_NEAR(fan_distance({0, 0, 0.2}, ring), 0.2, 1e-12);
  EXPECT_NEAR(fan_distance({0.3, 0.1, -0.2}, ring), 0.2 * std::sqrt(1.0), 0.02) << "nearly along z";
}

TEST(FanDistance, DistanceBetweenCrossingSpokesCounts) {
  // A saddle: the old centre lies on the new diagonal, but where other spokes cross it the surfaces part.
  const std::vector<glm::dvec3> ring{{1, 0, 0},  {0.5, 0.8, 0.1}, {-0.5, 0.8, 0},
                                     {-1, 0, 0}, {-0.5, -0.8, 0}, {0.5, -0.8, -0.1}};
  const double distance = fan_distance({0, 0, 0}, ring);
  EXPECT_GT(distance, 0.0);
  EXPECT_LT(distance, 0.2) << "the rim's whole height";
}

TEST(FanDistance, FlatFansAreNotApart) {
  const std::vector<glm::dvec3> ring{{2, 0, 1}, {1, 2, 1}, {-1, 1, 1}, {-2, -1, 1}, {1, -1, 1}};
  EXPECT_NEAR(fan_distance({0.1, 0.2, 1}, ring), 0, 1e-12);
}

TEST(FanDistance, FoldedFanIsInfinitelyFar) {
  // Seen from the first vertex, the ring is not star-shaped.
  const std::vector<glm::dvec3> ring{{2, 0, 0}, {0.2, 0.2, 0}, {0, 2, 0}, {-1, -1, 0}};
  EXPECT_TRUE(std::isinf(fan_distance({0, 0, 0}, ring)));
}

double distance_to(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const auto inside = [&](const glm::dvec3& u, const glm::dvec3& v) {
    return glm::dot(glm::cross(v - u, p - u), normal) >= 0;
  };
  if (inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(glm::dot(normal, p - a));
  const auto to_segment = [&](const glm::dvec3& u, const glm::dvec3& v) {
    const double t = std::clamp(glm::dot(p - u, v - u) / glm::dot(v - u, v - u), 0.0, 1.0);
    return glm::length(p - u - t * (v - u));
  };
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

/// How far points all over `from` lie from `to` at most.
double farthest(const Surface& surface, const std::vector<glm::uvec3>& from, const std::vector<glm::uvec3>& to) {
  const auto point = [&](std::uint32_t p) { return surface.frame.to_unit(surface.points[p]); };
  double most = 0;
  for (const glm::uvec3& t : from) {
    for (const glm::dvec3& w : {glm::dvec3(1, 1, 1) / 3.0, glm::dvec3(0.5, 0.5, 0), glm::dvec3(0.1, 0.6, 0.3)}) {
      const glm::dvec3 p = w.x * point(t.x) + w.y * point(t.y) + w.z * point(t.z);
      double least = 10;
      for (const glm::uvec3& o : to) least = std::min(least, distance_to(p, point(o.x), point(o.y), point(o.z)));
      most = std::max(most, least);
    }
  }
  return most;
}

TEST(Depth, FrontMeshStaysWithinTheDistanceAsked) {
  const Surface surface = surface_of(test::wavy_sphere(4));
  Reducer reducer(surface);
  RegionMeshes exact;
  RegionMeshes meshes;
  const ViewRegion region = view_region(RegionLayout{4, 1, 1.5}, 45);
  reducer.reduce(region, {1e-9, true}, exact);  // nothing moves: the front mesh itself
  ASSERT_EQ(exact.depth_front.size(), exact.front_before);
  std::size_t last = exact.front_before;
  for (const double distance : {0.003, 0.01, 0.03}) {
    reducer.reduce(region, {distance, true}, meshes);
    EXPECT_LE(farthest(surface, exact.depth_front, meshes.depth_front), distance);
    EXPECT_LE(farthest(surface, meshes.depth_front, exact.depth_front), distance);
    EXPECT_LT(meshes.depth_front.size(), last) << "more room, fewer triangles";
    last = meshes.depth_front.size();
  }
  EXPECT_GT(last, meshes.matte_front.size());
}

}  // namespace
}  // namespace rinkaku::silhouette

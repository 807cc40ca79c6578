#include "report/pareto.h"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace rinkaku::report {
namespace {

using Front = std::vector<std::size_t>;

TEST(ParetoFront, KeepsWhatNothingBeatsByRisingX) {
  const std::vector<glm::dvec2> points = {{5, 1}, {1, 5}, {3, 3}, {4, 4}, {2, 6}, {3, 5}};
  EXPECT_EQ(pareto_front(points), (Front{1, 2, 0}));
}

TEST(ParetoFront, EqualPointsStayAndTiesInOneCoordinateGo) {
  EXPECT_EQ(pareto_front(std::vector<glm::dvec2>{{1, 2}, {1, 2}, {1, 3}, {2, 2}}), (Front{0, 1}));
}

TEST(ParetoFront, LeavesOutWhatIsNotFinite) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(pareto_front(std::vector<glm::dvec2>{{nan, 0}, {0, nan}, {1, 1}, {0, infinite}}), (Front{2}));
  EXPECT_TRUE(pareto_front({}).empty());
}

// The definition, tried on every pair.
TEST(ParetoFront, AgreesWithTheDefinition) {
  std::mt19937 engine(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<glm::dvec2> points(40);
    for (glm::dvec2& p : points) p = {engine() % 12, engine() % 12};  // coarse, so that there are ties
    Front expected;
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool beaten = false;
      for (const glm::dvec2& q : points) {
        beaten |= q.x <= points[i].x && q.y <= points[i].y && (q.x < points[i].x || q.y < points[i].y);
      }
      if (!beaten) expected.push_back(i);
    }
    Front found = pareto_front(points);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace rinkaku::report

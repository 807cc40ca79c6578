#include "report/growth.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace rinkaku::report {
namespace {

TEST(GrowthExponent, IsThatOfAPowerLaw) {
  for (const double exponent : {-1.0, 0.0, 0.5, 1.0, 2.0}) {
    std::vector<glm::dvec2> points;
    for (const double x : {10.0, 30.0, 200.0, 1e5}) points.emplace_back(x, 0.3 * std::pow(x, exponent));
    ASSERT_TRUE(growth_exponent(points));
    EXPECT_NEAR(*growth_exponent(points), exponent, 1e-12);  // rounding of the logarithms
  }
}

TEST(GrowthExponent, FitsTheLogarithmsByLeastSquares) {
  // In logarithms to base 2: (0, 0), (1, 2), (2, 1): slope ((-1)(-1) + 0 + (1)(0)) / 2.
  const std::vector<glm::dvec2> points = {{1, 1}, {2, 4}, {4, 2}};
  EXPECT_NEAR(growth_exponent(points).value_or(-9), 0.5, 1e-12);
}

TEST(GrowthExponent, IsNotKnownFromOneSizeOrWithoutLogarithms) {
  EXPECT_FALSE(growth_exponent({}));
  EXPECT_FALSE(growth_exponent(std::vector<glm::dvec2>{{3, 1}, {3, 2}}));
  EXPECT_FALSE(growth_exponent(std::vector<glm::dvec2>{{1, 1}, {2, 0}}));
  EXPECT_FALSE(growth_exponent(std::vector<glm::dvec2>{{-1, 1}, {2, 1}}));
  EXPECT_FALSE(growth_exponent(std::vector<glm::dvec2>{{1, 1}, {2, std::numeric_limits<double>::infinity()}}));
}

}  // namespace
}  // namespace rinkaku::report

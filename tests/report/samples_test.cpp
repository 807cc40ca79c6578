#include "report/samples.h"

#include <gtest/gtest.h>

namespace rinkaku::report {
namespace {

TEST(Spread, IsTheMedianAndQuartilesOfTheSortedValues) {
  const Spread s = spread({5, 1, 3, 2, 4});
  EXPECT_EQ(s.median, 3);
  EXPECT_EQ(s.low, 2);
  EXPECT_EQ(s.high, 4);
}

TEST(Spread, LiesBetweenTwoValuesByStraightInterpolation) {
  const Spread s = spread({10, 20, 40, 80});
  EXPECT_EQ(s.median, 30);
  EXPECT_EQ(s.low, 17.5);
  EXPECT_EQ(s.high, 50);
}

TEST(Spread, OfOneValueIsThatAndOfNoneIsZero) {
  EXPECT_EQ(spread({7}).low, 7);
  EXPECT_EQ(spread({7}).high, 7);
  EXPECT_EQ(spread({}).median, 0);
}

}  // namespace
}  // namespace rinkaku::report

#include "report/axis_scale.h"

#include <cmath>

#include <gtest/gtest.h>

namespace rinkaku::report {
namespace {

TEST(AxisScale, LogAxisMarksDecadesAndHoldsAllValues) {
  const std::vector<double> values = {0.02, 3, 700};
  const AxisScale scale = axis_scale({"t", true}, values);
  EXPECT_TRUE(scale.log);
  std::vector<double> told;
  for (const AxisScale::Mark& mark : scale.marks) {
    if (!mark.text.empty()) told.push_back(mark.at);
  }
  ASSERT_GE(told.size(), 4u) << "0.1, 1, 10 and 100 lie between the values";
  EXPECT_NEAR(std::log10(told[0]), std::round(std::log10(told[0])), 1e-12);
  for (std::size_t i = 1; i < told.size(); ++i) EXPECT_NEAR(told[i] / told[i - 1], 10, 1e-9);
  for (const double v : values) {
    EXPECT_GT(scale.part(v), 0);
    EXPECT_LT(scale.part(v), 1);
  }
  EXPECT_NEAR(scale.part(10) - scale.part(1), scale.part(100) - scale.part(10), 1e-12);
}

TEST(AxisScale, ZerosOnALogAxisStandBelowEverythingElse) {
  const AxisScale scale = axis_scale({"px", true}, std::vector<double>{0, 5, 100});
  EXPECT_TRUE(scale.log);
  EXPECT_GT(scale.part(0), 0);
  EXPECT_LT(scale.part(0), scale.part(5));
  bool marked = false;
  for (const AxisScale::Mark& mark : scale.marks) marked |= mark.text == "0" && mark.at == scale.zero_at;
  EXPECT_TRUE(marked);
}

TEST(AxisScale, FallsBackToAStraightAxisWhereThereAreNoLogarithms) {
  EXPECT_FALSE(axis_scale({"px", true}, std::vector<double>{0, 0}).log);
  EXPECT_FALSE(axis_scale({"px", true}, std::vector<double>{-1, 2}).log);
  EXPECT_FALSE(axis_scale({"px", true}, {}).log);
  const AxisScale straight = axis_scale({"px", false}, std::vector<double>{2, 9});
  EXPECT_GT(straight.part(0), 0) << "a straight axis begins at 0";
  EXPECT_LT(straight.part(9), 1);
}

}  // namespace
}  // namespace rinkaku::report

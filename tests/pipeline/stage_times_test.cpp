#include "pipeline/stage_times.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace rinkaku::pipeline {
namespace {

using std::chrono::nanoseconds;

// The smallest value that at least this fraction of the values does not exceed.
double true_percentile_ms(std::vector<std::int64_t> values_ns, double fraction) {
  std::sort(values_ns.begin(), values_ns.end());
  const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values_ns.size())));
  return static_cast<double>(values_ns[std::max<std::size_t>(rank, 1) - 1]) / 1e6;
}

class Percentiles : public testing::TestWithParam<int> {};

TEST_P(Percentiles, AreWithinOnePercentOfTheSortedTruth) {
  // From a microsecond to about ten seconds, with a long tail as frames have it.
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  std::lognormal_distribution<double> spread(std::log(5e6), 1.5);
  StageTimes times;
  std::vector<std::int64_t> values;
  for (int i = 0; i < GetParam(); ++i) {
    values.push_back(std::clamp<std::int64_t>(std::llround(spread(random)), 1000, 10'000'000'000));
    times.add(nanoseconds(values.back()));
  }
  for (const double fraction : {0.0, 0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const double truth = true_percentile_ms(values, fraction);
    EXPECT_NEAR(times.percentile_ms(fraction), truth, 0.01 * truth) << fraction;  // what the header promises
  }
  EXPECT_EQ(times.count(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Counts, Percentiles, testing::Values(1, 2, 3, 145, 20000));

TEST(StageTimes, MaximumAndMeanAreExact) {
  StageTimes times;
  for (const int us : {200, 900, 100}) times.add(std::chrono::microseconds(us));
  EXPECT_DOUBLE_EQ(times.max_ms(), 0.9);
  EXPECT_DOUBLE_EQ(times.mean_ms(), 0.4);
}

TEST(StageTimes, NoPercentileExceedsTheMaximum) {
  for (std::int64_t ns = 1000; ns < 10'000'000; ns += 1 + ns / 7) {
    StageTimes times;
    times.add(nanoseconds(ns));
    EXPECT_LE(times.percentile_ms(1), times.max_ms()) << ns;
  }
}

TEST(StageTimes, NothingMeasuredIsZero) {
  const StageTimes times;
  EXPECT_EQ(times.count(), 0);
  EXPECT_EQ(times.percentile_ms(0.5), 0);
  EXPECT_EQ(times.mean_ms(), 0);
  EXPECT_EQ(times.max_ms(), 0);
}

TEST(StageTimes, TimesBeyondTheHistogramAreCounted) {
  StageTimes times;
  times.add(nanoseconds(0));
  times.add(std::chrono::hours(100));
  EXPECT_EQ(times.count(), 2);
  EXPECT_LE(times.percentile_ms(0.5), 0.0011);  // the lowest bin, which ends 1.1 % above a microsecond
  EXPECT_DOUBLE_EQ(times.max_ms(), 100 * 3.6e6);
}

}  // namespace
}  // namespace rinkaku::pipeline

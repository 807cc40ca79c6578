#include "mesh/depth_order.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "water/scatter.h"

namespace rinkaku::test {
namespace {

TEST(DepthOrder, IsThatOfAStableSort) {
  std::vector<float> depths;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    // Whole steps of the span, so that many are alike and none lies between two.
    depths.push_back(static_cast<float>(static_cast<int>(65535 * water::scattered(i % 7000, 1))));
  }
  depths.push_back(0), depths.push_back(65535);
  std::vector<std::uint32_t> expected(depths.size());
  std::iota(expected.begin(), expected.end(), 0u);
  std::stable_sort(expected.begin(), expected.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return depths[a] > depths[b]; });
  mesh::DepthOrder order;
  const auto found = order.farthest_first(depths);
  EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
}

TEST(DepthOrder, TakesNoneOneAndEqualOnes) {
  mesh::DepthOrder order;
  EXPECT_TRUE(order.farthest_first({}).empty());
  const std::vector<float> one{3}, same(5, 2.5f);
  EXPECT_EQ(order.farthest_first(one).size(), 1u);
  const auto found = order.farthest_first(same);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(found[i], i);
}

}  // namespace
}  // namespace rinkaku::test

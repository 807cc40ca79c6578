#include "outline/strokes/chains.h"

#include <numeric>

#include <gtest/gtest.h>

#include "outline/strokes/seen_runs.h"
#include "tests/outline/allocation_count.h"

namespace rinkaku::outline {
namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers counted(std::uint32_t n) {
  Numbers numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

Numbers vertices_of(const Chains& chains, std::size_t i) {
  const Chain& chain = chains.chains()[i];
  const auto all = chains.vertices().subspan(chain.first, chain.count);
  return {all.begin(), all.end()};
}

TEST(Chains, ShuffledSegmentsBecomeOneLine) {
  Chains chains(counted(6));
  chains.link(std::vector<Segment>{{3, 4}, {0, 1}, {4, 5}, {2, 3}, {1, 2}});
  ASSERT_EQ(chains.chains().size(), 1u);
  EXPECT_FALSE(chains.chains()[0].closed);
  EXPECT_EQ(vertices_of(chains, 0), counted(6));
}

TEST(Chains, LoopIsClosed) {
  Chains chains(counted(4));
  chains.link(std::vector<Segment>{{2, 3}, {0, 1}, {3, 0}, {1, 2}});
  ASSERT_EQ(chains.chains().size(), 1u);
  EXPECT_TRUE(chains.chains()[0].closed);
  EXPECT_EQ(vertices_of(chains, 0), (Numbers{2, 3, 0, 1, 2}));
}

TEST(Chains, GoOnOverWeldedVertices) {
  // Vertices 1 and 2 are one point.
  Chains chains(Numbers{0, 1, 1, 2});
  chains.link(std::vector<Segment>{{0, 1}, {2, 3}});
  ASSERT_EQ(chains.chains().size(), 1u);
  EXPECT_EQ(vertices_of(chains, 0), (Numbers{0, 1, 3}));
}

TEST(Chains, EverySegmentIsUsedOnceWhereLinesCross) {
  // Two lines through point 2, and a loop apart.
  const std::vector<Segment> segments = {{0, 2}, {2, 1}, {3, 2}, {2, 4}, {5, 6}, {6, 7}, {7, 5}};
  Chains chains(counted(8));
  chains.link(segments);
  ASSERT_EQ(chains.chains().size(), 3u);
  std::size_t steps = 0;
  for (const Chain& chain : chains.chains()) steps += chain.count - 1;
  EXPECT_EQ(steps, segments.size());
}

TEST(Chains, SecondFrameKnowsNothingOfTheFirstAndAllocatesNothing) {
  Chains chains(counted(8));
  chains.link(std::vector<Segment>{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}});
  const std::vector<Segment> segments = {{1, 2}, {5, 6}};
  const long before = test::allocations();
  chains.link(segments);
  EXPECT_EQ(test::allocations(), before);
  ASSERT_EQ(chains.chains().size(), 2u);
  EXPECT_EQ(vertices_of(chains, 0), (Numbers{1, 2}));
}

TEST(Chains, UndirectedSegmentsAreTurnedToFollowOneAnother) {
  const std::vector<Segment> ordered = in_order(std::vector<Segment>{{2, 1}, {3, 4}, {0, 1}, {3, 2}}, counted(5));
  ASSERT_EQ(ordered.size(), 4u);
  for (std::size_t i = 1; i < ordered.size(); ++i) EXPECT_EQ(ordered[i].from, ordered[i - 1].to);
}

// A straight line of ten steps of 10 px each.
struct Straight {
  std::vector<glm::vec3> positions;
  std::vector<Segment> segments;
  Straight() {
    for (int i = 0; i <= 10; ++i) positions.emplace_back(10.0f * static_cast<float>(i), 0, 1);
    for (std::uint32_t i = 0; i < 10; ++i) segments.push_back({i, i + 1});
  }
  // Which vertices each run has if the steps from `first` to before `end` are hidden.
  std::vector<Numbers> runs(std::uint32_t first, std::uint32_t end, float longest_px) {
    std::vector<Segment> sorted;
    for (std::uint32_t i = 0; i < 10; ++i) {
      if (i < first || i >= end) sorted.push_back(segments[i]);
    }
    const auto seen = static_cast<std::uint32_t>(sorted.size());
    sorted.insert(sorted.end(), segments.begin() + first, segments.begin() + end);
    Chains chains(counted(11));
    chains.link(sorted);
    SeenRuns seen_runs;
    glm::mat4 to_pixels(0);  // (x, y, z) to (x, y, z): pixels at a depth of 1
    for (int k = 0; k < 3; ++k) to_pixels[k][k] = 1;
    seen_runs.part(chains, seen, {reinterpret_cast<const std::byte*>(positions.data()), sizeof(glm::vec3)}, to_pixels,
                   longest_px);
    std::vector<Numbers> found;
    for (const SeenRuns::Run& run : seen_runs.runs()) {
      const auto all = seen_runs.vertices().subspan(run.first, run.count);
      found.emplace_back(all.begin(), all.end());
    }
    return found;
  }
};

TEST(SeenRuns, LongHiddenStretchPartsALine) {
  EXPECT_EQ(Straight().runs(3, 6, 25), (std::vector<Numbers>{{0, 1, 2, 3}, {6, 7, 8, 9, 10}}));
}

TEST(SeenRuns, ShortHiddenStretchDoesNot) { EXPECT_EQ(Straight().runs(3, 5, 25), (std::vector<Numbers>{counted(11)})); }

TEST(SeenRuns, HiddenEndIsLeftOut) { EXPECT_EQ(Straight().runs(8, 10, 100), (std::vector<Numbers>{counted(9)})); }

}  // namespace
}  // namespace rinkaku::outline

#include "water/particles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/water/waters.h"
#include "water/painting.h"

namespace rinkaku::test {
namespace {

using water::Particle;
using water::Particles;
using water::Surface;

// A river seen from its bank, with a rock in it.
struct River {
  CameraModel camera = square_camera();
  RigidTransform pose = looking_down(3, 35);
  Surface surface;
  std::vector<water::ArrowKey> arrows;
  River() : surface(flat(outline())) {
    arrows = one_key({{surface.from_world({-3, 4, 0}), {0.8, 0.1}},
                      {surface.from_world({3, 4, 0}), {0.7, 0.3}},
                      {surface.from_world({0, 7, 0}), {1.1, -0.2}}});
  }
  static water::SurfaceOutline outline() {
    return {{{-8, 1.5, 0}, {8, 1.5, 0}, {9, 9, 0}, {0, 8, 0}, {-9, 9, 0}},
            {1, 4},
            {{{0.5, 3.6, 0}, {1.3, 3.7, 0}, {1.2, 4.4, 0}, {0.6, 4.3, 0}}}};
  }
  water::Outlook outlook() const { return {camera, pose}; }
};

water::PaintingOptions options_for(int strokes) {
  water::PaintingOptions o;
  o.strokes = strokes;
  return o;
}

TEST(Particles, StayInTheWaterAndComeAndGoGently) {
  const River river;
  const water::StrokeSize size{0.3};
  const water::StrokeDensity density(river.surface, river.outlook(), size);
  const water::Plots plots(river.surface, density, 3000);
  water::Flow flow(river.surface, river.arrows, {});
  Particles particles(river.surface, plots, flow, {});
  std::vector<Particle> before(particles.list().begin(), particles.list().end());
  for (int frame = 1; frame <= 300; ++frame) {
    particles.advance();
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Particle &a = before[i], &b = particles.list()[i];
      const bool was = a.state != Particle::State::Free, is = b.state != Particle::State::Free;
      if (was && is && a.serial == b.serial) {
        ASSERT_LE(std::abs(a.opacity - b.opacity), 0.1f);
        ASSERT_FALSE(river.surface.crossed_shore(a.at, b.at).found);
      } else if (was) {
        ASSERT_LE(a.opacity, 0.1f);  // it had faded
      }
      ASSERT_TRUE(!is || (was && a.serial == b.serial) || b.opacity <= 0);
      ASSERT_TRUE(b.state != Particle::State::Alive || river.surface.contains(b.at));
    }
    const water::Census& census = particles.census();
    ASSERT_LE(static_cast<double>(census.births), 0.005 * 3000 + census.flowed_in + 1);  // the fraction carried over
    before.assign(particles.list().begin(), particles.list().end());
  }
  // As many as are wanted, give or take what a plot's bounds leave open.
  EXPECT_NEAR(static_cast<double>(particles.census().alive), 3000, 450);
}

TEST(Particles, KeepEveryPlotFilled) {
  const River river;
  const water::StrokeDensity density(river.surface, river.outlook(), {0.3});
  const water::Plots plots(river.surface, density, 3000);
  water::Flow flow(river.surface, river.arrows, {});
  Particles particles(river.surface, plots, flow, {});
  for (int frame = 0; frame < 300; ++frame) particles.advance();
  std::vector<int> count(plots.plots().size(), 0);
  for (const Particle& p : particles.list()) {
    if (p.state != Particle::State::Alive) continue;
    const int plot = plots.find(p.at);
    if (plot >= 0) ++count[plot];
  }
  std::size_t empty = 0;
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (plots.plots()[i].wanted >= 4 && count[i] < 2) ++empty;
  }
  // At the upstream rim plots are being filled while they are swept clear.
  EXPECT_LE(static_cast<double>(empty), 0.02 * static_cast<double>(count.size()));
}

TEST(Particles, StillWaterStandsStill) {
  const Surface s = flat(rectangle(4, 4));
  const water::Plots plots(s, water::StrokeDensity(s, {}, {0.2}), 500);
  water::Flow flow(s, {}, {});
  Particles particles(s, plots, flow, {});
  const std::vector<Particle> before(particles.list().begin(), particles.list().end());
  for (int frame = 0; frame < 20; ++frame) particles.advance();
  EXPECT_EQ(particles.census().births, 0u);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i].at, particles.list()[i].at);
}

std::vector<water::Stroke> painted(water::Painting& painting, const River& river, std::int64_t frame) {
  water::ReferencePicture reference;
  reference.paint(river.surface, river.camera, river.pose, {}, nullptr, nullptr, 1, 4);
  return painting.paint(frame, river.camera, river.pose, [&]() -> const water::ReferencePicture& { return reference; });
}

class Colours : public testing::TestWithParam<water::PaintingOptions::Colours> {};

TEST_P(Colours, GoingToAFrameGivesWhatPlayingGives) {
  const River river;
  water::PaintingOptions options = options_for(800);
  options.colours = GetParam();
  water::Painting played(river.surface, river.arrows, {}, river.outlook(), options);
  water::Painting gone_to(river.surface, river.arrows, {}, river.outlook(), options);
  std::vector<water::Stroke> a;
  for (int frame = 0; frame <= 73; ++frame) a = painted(played, river, frame);
  const std::vector<water::Stroke> b = painted(gone_to, river, 73), c = painted(played, river, 73);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), c.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].middle_px, b[i].middle_px);
    for (int k = 0; k < 4; ++k) ASSERT_NEAR(a[i].colour[k], b[i].colour[k], 1);  // what the filter's memory leaves out
    ASSERT_EQ(a[i].colour, c[i].colour);
  }
  // And back again.
  const std::vector<water::Stroke> d = painted(played, river, 10), e = painted(gone_to, river, 10);
  ASSERT_EQ(d.size(), e.size());
  for (std::size_t i = 0; i < d.size(); ++i) ASSERT_EQ(d[i].middle_px, e[i].middle_px);
}
INSTANTIATE_TEST_SUITE_P(Methods, Colours,
                         testing::Values(water::PaintingOptions::Colours::Keys,
                                         water::PaintingOptions::Colours::Followed));

// With keys the water is known two keys ahead, and strokes are painted where it was.
TEST(Painting, ColoursAtKeysLeaveStrokesWhereTheyAre) {
  const River river;
  water::PaintingOptions options = options_for(800);
  options.key_frames = 7;
  water::Painting keys(river.surface, river.arrows, {}, river.outlook(), options);
  options.colours = water::PaintingOptions::Colours::Sampled;
  water::Painting sampled(river.surface, river.arrows, {}, river.outlook(), options);
  const auto places = [&](water::Painting& painting, int frame) {
    std::vector<std::array<float, 4>> all;
    for (const water::Stroke& s : painted(painting, river, frame)) {
      all.push_back({s.middle_px.x, s.middle_px.y, s.half_px.x, s.half_px.y});
    }
    std::sort(all.begin(), all.end());  // strokes of equal depth lie in the order of the lists, which isn't the same
    return all;
  };
  for (const int frame : {0, 1, 6, 14, 15, 40, 3}) EXPECT_EQ(places(keys, frame), places(sampled, frame)) << frame;
}

TEST(Painting, StrokesGoFromTheFarthestToTheNearestAndShrinkWithDepth) {
  const River river;
  water::PaintingOptions options = options_for(2000);
  options.foreshortening = 0;
  water::Painting painting(river.surface, river.arrows, {}, river.outlook(), options);
  const auto strokes = painted(painting, river, 30);
  ASSERT_GT(strokes.size(), 1500u);
  double near = 0, far = 0;
  int near_count = 0, far_count = 0;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const water::Stroke& s = strokes[i];
    if (i > 0) {
      EXPECT_LE(s.depth_m, strokes[i - 1].depth_m + 1e-3);
    }  // the order's resolution: 1/65535 of some 7 m
    const double beta = 2.0 * glm::length(s.half_px) * s.depth_m;
    (s.depth_m < 5 ? near : far) += beta;
    ++(s.depth_m < 5 ? near_count : far_count);
  }
  // Equation 4: length times depth is the same, on average over the strokes' own differences.
  EXPECT_NEAR(near / near_count, far / far_count, 0.05 * near / near_count);
}

TEST(Painting, StrokesLieAlongTheFlow) {
  const River river;
  water::Painting painting(river.surface, river.arrows, {}, river.outlook(), options_for(1000));
  const auto strokes = painted(painting, river, 10);
  water::Flow flow(river.surface, river.arrows, {});
  flow.set_frame(0);
  double sum = 0, count = 0;
  for (const water::Stroke& s : strokes) {
    const auto at = water::back_projected(river.surface, river.camera, river.pose, s.middle_px);
    if (!at.found || !river.surface.contains(at.at)) continue;
    const glm::dvec2 v = flow.velocity(at.at) / 100.0;
    const glm::dvec2 ahead = seen_at(river.camera, river.pose, river.surface.to_world(at.at + v));
    const glm::dvec2 d = glm::normalize(ahead - glm::dvec2(s.middle_px)), e = glm::normalize(glm::dvec2(s.half_px));
    ASSERT_GT(glm::dot(d, e), 0.94);  // up to 20 degrees where the flow bends around the rock
    sum += glm::dot(d, e), ++count;
  }
  EXPECT_GT(sum / count, 0.99);  // 8 degrees: strokes turn by up to 7 of their own
}

TEST(Painting, FewStrokesAndNoneInSightAreTaken) {
  const River river;
  water::Painting one(river.surface, river.arrows, {}, river.outlook(), options_for(1));
  EXPECT_LE(painted(one, river, 5).size(), 3u);
  River away;
  away.pose.rotation = glm::normalize(glm::dquat(0, 0, 1, 0) * away.pose.rotation);  // looks back
  water::Painting none(away.surface, away.arrows, {}, away.outlook(), options_for(100));
  EXPECT_TRUE(painted(none, away, 5).empty());
}

}  // namespace
}  // namespace rinkaku::test

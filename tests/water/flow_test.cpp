#include "water/flow.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/water/waters.h"

namespace rinkaku::test {
namespace {

using water::Arrow;
using water::Flow;
using water::FlowOptions;
using water::Surface;
using water::SurfaceOutline;

std::vector<Arrow> mixed_arrows() {
  return {
      {{-3, -1}, {1.5, 0.2}}, {{0, 1}, {0.6, 0.9}}, {{3, -1}, {1.2, -0.8}}, {{-1, 1.4}, {1, 0}}, {{2, 1}, {0.4, -0.2}}};
}

// Root mean squares over the water, by central differences across a tenth of a cell.
struct Derivatives {
  double divergence = 0, gradient = 0, speed = 0;
};
Derivatives derivatives(const Surface& s, const Flow& flow) {
  Derivatives d;
  const double h = flow.grid().cell_m / 10;
  int n = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const glm::dvec2 p = s.least() + (s.most() - s.least()) * (glm::dvec2(x + 0.37, y + 0.61) / 60.0);
      if (!s.contains(p)) continue;
      const glm::dvec2 dx = (flow.velocity(p + glm::dvec2(h, 0)) - flow.velocity(p - glm::dvec2(h, 0))) / (2 * h);
      const glm::dvec2 dy = (flow.velocity(p + glm::dvec2(0, h)) - flow.velocity(p - glm::dvec2(0, h))) / (2 * h);
      d.divergence += std::pow(dx.x + dy.y, 2);
      d.gradient += glm::dot(dx, dx) + glm::dot(dy, dy);
      d.speed += glm::dot(flow.velocity(p), flow.velocity(p));
      ++n;
    }
  }
  return {std::sqrt(d.divergence / n), std::sqrt(d.gradient / n), std::sqrt(d.speed / n)};
}

TEST(Flow, HasNoDivergence) {
  const Surface s = flat(rectangle(10, 4, {1, 3}));
  Flow free(s, one_key(mixed_arrows()), {});
  free.set_frame(0);
  const Derivatives d = derivatives(s, free);
  // 0.05 is what is asked of the feature. The field has none; single precision and differences leave some thousandths.
  EXPECT_LT(d.divergence, 0.01 * d.gradient);
  EXPECT_GT(d.speed, 0.3);
  FlowOptions options;
  options.method = FlowOptions::Method::Arrows;
  Flow plain(s, one_key(mixed_arrows()), options);
  plain.set_frame(0);
  const Derivatives e = derivatives(s, plain);
  EXPECT_GT(e.divergence, 0.2 * e.gradient);  // what the arrows ask for does gather and part
}

TEST(Flow, KeepsAFlowThatIsDivergenceFreeAlready) {
  // A parallel stream, and a turning pool: the solution is the wish itself.
  const Surface s = flat(rectangle(8, 8, {0, 1, 2, 3}));
  Flow stream(s, one_key({{{0, 0}, {0.7, -0.3}}}), {});
  stream.set_frame(0);
  for (const glm::dvec2 p : {glm::dvec2(0, 0), glm::dvec2(3.5, -3), glm::dvec2(-2, 3.9)}) {
    EXPECT_LT(glm::distance(stream.velocity(p), glm::dvec2(0.7, -0.3)), 1e-3);  // the smoothing's share
  }
  EXPECT_LT(stream.deviation().largest_rad, 1e-3);
}

TEST(Flow, ARiverThatNarrowsRunsFaster) {
  // From 4 m to 2 m wide: what flows in must flow out, so the mean speed doubles.
  const Surface s = flat(
      {{{-6, -2, 0}, {-1, -2, 0}, {1, -1, 0}, {6, -1, 0}, {6, 1, 0}, {1, 1, 0}, {-1, 2, 0}, {-6, 2, 0}}, {3, 7}, {}});
  Flow flow(s, one_key({{{0, 0}, {1, 0}}}), {});
  flow.set_frame(0);
  const auto through = [&](double x, double half) {
    double sum = 0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i) sum += flow.velocity(s.from_world({x, half * (2 * (i + 0.5) / n - 1), 0})).x;
    return sum * 2 * half / n;
  };
  const double in = through(-5, 2), out = through(5, 1);
  EXPECT_NEAR(in, out, 0.02 * in);  // what is left across the soft shores
  EXPECT_GT(out / 2, 1.8 * in / 4);
}

TEST(Flow, HardlyCrossesShores) {
  SurfaceOutline o = rectangle(10, 4, {1, 3});
  o.obstacles = {{{-1, -0.7, 0}, {0.5, -0.5, 0}, {0.2, 0.6, 0}, {-0.9, 0.4, 0}}};
  const Surface s = flat(o);
  Flow flow(s, one_key({{{-3, 0}, {1, 0}}, {{3, 0}, {1, 0.3}}}), {});
  flow.set_frame(0);
  double across = 0, n = 0;
  for (const water::BorderEdge& e : s.edges()) {
    if (e.open) continue;
    const glm::dvec2 d = glm::normalize(e.b - e.a);
    for (int k = 0; k < 50; ++k) {
      const glm::dvec2 v = flow.velocity(e.a + (e.b - e.a) * ((k + 0.5) / 50));
      across += std::pow(v.x * d.y - v.y * d.x, 2);
      ++n;
    }
  }
  // A tenth of the speed at sharp corners, which a grid of 0.2 m rounds; a few hundredths on average.
  EXPECT_LT(std::sqrt(across / n), 0.05);
}

TEST(Flow, GoesAroundBodies) {
  const Surface s = flat(rectangle(10, 6, {1, 3}));
  std::vector<water::Segment> ring;
  for (int i = 0; i < 40; ++i) {
    const double a = 2 * std::acos(-1.0) * i / 40, b = 2 * std::acos(-1.0) * (i + 1) / 40;
    ring.push_back({{0.8 * std::cos(a), 0.8 * std::sin(a)}, {0.8 * std::cos(b), 0.8 * std::sin(b)}});
  }
  Flow flow(s, one_key({{{-3, 0}, {1, 0}}, {{3, 0}, {1, 0}}}), {}, ring);
  flow.set_frame(0);
  EXPECT_LT(glm::length(flow.velocity({-0.82, 0})), 0.25);  // it meets the body here
  EXPECT_GT(glm::length(flow.velocity({0, 0.95})), 1.05);   // and is faster beside it
}

TEST(Flow, OppositeKeysKeepHalfTheSpeedOffTheShores) {
  const Surface s = flat(rectangle(20, 20, {0, 1, 2, 3}));
  const std::vector<water::ArrowKey> keys{{0, {{{-4, 0}, {2, 0}}, {{4, 1}, {2, 0}}, {{0, 5}, {2, 0.4}}}},
                                          {30, {{{-4, 0}, {-1, 0}}, {{4, 1}, {-1, 0}}, {{0, 5}, {-1, -0.2}}}}};
  Flow flow(s, keys, {});
  for (int frame = 0; frame <= 30; ++frame) {
    flow.set_frame(frame);
    for (int y = -6; y <= 6; y += 3) {
      for (int x = -6; x <= 6; x += 3) {
        EXPECT_GT(glm::length(flow.velocity(glm::dvec2(x, y))), 0.5) << "frame " << frame;  // half the slower key's
      }
    }
  }
}

// A pool that turns about its middle once in about 47 frames: at 60 pixels from it, 8 pixels a frame.
class Vortex : public testing::TestWithParam<double> {};

TEST_P(Vortex, CarriesAlongTheExactPath) {
  constexpr double px = 0.01;  // metres
  const double speed = GetParam() * px * 25;
  const Surface s = flat(rectangle(4, 4, {0, 1, 2, 3}));
  std::vector<Arrow> arrows;
  for (int i = 0; i < 12; ++i) {
    const double a = 2 * std::acos(-1.0) * i / 12;
    arrows.push_back({{0.6 * std::cos(a), 0.6 * std::sin(a)}, {-speed * std::sin(a), speed * std::cos(a)}});
  }
  FlowOptions options;
  options.alpha_m = 0.1;
  Flow flow(s, one_key(arrows), options);
  flow.set_frame(0);
  glm::dvec2 p(0.6, 0), exact = p, velocity;
  const auto rate = [&](glm::dvec2 q) { return flow.velocity(q); };
  for (int frame = 0; frame < 120; ++frame) {
    carry_along(flow, s, 1 / 25.0, p, velocity);
    // The same field in 200 steps of a second-order method: its error is below 1e-4 pixels.
    constexpr int steps = 200;
    constexpr double dt = 1 / 25.0 / steps;
    for (int i = 0; i < steps; ++i) exact += rate(exact + rate(exact) * (dt / 2)) * dt;
  }
  EXPECT_GT(glm::length(flow.velocity(exact)), 0.8 * speed);  // it is still in the vortex
  EXPECT_LT(glm::distance(p, exact) / px, 0.05);
}
INSTANTIATE_TEST_SUITE_P(PixelsAFrame, Vortex, testing::Values(2.0, 8.0, 16.0));

TEST(Flow, NothingCarriedCrossesAShore) {
  SurfaceOutline o = rectangle(6, 3);
  o.obstacles = {{{-1, -0.5, 0}, {0.5, -0.5, 0}, {0.2, 0.6, 0}}};
  const Surface s = flat(o);
  for (const auto method : {FlowOptions::Method::Arrows, FlowOptions::Method::DivergenceFree}) {
    FlowOptions options;
    options.method = method;
    // Straight at the shores, 1.6 m a frame.
    Flow flow(s, one_key({{{-2, 0}, {40, 10}}, {{2, 0}, {-10, -40}}}), options);
    flow.set_frame(0);
    for (int i = 0; i < 60; ++i) {
      glm::dvec2 p(-2.8 + 5.6 * i / 60, -1.3 + 2.6 * ((i * 7) % 60) / 60.0), velocity;
      if (!s.contains(p)) continue;
      for (int frame = 0; frame < 50; ++frame) {
        const glm::dvec2 before = p;
        carry_along(flow, s, 1 / 25.0, p, velocity);
        ASSERT_TRUE(s.contains(p)) << before.x << " " << before.y;
      }
    }
  }
}

TEST(Flow, StiffCasesStayFinite) {
  struct Case {
    const char* name;
    SurfaceOutline outline;
    std::vector<Arrow> arrows;
    double alpha_m;
  };
  const Case cases[] = {
      {"tiny", rectangle(1e-3, 1e-3), {{{0, 0}, {1, 0}}}, 0},
      {"sliver", rectangle(10, 0.01, {1, 3}), {{{0, 0}, {1, 0}}}, 0},
      {"opposite", rectangle(4, 4), {{{0, 0}, {1, 0}}, {{0, 0}, {-1, 0}}}, 0},
      {"no alpha", rectangle(4, 4, {1, 3}), {{{-1, 0}, {1, 0}}, {{1, 0}, {-1, 2}}}, 1e-300},
      {"far arrow", rectangle(4, 4, {1, 3}), {{{1e5, 1e5}, {1e3, 0}}}, 0},
      {"none", rectangle(4, 4), {}, 0},
  };
  for (const Case& c : cases) {
    const Surface s = flat(c.outline);
    FlowOptions options;
    options.alpha_m = c.alpha_m;
    Flow flow(s, c.arrows.empty() ? std::vector<water::ArrowKey>{} : one_key(c.arrows), options);
    flow.set_frame(0);
    for (int i = 0; i < 25; ++i) {
      glm::dvec2 p = s.least() + (s.most() - s.least()) * glm::dvec2((i % 5 + 0.5) / 5, (i / 5 + 0.5) / 5), velocity(0);
      carry_along(flow, s, 1 / 25.0, p, velocity);
      EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << c.name;
      EXPECT_TRUE(s.contains(p) || !c.outline.open_edges.empty()) << c.name;
    }
  }
}

}  // namespace
}  // namespace rinkaku::test

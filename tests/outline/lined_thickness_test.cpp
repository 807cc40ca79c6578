// Lines whose added width is limited by the thickness of what they surround.
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "outline/local_thickness.h"
#include "tests/outline/lined.h"
#include "tests/outline/surfaces.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

class LinedThickness : public GlTest {};

// A closed body of revolution about y, seen from the side: a rod or a ball.
mesh::Mesh turned(const std::function<glm::dvec2(double)>& profile) {
  return grid_mesh({48, 40, true, false}, [&](double u, double v) {
    const double angle = -2 * std::numbers::pi * u, radius = v == 0 || v == 1 ? 0.0 : profile(v).x;
    return glm::dvec3(radius * std::cos(angle), profile(v).y, radius * std::sin(angle));
  });
}

outline::HullOptions within_thickness(const mesh::Mesh& mesh, std::span<const float> factors, double part) {
  outline::HullOptions options;
  options.style.factors = factors;
  options.style.most_added_m = outline::local_thickness(mesh::topology(mesh));
  for (float& t : options.style.most_added_m) t *= static_cast<float>(part);
  return options;
}

// A rod 0.1 m thick, and a line nine times as wide as asked for: it grows by half of the rod's thickness only, from
// near and from afar, in pixels and in metres.
TEST_F(LinedThickness, WhatIsAddedToAThinRodIsAPartOfItsThickness) {
  const View v = view(240, 240, 400);
  const mesh::Mesh rod = turned([](double t) { return glm::dvec2(0.05, t - 0.5); });
  const std::vector<float> factors(rod.point_count, 9.0f);
  for (const bool metres : {false, true}) {
    for (const double distance : {5.0, 10.0, 20.0}) {
      outline::HullOptions options = within_thickness(rod, factors, 0.5);
      options.look.width_px = 2;
      if (metres) options.look.width_m = 0.05f;
      const double base_px = metres ? 0.05 * 400 / distance : 2, rod_px = 0.1 * 400 / distance;
      const Layer layer = drawn(scene_of(lined(rod, moved(0.001, 0, distance), options)), v);
      const glm::dvec2 contour(v.camera.cx_px + 0.001 * 400 / distance - rod_px / 2, v.camera.cy_px);
      // Thickness is right within 7 %, lines within a quarter of a pixel. Of the rod of 2 px the 4 px inside are partly
      // the line on its other side.
      EXPECT_NEAR(reach_px(layer, contour, {-1, 0}, 18), base_px + rod_px / 2, 0.25 + 0.035 * rod_px)
          << distance << (metres ? " in metres" : " in pixels");
    }
  }
}

TEST_F(LinedThickness, ABallThickerThanItsLineKeepsAllOfIt) {
  const View v = view(240, 240, 400);
  const mesh::Mesh ball =
      turned([](double t) { return glm::dvec2(std::sin(std::numbers::pi * t), -std::cos(std::numbers::pi * t)); });
  const std::vector<float> factors(ball.point_count, 5.0f);
  outline::HullOptions limited = within_thickness(ball, factors, 0.5), free;
  free.style.factors = factors;
  limited.look.width_px = free.look.width_px = 2;
  // 80 px thick.
  const glm::dmat4 near = moved(0.001, 0.002, 10);
  const Layer one = drawn(scene_of(lined(ball, near, limited)), v), other = drawn(scene_of(lined(ball, near, free)), v);
  EXPECT_EQ(area_px(one), area_px(other));
  EXPECT_GT(area_px(one), std::numbers::pi * 49 * 49);
  // From afar, 8 px thick, it gets 2 + 4 px of 10: half of the ball's 8, less by the 6 % that rays see of a ball.
  const Layer far = drawn(scene_of(lined(ball, moved(0, 0, 100), limited)), v);
  EXPECT_NEAR(reach_px(far, {v.camera.cx_px - 4, v.camera.cy_px}, {-1, 0}, 10), 2 + 4 * 0.94, 0.25);
}

}  // namespace
}  // namespace rinkaku::test

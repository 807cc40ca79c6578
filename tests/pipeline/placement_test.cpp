#include "pipeline/objects/placement.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "tests/pipeline/source/media_tools.h"

namespace rinkaku::pipeline {
namespace {

using Anchor = ObjectScene::Anchor;

// Sides of different lengths, off the origin: no two axes or corners can be mistaken for each other.
const mesh::Box box{{1, 2, 3}, {3, 6, 11}};  // middle (2, 4, 7), size 2 x 4 x 8

// Sums of a few products of numbers up to 100 in double: 1e-12 leaves a factor of 100.
constexpr double rounding = 1e-12;

glm::dvec3 placed(const ObjectScene& object, const glm::dvec3& point, char up = 'z') {
  return glm::dvec3(world_from_object(object, box, up) * glm::dvec4(point, 1));
}

void expect_at(const glm::dvec3& got, const glm::dvec3& expected) {
  EXPECT_NEAR(glm::distance(got, expected), 0, rounding)
      << "(" << got.x << ", " << got.y << ", " << got.z << ") instead of (" << expected.x << ", " << expected.y << ", "
      << expected.z << ")";
}

ObjectScene at_origin() {
  ObjectScene object;
  object.anchor = Anchor::Origin;
  return object;
}

TEST(Placement, ZUpMeshKeepsItsAxes) { expect_at(placed(at_origin(), {1, 2, 3}, 'z'), {1, 2, 3}); }

TEST(Placement, YUpMeshStandsUpAndFacesDownThePrint) {
  expect_at(placed(at_origin(), {0, 1, 0}, 'y'), {0, 0, 1});
  expect_at(placed(at_origin(), {0, 0, 1}, 'y'), {0, -1, 0});  // glTF's front
  expect_at(placed(at_origin(), {1, 0, 0}, 'y'), {1, 0, 0});
}

TEST(Placement, XUpMeshStandsUp) { expect_at(placed(at_origin(), {1, 0, 0}, 'x'), {0, 0, 1}); }

TEST(Placement, UpAxesKeepRightHandedness) {
  for (const char up : {'x', 'y', 'z'}) {
    EXPECT_NEAR(glm::determinant(glm::dmat3(world_from_object(at_origin(), box, up))), 1, rounding) << up;
  }
}

TEST(Placement, TheScenesUpWinsOverTheMeshes) {
  ObjectScene object = at_origin();
  object.up = 'x';
  expect_at(placed(object, {1, 0, 0}, 'y'), {0, 0, 1});
}

TEST(Placement, BaseIsTheMiddleOfTheBottom) {
  ObjectScene object;
  object.position_m = {10, 20, 30};
  expect_at(placed(object, {2, 4, 3}, 'z'), {10, 20, 30});
  expect_at(placed(object, {2, 2, 7}, 'y'), {10, 20, 30});
  expect_at(placed(object, {1, 4, 7}, 'x'), {10, 20, 30});
}

TEST(Placement, OriginIsTheMeshesOwn) {
  ObjectScene object = at_origin();
  object.position_m = {10, 20, 30};
  expect_at(placed(object, {0, 0, 0}, 'y'), {10, 20, 30});
}

TEST(Placement, HeightIsMeasuredAlongTheUpAxis) {
  ObjectScene object;
  object.height_m = 0.5;
  expect_at(placed(object, {2, 4, 11}, 'z'), {0, 0, 0.5});
  expect_at(placed(object, {2, 6, 7}, 'y'), {0, 0, 0.5});
  expect_at(placed(object, {3, 4, 7}, 'x'), {0, 0, 0.5});
  // The other axes keep their proportion: 8 high became 0.5, so the half width of 1 becomes 0.0625.
  expect_at(placed(object, {3, 4, 3}, 'z'), {0.0625, 0, 0});
}

TEST(Placement, FlatMeshHasNoHeightToScale) {
  ObjectScene object;
  object.mesh = "leaf.obj";
  object.height_m = 1;
  const mesh::Box flat{{0, 0, 0}, {1, 0, 1}};
  EXPECT_NO_THROW(world_from_object(object, flat, 'z'));
  const std::string line = test::error_of(Error::Kind::Input, [&] { world_from_object(object, flat, 'y'); });
  EXPECT_EQ(line,
            "leaf.obj: the mesh has no height along its up axis y; give scale instead of height_m, or another up");
}

// Independently: the point is turned by hand, one axis after the other, about axes that stay where they are.
glm::dvec3 turned(glm::dvec3 p, const glm::dvec3& deg) {
  const auto turn = [](double& a, double& b, double angle_deg) {
    const double r = angle_deg * std::acos(-1.0) / 180, a0 = a, b0 = b;
    a = std::cos(r) * a0 - std::sin(r) * b0;
    b = std::sin(r) * a0 + std::cos(r) * b0;
  };
  turn(p.y, p.z, deg.x);
  turn(p.z, p.x, deg.y);
  turn(p.x, p.y, deg.z);
  return p;
}

TEST(Placement, RotatesAboutWorldXThenYThenZ) {
  ObjectScene object = at_origin();
  object.rotation_deg = {90, 0, 90};
  // About x, y goes to z, which the turn about z leaves alone; in the other order y would end at -x.
  expect_at(placed(object, {0, 1, 0}), {0, 0, 1});
  object.rotation_deg = {20, -70, 130};
  for (const glm::dvec3 p : {glm::dvec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {3, -4, 5}}) {
    expect_at(placed(object, p), turned(p, object.rotation_deg));
  }
}

TEST(Placement, RotatesAboutTheAnchorAndThenMoves) {
  ObjectScene object;
  object.rotation_deg = {0, 0, 90};
  object.position_m = {10, 20, 30};
  expect_at(placed(object, {2, 4, 3}), {10, 20, 30});
  expect_at(placed(object, {3, 4, 3}), {10, 21, 30});
}

TEST(Placement, ScalesBeforeItRotates) {
  ObjectScene object = at_origin();
  object.scale = {2, 3, 5};
  object.rotation_deg = {0, 0, 90};
  expect_at(placed(object, {1, 1, 1}), {-3, 2, 5});
}

TEST(Placement, NegativeScaleMirrors) {
  ObjectScene object = at_origin();
  object.scale = {-1, 1, 1};
  expect_at(placed(object, {1, 2, 3}), {-1, 2, 3});
  EXPECT_NEAR(glm::determinant(glm::dmat3(world_from_object(object, box, 'z'))), -1, rounding);
}

}  // namespace
}  // namespace rinkaku::pipeline

// Fields of view from 1 to 170 degrees, distances from a millimetre to a hundred kilometres, objects from a millionth
// to a million units, far from the origin, pictures from one pixel to 8192x4320: the picture is what geometry says.
#include <numbers>

#include "tests/outline/lined.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

constexpr double pi = std::numbers::pi;

class Extreme : public GlTest {};

int largest_difference(const Layer& a, const Layer& b) {
  if (!(a.rect == b.rect)) return 256;
  int largest = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
  return largest;
}

double focal_for(double fov_deg, int width_px) { return width_px / 2.0 / std::tan(fov_deg / 360 * pi); }

/// Where a unit sphere stands so that it is seen `radius_px` large in the picture's middle.
double distance_for(double radius_px, double focal_px) { return 1 / std::sin(std::atan(radius_px / focal_px)); }

TEST_F(Extreme, FieldsOfViewFrom1To170Degrees) {
  // At 170 degrees the eye is so near that it sees a cap of the sphere, whose rim has a tenth of the edges.
  const mesh::Mesh coarse = sphere(5), fine = sphere(6);
  for (const double fov_deg : {1.0, 2.0, 5.0, 20.0, 60.0, 90.0, 120.0, 150.0, 170.0}) {
    const int width_px = 400, radius_px = 80;
    const double focal_px = focal_for(fov_deg, width_px);
    const View v = view(width_px, 300, focal_px);
    const mesh::Mesh& ball = fov_deg > 140 ? fine : coarse;
    const glm::dmat4 place = moved(0, 0, distance_for(radius_px, focal_px));
    // A feather is right to a few hundredths of a pixel, of 80.
    EXPECT_NEAR(area_px(drawn(scene_of(toon(ball, place)), v)) / (pi * radius_px * radius_px), 1, 0.004) << fov_deg;
    const double outer_px = radius_px + 4;
    EXPECT_NEAR(area_px(drawn(scene_of(lined(ball, place, 4)), v)) / (pi * outer_px * outer_px), 1, 0.008) << fov_deg;
  }
}

// A picture doesn't know how large the world is.
TEST_F(Extreme, DistancesFromAMillimetreToAHundredKilometresGiveOnePicture) {
  const mesh::Mesh shape = cylinder(48);
  const View v = view(320, 240, 300);
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 0.5));
  const Layer expected = drawn(scene_of(lined(shape, moved(0.2, 0.1, 4) * turned, 3)), v);
  for (const double metres : {1e-3, 1e-2, 1.0, 1e2, 1e4, 1e5}) {
    const double s = metres / 4;
    const Layer layer = drawn(scene_of(lined(shape, scaled(s) * moved(0.2, 0.1, 4) * turned, 3)), v);
    // Rounding to float may move an edge by a hundredth of a pixel, which is three levels of 255.
    EXPECT_LE(largest_difference(layer, expected), 3) << metres;
  }
}

TEST_F(Extreme, MeshesOfAnyUnitGiveOnePicture) {
  const View v = view(320, 240, 300);
  const glm::dmat4 place = moved(0.2, 0.1, 4) * glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 0.5));
  const Layer expected = drawn(scene_of(lined(cylinder(48), place, 3)), v);
  for (const double unit : {1e-6, 1e-3, 1e3, 1e6}) {
    mesh::Mesh shape = cylinder(48);
    for (glm::vec3& p : shape.positions) p *= static_cast<float>(unit);
    const Layer layer = drawn(scene_of(lined(shape, place * scaled(1 / unit), 3)), v);
    EXPECT_LE(largest_difference(layer, expected), 3) << unit;
  }
}

// Places are composed in double, so an object a hundred kilometres from the world's origin stands still.
TEST_F(Extreme, FarFromTheOriginNothingShakes) {
  const mesh::Mesh shape = cylinder(48);
  const glm::dmat4 place = moved(0.2, 0.1, 4) * glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 0.5));
  const Layer expected = drawn(scene_of(lined(shape, place, 3)), view(320, 240, 300));
  for (const glm::dvec3& away : {glm::dvec3(1e5, 0, 0), glm::dvec3(-3e4, 7e4, 1e5)}) {
    View v = view(320, 240, 300);
    v.camera_from_world.translation_m = -away;
    const Layer layer = drawn(scene_of(lined(shape, moved(away.x, away.y, away.z) * place, 3)), v);
    EXPECT_LE(largest_difference(layer, expected), 3) << away.x;
  }
}

TEST_F(Extreme, PicturesFromOnePixelToEightThousand) {
  const mesh::Mesh ball = sphere(5);
  for (const auto& [width_px, height_px] : {std::pair{1, 1}, {2, 3}, {17, 31}, {641, 479}, {8192, 4320}}) {
    const double radius_px = 0.3 * height_px;
    const View v = view(width_px, height_px, height_px);
    const Layer layer = drawn(scene_of(toon(ball, moved(0, 0, distance_for(radius_px, height_px)))), v);
    const double visible = std::min(1.0 * width_px * height_px, pi * radius_px * radius_px);
    // A feather may be wrong by a sixth of a pixel where the contour turns within a few pixels.
    const double rim = 2 * pi * radius_px / 6;
    if (radius_px > 1) {
      EXPECT_NEAR(area_px(layer), visible, rim + 0.004 * visible) << width_px << "x" << height_px;
    } else {
      EXPECT_GT(area_px(layer), 0) << "what is smaller than a pixel is still seen";
    }
  }
}

// A line of 3 pixels around what is itself smaller than a pixel is a dot of that size, not nothing and not a blot.
TEST_F(Extreme, ObjectSmallerThanAPixelKeepsItsLine) {
  const mesh::Mesh ball = sphere(4);
  const View v = view(64, 48, 50);
  for (const double radius_px : {0.3, 0.05, 0.001}) {
    const Layer layer = drawn(scene_of(lined(ball, moved(0, 0, distance_for(radius_px, 50)), 3)), v);
    EXPECT_LT(area_px(layer), pi * (4 + radius_px) * (4 + radius_px)) << radius_px;
    for (const std::uint8_t value : layer.rgba) ASSERT_LE(value, 255);
  }
}

}  // namespace
}  // namespace rinkaku::test

// Eyes where nobody would put a camera: in a triangle's plane, on a vertex or an edge, inside the mesh, with the near
// plane cutting the object, along the axis of everything.
#include <numbers>

#include "tests/outline/lined.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

class Viewpoint : public GlTest {};

/// Premultiplied colour never exceeds its alpha: what is drawn is a picture, not what NaN left of it.
void expect_sound(const Layer& layer, const char* what) {
  for (std::size_t i = 0; i < layer.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) ASSERT_LE(layer.rgba[i + c], layer.rgba[i + 3] + 1) << what;
  }
}

// The cube from -1 to 1, seen from a point in the camera's own axes.
Layer cube_from(const glm::dvec3& eye, const glm::dvec3& towards, double focal_px = 100) {
  const glm::dvec3 z = glm::normalize(towards - eye);
  const glm::dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z));
  const glm::dmat3 world_from_camera(x, glm::cross(z, x), z);
  const glm::dmat4 camera_from_world = glm::dmat4(glm::transpose(world_from_camera)) * moved(-eye.x, -eye.y, -eye.z);
  return drawn(scene_of(lined(cube(), camera_from_world, 3)), view(200, 150, focal_px));
}

TEST_F(Viewpoint, EyeInTheExactPlaneOfAFaceSeesItsNeighbourAlone) {
  // The face x = 1 is seen edge on; of the cube only the face z = -1 is to be seen, 2/3 of the focal length wide.
  const Layer layer = cube_from({1, 0, -4}, {1, 0, 0});
  const double side_px = 2.0 / 3 * 100;
  // Body and a line of 3 pixels around it, with mitered corners.
  EXPECT_NEAR(area_px(layer), (side_px + 6) * (side_px + 6), 0.02 * side_px * side_px);
  // And just beside the plane the picture is nearly the same: nothing flips.
  EXPECT_NEAR(area_px(cube_from({1 + 1e-9, 0, -4}, {1 + 1e-9, 0, 0})), area_px(layer), 1);
  EXPECT_NEAR(area_px(cube_from({1 - 1e-9, 0, -4}, {1 - 1e-9, 0, 0})), area_px(layer), 1);
}

TEST_F(Viewpoint, EyeOnTheMeshItselfDrawsSomethingFinite) {
  for (const glm::dvec3& eye : {glm::dvec3(1, 1, -1), glm::dvec3(1, 0.3, -1), glm::dvec3(0.3, 0.3, -1),
                                glm::dvec3(1, 1, -1.0001), glm::dvec3(1, 0.3, -1.0001)}) {
    expect_sound(cube_from(eye, {0, 0, 0}), "towards the middle");
    expect_sound(cube_from(eye, {3, 0.3, -1}), "along the face");
    expect_sound(cube_from(eye, {0.3, 0.3, -9}), "away");
  }
}

TEST_F(Viewpoint, EyeInsideAClosedMeshSeesNothingOfIt) {
  EXPECT_EQ(area_px(cube_from({0.1, 0.2, 0.3}, {1, 0, 0})), 0);
  EXPECT_EQ(area_px(cube_from({0.999, 0.999, 0.999}, {-1, -1, -1})), 0);
}

TEST_F(Viewpoint, ObjectBehindTheEyeIsNotDrawn) {
  EXPECT_EQ(area_px(cube_from({0, 0, -4}, {0, 0, -8})), 0);
  EXPECT_EQ(area_px(cube_from({5, 0, 0}, {9, 0, 0})), 0);
}

// Nearly touching, the face fills the picture, line or no line.
TEST_F(Viewpoint, FaceThatTouchesTheEyeFillsThePicture) {
  for (const double gap : {0.1, 1e-2, 1e-3}) {
    const Layer layer = cube_from({0, 0, -1 - gap}, {0, 0, 0});
    EXPECT_EQ(area_px(layer), 200.0 * 150) << gap;
  }
}

TEST_F(Viewpoint, WideAnglesBesideTheObjectStaySound) {
  for (double turn = 0; turn < 2 * std::numbers::pi; turn += 0.37) {
    const glm::dvec3 eye(1.05 * std::cos(turn), 1.05 * std::sin(turn), 0.2);
    expect_sound(cube_from(eye, eye + glm::dvec3(-std::sin(turn), std::cos(turn), 0.1), 9), "beside");  // 169 degrees
  }
}

}  // namespace
}  // namespace rinkaku::test

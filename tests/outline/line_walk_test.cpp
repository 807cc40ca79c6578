#include "outline/verify/line_walk.h"

#include <gtest/gtest.h>

#include "mesh/bounds.h"
#include "mesh/import.h"
#include "outline/curvature.h"
#include "outline/line_width.h"
#include "tests/outline/lined.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"
#include "tests/support/test_data.h"

namespace rinkaku::test {
namespace {

using outline::LineWalker;
using outline::WalkedLine;
using passes::Layer;

class LineWalk : public GlTest {};

glm::dmat4 turned(int i) {
  return moved(0.01, -0.02, 4) * glm::rotate(glm::dmat4(1), 0.2 + i * 0.53, {0.5, 1, 0.3}) *
         glm::rotate(glm::dmat4(1), i * 1.1, {1, 0, 0});
}

// A ball's contour is as long as the circle that it is seen as, and the walker goes along all of it once.
TEST_F(LineWalk, GoesAlongTheWholeContour) {
  const passes::View v = view(240, 240, 300);
  const mesh::Mesh ball = sphere(5);
  const mesh::Topology topology = mesh::topology(ball);
  const Layer layer = drawn(scene_of(lined(ball, turned(0), 3)), v);
  const WalkedLine walked = LineWalker(topology).walk(v, turned(0), layer);
  const double radius_px = 300 / std::sqrt(16.0 - 1);
  // Steps are up to a pixel long, an edge at least one, and the contour zigzags along edges.
  EXPECT_GT(static_cast<double>(walked.places), 0.9 * 2 * 3.14159 * radius_px);
  EXPECT_GT(walked.border, 4 * radius_px);
  EXPECT_EQ(walked.gaps(), 0u);
}

// What is rubbed out of a line is found, around the mesh and over it, and nothing else.
TEST_F(LineWalk, FindsWhatIsRubbedOut) {
  const passes::View v = view(240, 240, 300);
  const mesh::Mesh ball = sphere(4);
  const mesh::Topology topology = mesh::topology(ball);
  Layer layer = drawn(scene_of(lined(ball, turned(0), 3)), v);
  LineWalker walker(topology);
  ASSERT_EQ(walker.walk(v, turned(0), layer).gaps(), 0u);
  // Four rows to the right of the ball.
  const int middle = static_cast<int>(v.camera.cx_px);
  for (int y = middle; y < middle + 4; ++y) {
    for (int x = middle + 20; x < 240; ++x) {
      if (at(layer, x, y)[1] > 100) continue;
      const std::size_t i = static_cast<std::size_t>((y - layer.rect.y_px) * layer.rect.width_px + x - layer.rect.x_px);
      if (x < layer.rect.right_px()) std::fill_n(layer.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, 0);
    }
  }
  const WalkedLine walked = walker.walk(v, turned(0), layer);
  EXPECT_GE(walked.border_gaps, 3u);
  EXPECT_LE(walked.border_gaps, 8u);
  EXPECT_GE(walked.place_gaps, 2u);
  EXPECT_LE(walked.place_gaps, 8u);
  for (const glm::ivec2& p : walked.where) EXPECT_NEAR(p.y, middle + 1.5, 3.5) << p.x;
}

// Without a line every place along the contour is a gap, those over the mesh itself too.
TEST_F(LineWalk, FindsNothingWhereNothingIsDrawn) {
  const passes::View v = view(240, 240, 300);
  const mesh::Mesh ball = sphere(4);
  const mesh::Topology topology = mesh::topology(ball);
  const Layer layer = drawn(scene_of(toon(ball, turned(0))), v);
  const WalkedLine walked = LineWalker(topology).walk(v, turned(0), layer);
  EXPECT_EQ(walked.place_gaps, walked.places);
  EXPECT_GT(walked.places, 100u);
}

// Real meshes, around them and where they hide themselves, with even lines and with those that follow curvature.
class RealClosedMeshes : public GlTest, public testing::WithParamInterface<const char*> {};

TEST_P(RealClosedMeshes, HaveNoGapInTheirLines) {
  RINKAKU_NEEDS_DATA();
  mesh::Mesh mesh = mesh::import(data(std::string("meshes/closed/") + GetParam())).mesh;
  mesh.colours.clear(), mesh.textures.clear();
  for (mesh::Material& material : mesh.materials) material = {};
  const mesh::Topology topology = mesh::topology(mesh);
  const outline::Curvature curvature = outline::curvature(topology);
  const std::vector<float> factors = outline::line_width_factors(topology, curvature, outline::k95(curvature), {});
  const mesh::Sphere around = mesh::bounding_sphere(mesh.positions);
  const passes::View v = view(300, 300, 450);
  for (const bool follows : {false, true}) {
    outline::HullOptions options;
    options.look.colour = {1, 0, 0};
    if (follows) options.style.factors = factors;
    for (int i = 0; i < 8; ++i) {
      const glm::dmat4 place =
          turned(i) * scaled(1 / around.radius) * glm::translate(glm::dmat4(1), -glm::dvec3(around.centre));
      const Layer layer = drawn(scene_of(lined(mesh, place, options)), v);
      const WalkedLine walked = LineWalker(topology).walk(v, place, layer);
      EXPECT_EQ(walked.gaps(), 0u) << "view " << i << (follows ? ", following curvature" : "") << ", first at "
                                   << (walked.where.empty() ? glm::ivec2(0) : walked.where[0]).x << ", "
                                   << (walked.where.empty() ? glm::ivec2(0) : walked.where[0]).y;
      EXPECT_GT(walked.places, 300u);
    }
  }
}

// One of 500 sides on a golden spiral.
struct Side {
  const char* mesh;
  int side;
  double distance;
};

class HardSides : public GlTest, public testing::WithParamInterface<Side> {};

TEST_P(HardSides, HaveNoGapInTheirLines) {
  RINKAKU_NEEDS_DATA();
  mesh::Mesh mesh = mesh::import(data(std::string("meshes/closed/") + GetParam().mesh)).mesh;
  mesh.colours.clear(), mesh.textures.clear();
  for (mesh::Material& material : mesh.materials) material = {};
  const mesh::Topology topology = mesh::topology(mesh);
  const auto [name, side, distance] = GetParam();
  const double height = 1 - (2 * side + 1.0) / 500, around = std::acos(-1.0) * (3 - std::sqrt(5.0)) * side;
  const double across = std::sqrt(1 - height * height);
  const glm::dvec3 ahead(-across * std::cos(around), -height, -across * std::sin(around));
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, {std::cos(2.0 * side), 0.3, std::sin(2.0 * side)}));
  const glm::dmat3 turn = glm::transpose(glm::dmat3(right, glm::cross(ahead, right), ahead));
  const mesh::Sphere ball = mesh::bounding_sphere(mesh.positions);
  const glm::dmat4 place =
      moved(0, 0, distance) * glm::dmat4(turn) * scaled(1 / ball.radius) * glm::translate(glm::dmat4(1), -ball.centre);
  const passes::View v = view(512, 512, 0.43 * 512 * std::sqrt(distance * distance - 1));
  const Layer layer = drawn(scene_of(lined(mesh, place, 3)), v);
  const WalkedLine walked = LineWalker(topology, 2.5).walk(v, place, layer);
  EXPECT_EQ(walked.gaps(), 0u);
  EXPECT_GT(walked.places, 1000u);
}

// One contour some pixels before another, and a large flat part: a coarser body hides the inner side of the farther
// line, but never all of its 3 px. A slit in which a contour is hidden for a hundredth of a pixel. A contour that turns
// back at a cusp.
INSTANTIATE_TEST_SUITE_P(Meshes, HardSides,
                         testing::Values(Side{"oded_penguin_27k.obj", 66, 4}, Side{"pmp_fandisk_13k.off", 1, 2.5},
                                         Side{"pmp_fandisk_13k.off", 7, 8}, Side{"oded_koala_100k.obj", 97, 2.5},
                                         Side{"oded_fish_1k9.obj", 189, 2.5}));

INSTANTIATE_TEST_SUITE_P(Meshes, RealClosedMeshes,
                         testing::Values("oded_spot_23k.obj", "pmp_fandisk_13k.off", "cgal_elephant_5k6.off"));

}  // namespace
}  // namespace rinkaku::test

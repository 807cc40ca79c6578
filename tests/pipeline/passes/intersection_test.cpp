#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <gtest/gtest.h>

#include "mesh/intersections.h"
#include "mesh/topology.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

class Intersection : public GlTest {};

constexpr glm::vec4 black(0, 0, 0, 1), white(1);

mesh::Mesh turned(mesh::Mesh mesh, const glm::dmat4& place) {
  const glm::mat4 m(place);
  for (glm::vec3& p : mesh.positions) p = glm::vec3(m * glm::vec4(p, 1));
  for (glm::vec3& n : mesh.normals) n = glm::normalize(glm::mat3(m) * n);
  return mesh;
}

mesh::Mesh together(mesh::Mesh mesh, const mesh::Mesh& more) {
  append(mesh, more, glm::vec3(0));
  return mesh;
}

glm::dmat4 about_y(double angle) { return glm::rotate(glm::dmat4(1), angle, glm::dvec3(0, 1, 0)); }

// Two squares that cross in the line x = `at`, z = 0: white comes towards the eye to the right.
mesh::Mesh crossing(double at, double angle_black, double angle_white) {
  const glm::dmat4 wide = moved(at, 0, 0) * glm::scale(glm::dmat4(1), glm::dvec3(2));
  return together(turned(square(black), wide * about_y(angle_black)),
                  turned(square(white), wide * about_y(angle_white)));
}

struct Row {
  double white_px = 0;
  int between = 0;
};

Row row_of(const Layer& layer, int y, int from, int to) {
  Row row;
  for (int x = from; x < to; ++x) {
    const Rgba pixel = at(layer, x, y);
    EXPECT_EQ(pixel[3], 255) << "the plate must not shine through";
    row.white_px += pixel[0] / 255.0;
    row.between += pixel[0] > 0 && pixel[0] < 255 ? 1 : 0;
  }
  return row;
}

TEST_F(Intersection, OfCrossingSquaresMixesTheColoursByTheirCoverage) {
  const View v = view(64, 64, 32);
  // Not 0.5, which puts the line through pixels' centres: those fall to one side or the other.
  for (double shift_px : {0.0, 0.2, 0.4, 0.55, 0.7, 0.9}) {
    // Alike and unlike slants; seen from the front and (two-sided as they are) from behind.
    for (const auto& [angle_black, angle_white] : {std::pair(-0.7, 0.7), {0.0, 0.8}, {-1.1, 0.2}, {0.5, 1.0}}) {
      for (bool behind : {false, true}) {
        mesh::Mesh mesh = crossing(shift_px / 16, angle_black, angle_white);
        if (behind) {
          for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
          for (glm::vec3& n : mesh.normals) n = -n;
        }
        const Layer layer = drawn(scene_of(toon(mesh, moved(0, 0, 2))), v);
        const Row row = row_of(layer, 32, 26, 38);
        // From 25.5 to 37.5 px; the line is seen at 31.5 + shift. Where surfaces are drawn displaced, the depth test
        // picks another pixel than the true line would, and rounding to 1/256 pixel makes a few hundredths of
        // difference.
        EXPECT_NEAR(row.white_px, 6 - shift_px, 0.1)
            << angle_black << " " << angle_white << " " << behind << " " << shift_px;
        EXPECT_LE(row.between, 2);
      }
    }
  }
}

// The layer of an eight times finer picture, averaged.
double fine_level(const Layer& fine, int x, int y) {
  double sum = 0;
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) sum += at(fine, 8 * x + i, 8 * y + j)[0];
  }
  return sum / 64;
}

// The mean difference of a layer from a finer one, of the pixels that are neither black nor white there.
double error_of_mixed(const Layer& coarse, const Layer& fine) {
  int mixed = 0;
  double sum = 0;
  for (int y = coarse.rect.y_px; y < coarse.rect.bottom_px(); ++y) {
    for (int x = coarse.rect.x_px; x < coarse.rect.right_px(); ++x) {
      const double expected = fine_level(fine, x, y);
      if (at(coarse, x, y)[3] < 255 || expected < 5 || expected > 250) continue;
      ++mixed;
      sum += std::abs(at(coarse, x, y)[0] - expected) / 255;
    }
  }
  EXPECT_GT(mixed, 50);
  return sum / mixed;
}

// A small white ball halfway in a black one, its line of intersection a ring that is seen at all slants.
TEST_F(Intersection, OfBallsIsAsSmoothAsAFinerPicture) {
  const glm::dmat4 at_side = moved(0.3, -0.2, -0.8) * scaled(0.6) * glm::rotate(glm::dmat4(1), 0.5, {1, 2, 3});
  const mesh::Mesh ball = sphere(4, black), small = turned(sphere(4, white), at_side);
  const glm::dmat4 place = moved(0, 0, 4.5);
  const View v = view(96, 96, 150);
  const Layer fine = drawn(scene_of(toon(together(ball, small), place)), view(768, 768, 1200));
  const double smooth = error_of_mixed(drawn(scene_of(toon(together(ball, small), place)), v), fine);
  // Drawn as two objects, the balls know nothing of each other, and each pixel is of one or the other.
  const double jagged = error_of_mixed(drawn(scene_of(toon(ball, place), toon(small, place)), v), fine);
  EXPECT_GT(jagged, 0.15);
  // Coverage is that of a straight edge; where one ball's contour runs out into the ring there are two in a pixel.
  EXPECT_LT(smooth, 0.05);
}

TEST_F(Intersection, OnlyOfPiecesThatCutEachOther) {
  EXPECT_FALSE(passes::ObjectShape(sphere(3), glm::dmat4(1)).intersects_itself());
  EXPECT_FALSE(
      passes::ObjectShape(together(sphere(3), turned(sphere(3), scaled(0.5))), glm::dmat4(1)).intersects_itself());
  EXPECT_TRUE(
      passes::ObjectShape(together(sphere(3), turned(sphere(3), moved(1, 0, 0))), glm::dmat4(1)).intersects_itself());
}

// Of two balls side by side the ring is seen on edge: half of it lies on faces that turn away.
TEST_F(Intersection, IsListedWhereBothFacesAreSeen) {
  passes::ObjectShape shape(together(sphere(3), turned(sphere(3), moved(1, 0.1, 0.1))), moved(0, 0, 5));
  const View v = view(64, 64, 60);
  const std::size_t shown = shape.look(v, picture_of(v)).intersection_indices.size();
  const std::size_t all =
      mesh::intersections(mesh::topology(together(sphere(3), turned(sphere(3), moved(1, 0.1, 0.1))))).size();
  EXPECT_GT(shown / 12, all / 4);
  EXPECT_LT(shown / 12, all * 2 / 3) << "two quads a cut, six indices a quad";
}

// Levels of detail must not move the line in which surfaces meet: black and white stay where they are.
TEST_F(Intersection, StaysWhereItIsInLevelsOfDetail) {
  const mesh::Mesh mesh = together(sphere(5, black), turned(sphere(5, white), moved(0.4, -0.3, -0.6)));
  const glm::dmat4 place = moved(0, 0, 8);
  const View v = view(128, 128, 300);
  const std::vector<std::uint8_t> all(mesh.triangles.size(), 1);
  passes::ObjectShape whole(mesh, place, all), coarse(mesh, place);
  ASSERT_LT(coarse.look(v, picture_of(v)).front.size(), whole.look(v, picture_of(v)).front.size() / 2);
  const auto layer_of = [&](passes::ObjectShape shape) {
    passes::StyledObject styled;
    styled.object = std::make_unique<passes::DrawnObject>(std::move(shape));
    styled.passes.push_back(std::make_unique<passes::ToonPass>(*styled.object, mesh, unlit()));
    return drawn(scene_of(std::move(styled)), v);
  };
  const Layer expected = layer_of(std::move(whole)), is = layer_of(std::move(coarse));
  int different = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) different += std::abs(at(is, x, y)[0] - at(expected, x, y)[0]) > 8 ? 1 : 0;
  }
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace rinkaku::test

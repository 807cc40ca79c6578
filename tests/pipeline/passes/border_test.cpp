#include <cmath>

#include <gtest/gtest.h>

#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

class MaterialBorder : public GlTest {};

// A square of 2 m whose left part, up to x = `at`, is black and whose right part is white, welded along the border.
mesh::Mesh two_colours(float at) {
  mesh::Mesh mesh;
  add_face(mesh, {{-1, 1, 0}, {at, 1, 0}, {at, -1, 0}, {-1, -1, 0}}, {0, 1, 2, 3});
  add_face(mesh, {{at, 1, 0}, {1, 1, 0}, {1, -1, 0}, {at, -1, 0}}, {1, 4, 5, 2});
  mesh::Part left;
  left.triangle_count = 2;
  mesh::Part right = left;
  right.first_triangle = 2, right.material = 1;
  mesh.parts = {left, right};
  mesh.materials.resize(2);
  mesh.materials[0].base_colour = {0, 0, 0, 1};
  return mesh;
}

// Over a pixel the two parts cover as much as the border leaves them, wherever it lies between pixel centres.
TEST_F(MaterialBorder, MixesTheColoursByTheirCoverage) {
  const View v = view(64, 64, 32);
  for (double shift_px : {0.0, 0.2, 0.4, 0.5, 0.7, 0.9}) {
    const Layer layer = drawn(scene_of(toon(two_colours(static_cast<float>(shift_px / 16)), moved(0, 0, 2))), v);
    double sum_px = 0;
    for (int x = 24; x < 40; ++x) {
      const Rgba pixel = at(layer, x, 32);
      EXPECT_EQ(pixel[3], 255) << "the plate must not shine through";
      sum_px += pixel[0] / 255.0;
      // Pixel x reaches from x - 31.5 - 0.5 px to x - 31.5 + 0.5 px of the middle.
      const double white = std::clamp(x - 31.5 + 0.5 - shift_px, 0.0, 1.0);
      EXPECT_NEAR(pixel[0] / 255.0, white, 0.02) << "pixel " << x << " for a border at " << shift_px;
    }
    EXPECT_NEAR(sum_px, 8 - shift_px, 0.02);
  }
}

TEST_F(MaterialBorder, IsSmoothOnSlantedSurfacesToo) {
  const View v = view(64, 64, 32);
  const glm::dmat4 slanted = moved(0, 0, 2) * glm::rotate(glm::dmat4(1), 1.2, glm::dvec3(0, 1, 0));
  const Layer layer = drawn(scene_of(toon(two_colours(0.05f), slanted)), v);
  // On a slanted plane x = 0.05 m lies here.
  const double border_px = 31.5 + 32 * 0.05 * std::cos(1.2) / (2 - 0.05 * std::sin(1.2));
  double sum_px = 0;
  int between = 0;
  for (int x = 29; x < 39; ++x) {
    const Rgba pixel = at(layer, x, 32);
    EXPECT_EQ(pixel[3], 255);
    sum_px += pixel[0] / 255.0;
    between += pixel[0] > 0 && pixel[0] < 255 ? 1 : 0;
  }
  // Surfaces are drawn pulled in by half a pixel times their slant, and their borders with them.
  EXPECT_NEAR(sum_px, 38.5 - border_px, 0.5);
  EXPECT_GE(between, 1);
  EXPECT_LE(between, 2);
}

TEST_F(MaterialBorder, HasNoQuadsBetweenPartsThatLookAlike) {
  mesh::Mesh mesh = two_colours(0);
  EXPECT_FALSE(passes::ObjectShape(mesh, glm::dmat4(1)).border_vertices().empty());
  mesh.materials[0].base_colour = mesh.materials[1].base_colour;
  EXPECT_TRUE(passes::ObjectShape(mesh, glm::dmat4(1)).border_vertices().empty());
}

TEST_F(MaterialBorder, IsLeftOutWhereOnePartTurnsAway) {
  mesh::Mesh mesh = cube();
  mesh.parts[0].triangle_count = 2;
  mesh::Part rest = mesh.parts[0];
  rest.first_triangle = 2, rest.triangle_count = 10, rest.material = 1;
  mesh.parts.push_back(rest);
  mesh.materials.resize(2);
  mesh.materials[0].base_colour = {0, 0, 0, 1};
  const View v = view(64, 64, 60);
  passes::ObjectShape face_on(mesh, moved(0, 0, 5));
  ASSERT_EQ(face_on.border_vertices().size(), 4u * 2 * 4);  // four edges, two quads each
  EXPECT_TRUE(face_on.look(v, picture_of(v)).border_indices.empty()) << "its sides are hidden";
}

}  // namespace
}  // namespace rinkaku::test

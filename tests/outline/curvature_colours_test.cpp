#include "outline/curvature_colours.h"

#include <gtest/gtest.h>

#include "tests/outline/surfaces.h"

namespace rinkaku::test {
namespace {

using outline::curvature_colour;

TEST(CurvatureColours, ConvexIsRedFlatIsWhiteConcaveIsBlue) {
  const glm::vec4 hump = curvature_colour(1), flat = curvature_colour(0), hollow = curvature_colour(-1);
  EXPECT_GT(hump.r, hump.b + 0.5f);
  EXPECT_GT(hollow.b, hollow.r + 0.5f);
  for (int c = 0; c < 4; ++c) EXPECT_GT(flat[c], 0.95f);
  EXPECT_EQ(curvature_colour(7), hump);
  EXPECT_EQ(curvature_colour(-1e30f), hollow);
}

// More curvature is never paler: no false edges within a sign.
TEST(CurvatureColours, DeepenSteadily) {
  const auto brightness = [](float at) {
    const glm::vec4 c = curvature_colour(at);
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
  };
  for (float sign : {-1.0f, 1.0f}) {
    for (float at = 0; at < 0.995f; at += 0.01f) {
      EXPECT_LT(brightness(sign * (at + 0.01f)), brightness(sign * at)) << sign * at;
      EXPECT_GT(brightness(sign * (at + 0.01f)), brightness(sign * at) - 0.03f) << sign * at;  // without a jump
    }
  }
}

TEST(CurvatureColours, PaintTheWholeMeshAndDropItsOwnColours) {
  mesh::Mesh torus = Torus().mesh(48, 24);
  torus.materials[0].base_colour = {0, 1, 0, 0.5f};
  torus.materials[0].texture = 0;
  torus.materials[0].alpha = mesh::Material::Alpha::Blend;
  torus.textures.resize(1);
  const outline::Curvature curvature = outline::curvature(mesh::topology(torus));
  const mesh::Mesh painted = outline::painted_with_curvature(torus, curvature, outline::k95(curvature));
  EXPECT_TRUE(painted.textures.empty());
  EXPECT_EQ(painted.materials[0].texture, -1);
  EXPECT_EQ(painted.materials[0].base_colour, glm::vec4(1));
  EXPECT_EQ(painted.materials[0].alpha, mesh::Material::Alpha::Opaque);
  ASSERT_EQ(painted.colours.size(), painted.positions.size());
  for (std::size_t v = 0; v < painted.positions.size(); ++v) {
    const double mean = Torus().mean(glm::dvec3(painted.positions[v]));
    if (mean > 0.1) {
      EXPECT_GT(painted.colours[v].r, painted.colours[v].b);
    }
    if (mean < -0.1) {
      EXPECT_GT(painted.colours[v].b, painted.colours[v].r);
    }
  }
  // A flat surface has no K95.
  for (const glm::vec4& c : outline::painted_with_curvature(torus, curvature, 0).colours) {
    EXPECT_EQ(c, curvature_colour(0));
  }
}

}  // namespace
}  // namespace rinkaku::test

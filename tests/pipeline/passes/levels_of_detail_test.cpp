#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "pipeline/passes/toon/band_borders.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::ObjectShape;

class LevelsOfDetail : public GlTest {};

passes::ToonOptions three_bands() {
  passes::ToonOptions options;
  options.light = {0.5f, -0.6f, -0.7f};
  return options;
}

// A ball with dents and humps, so that it hides itself in places and its bands wind.
mesh::Mesh bumpy(int levels) {
  mesh::Mesh mesh = sphere(levels);
  for (glm::vec3& p : mesh.positions) p *= 1 + 0.15f * std::sin(5 * p.x) * std::sin(4 * p.y + 1) * std::sin(6 * p.z);
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 n =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    for (int k = 0; k < 3; ++k) mesh.normals[t[k]] += n;
  }
  for (glm::vec3& n : mesh.normals) n = glm::normalize(n);
  return mesh;
}

TEST_F(LevelsOfDetail, LookLikeTheWholeMeshBandsAndAll) {
  const mesh::Mesh mesh = bumpy(5);  // 20,480 triangles
  const passes::View v = view(240, 240, 300);
  const std::vector<std::uint8_t> all(mesh.triangles.size(), 1);
  for (double distance : {3.0, 5.0, 9.0}) {
    const glm::dmat4 place = moved(0, 0, distance);
    ObjectShape whole(mesh, place, all), coarse(mesh, place, passes::band_borders(mesh, place, three_bands()));
    const std::size_t whole_indices = whole.look(v, picture_of(v)).front.size();
    const std::size_t coarse_indices = coarse.look(v, picture_of(v)).front.size();
    EXPECT_LT(coarse_indices, whole_indices * 0.7) << "at " << distance;

    auto layer_of = [&](ObjectShape shape) {
      passes::StyledObject styled;
      styled.object = std::make_unique<passes::DrawnObject>(std::move(shape));
      styled.passes.push_back(std::make_unique<passes::ToonPass>(*styled.object, mesh, three_bands()));
      return drawn(scene_of(std::move(styled)), v);
    };
    const passes::Layer exact = layer_of(std::move(whole)), drawn_coarse = layer_of(std::move(coarse));
    ASSERT_EQ(exact.rect, drawn_coarse.rect);
    int covered = 0, wrong = 0;
    for (std::size_t i = 0; i < exact.rgba.size(); i += 4) {
      covered += exact.rgba[i + 3] != 0 ? 1 : 0;
      int most = 0;
      for (std::size_t c = i; c < i + 4; ++c) most = std::max(most, std::abs(exact.rgba[c] - drawn_coarse.rgba[c]));
      wrong += most > 24 ? 1 : 0;  // half a band's difference
    }
    // Bands and contour are the whole mesh's. What is left are pixels where one part of the ball hides another, which a
    // level moves by up to a pixel, and single pixels where a border's smoothing reaches into a simplified triangle.
    EXPECT_LT(wrong, covered * 0.003) << "at " << distance << " of " << covered;
  }
}

TEST_F(LevelsOfDetail, TheWholeMeshIsDrawnFromNearby) {
  const mesh::Mesh mesh = bumpy(4);
  const passes::View v = view(64, 64, 4000);
  ObjectShape shape(mesh, moved(0, 0, 3), passes::band_borders(mesh, moved(0, 0, 3), three_bands()));
  const passes::Look& look = shape.look(v, picture_of(v));
  EXPECT_EQ(look.overlap_px, 0);
  EXPECT_GT(look.front.size() / 3, mesh.triangles.size() / 3);
}

// The ball's brightness at a point is (cos + 1) / 2 of the angle to the light, so the borders of three bands are the
// circles at which the cosine is -1/3 and 1/3.
TEST(BandBorders, AreTheTrianglesOnTheCirclesOfEqualBrightness) {
  const mesh::Mesh ball = sphere(4);
  const glm::vec3 light = glm::normalize(three_bands().light);
  const std::vector<std::uint8_t> found = passes::band_borders(ball, glm::dmat4(1), three_bands());
  ASSERT_EQ(found.size(), ball.triangles.size());
  std::size_t count = 0;
  for (std::size_t f = 0; f < found.size(); ++f) {
    float low = 2, high = -2;
    for (int k = 0; k < 3; ++k) {
      const float cosine = glm::dot(ball.positions[ball.triangles[f][k]], light);
      low = std::min(low, cosine), high = std::max(high, cosine);
    }
    const auto crossed = [&](float border) { return low < border && border < high; };
    if (crossed(-1.0f / 3) || crossed(1.0f / 3)) {
      EXPECT_EQ(found[f], 1) << "triangle " << f;
    }
    count += found[f];
  }
  EXPECT_LT(count, found.size() / 8) << "and few others";
}

TEST(BandBorders, UnlitObjectsHaveNone) {
  EXPECT_TRUE(passes::band_borders(sphere(1), glm::dmat4(1), unlit()).empty());
}

}  // namespace
}  // namespace rinkaku::test

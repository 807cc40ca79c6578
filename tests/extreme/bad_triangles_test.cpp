// Triangles that no modeller means to make. What they add to a sound mesh must not show, and what they are by
// themselves must be drawn as far as it can be seen.
#include <numbers>

#include "mesh/assemble.h"
#include "tests/outline/lined.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::test {
namespace {

using passes::Layer;

class BadTriangles : public GlTest {
 protected:
  static mesh::Soup soup_of(const mesh::Mesh& mesh) {
    mesh::Soup soup;
    soup.positions = mesh.positions;
    soup.triangles = mesh.triangles;
    soup.parts = mesh.parts;
    soup.materials = mesh.materials;
    return soup;
  }
  static mesh::Mesh assembled(mesh::Soup soup) {
    soup.parts.back().triangle_count =
        static_cast<std::uint32_t>(soup.triangles.size()) - soup.parts.back().first_triangle;
    return mesh::assemble(std::move(soup), 60).mesh;
  }
  static Layer seen(const mesh::Mesh& mesh) {
    return drawn(scene_of(lined(mesh, moved(0, 0, 4) * glm::rotate(glm::dmat4(1), 0.6, {1, 1, 0}), 3)),
                 passes::View(view(320, 240, 300)));
  }
};

TEST_F(BadTriangles, WithoutAreaTheyLeaveNoTrace) {
  const mesh::Soup sound = soup_of(sphere(4));
  const Layer expected = seen(assembled(sound));
  mesh::Soup soup = sound;
  soup.triangles.emplace_back(3, 3, 3);  // a point
  soup.triangles.emplace_back(5, 9, 5);  // an edge and back
  soup.triangles.emplace_back(20, 20, 7);
  const Layer layer = seen(assembled(soup));
  EXPECT_NEAR(area_px(layer), area_px(expected), 0.5);
}

TEST_F(BadTriangles, GivenTwiceTheyLeaveNoTrace) {
  const mesh::Soup sound = soup_of(sphere(4));
  const Layer expected = seen(assembled(sound));
  mesh::Soup soup = sound;
  for (std::size_t i = 0; i < 200; ++i) soup.triangles.push_back(soup.triangles[i * 3]);
  EXPECT_NEAR(area_px(seen(assembled(soup))) / area_px(expected), 1, 0.002);
}

TEST_F(BadTriangles, PointsOfNoTriangleLeaveNoTrace) {
  const mesh::Soup sound = soup_of(sphere(4));
  const Layer expected = seen(assembled(sound));
  mesh::Soup soup = sound;
  for (int i = 0; i < 50; ++i) soup.positions.emplace_back(0.01f * static_cast<float>(i), 0.5f, -0.2f);
  EXPECT_NEAR(area_px(seen(assembled(soup))), area_px(expected), 0.5);
}

// A disc cut into slivers: fan triangles of 179.9 degrees at their middle, from a strip of points on its border.
TEST_F(BadTriangles, SliversOfNearly180DegreesFillTheirShape) {
  mesh::Soup soup;
  constexpr int steps = 400;
  // Two rows of points, a hair apart, and triangles between them with two corners in one row.
  for (int i = 0; i <= steps; ++i) {
    const float x = -1 + 2.0f * static_cast<float>(i) / steps;
    soup.positions.emplace_back(x, -1, 0);
    soup.positions.emplace_back(x, -1 + 5e-6f, 0);
    soup.positions.emplace_back(x, 1, 0);
  }
  for (std::uint32_t i = 0; i < steps; ++i) {
    const std::uint32_t a = 3 * i, b = 3 * (i + 1);
    for (const glm::uvec3& t : {glm::uvec3(a, b, b + 1), glm::uvec3(a, b + 1, a + 1), glm::uvec3(a + 1, b + 1, b + 2),
                                glm::uvec3(a + 1, b + 2, a + 2)}) {
      soup.triangles.push_back(t);
    }
  }
  soup.parts.emplace_back();
  soup.materials.emplace_back();
  soup.materials[0].two_sided = true;
  const mesh::Mesh mesh = assembled(soup);
  const Layer layer = drawn(scene_of(toon(mesh, moved(0, 0, 4))), view(320, 240, 300));
  EXPECT_NEAR(area_px(layer) / (150 * 150), 1, 0.01);
}

TEST_F(BadTriangles, ThousandAroundOnePoint) {
  mesh::Soup soup;
  soup.positions.emplace_back(0, 0, -1.0f);
  constexpr std::uint32_t around = 1000;
  for (std::uint32_t i = 0; i < around; ++i) {
    const double a = 2 * std::numbers::pi * i / around;
    soup.positions.emplace_back(std::cos(a), std::sin(a), 0.5f);
  }
  soup.positions.emplace_back(0, 0, 0.5f);
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t a = 1 + i, b = 1 + (i + 1) % around;
    soup.triangles.emplace_back(0, b, a);
    soup.triangles.emplace_back(around + 1, a, b);
  }
  soup.parts.emplace_back();
  soup.materials.emplace_back();
  const mesh::Mesh cone = assembled(soup);
  // Seen along its axis: a disc whose rim lies at 4.5 m.
  const double radius_px = 300 / 4.5;
  const Layer bare = drawn(scene_of(toon(cone, moved(0, 0, 4))), view(320, 240, 300));
  EXPECT_NEAR(area_px(bare) / (std::numbers::pi * radius_px * radius_px), 1, 0.01);
  const Layer with_line = drawn(scene_of(lined(cone, moved(0, 0, 4), 3)), view(320, 240, 300));
  EXPECT_NEAR(area_px(with_line) / (std::numbers::pi * (radius_px + 3) * (radius_px + 3)), 1, 0.02);
}

// Three wings on one spine: every edge of the spine has three triangles.
TEST_F(BadTriangles, ThreeOnAnEdgeAreAllDrawn) {
  mesh::Soup soup;
  soup.positions = {{0, -1, 0}, {0, 1, 0}};
  for (const double turn : {0.3, 2.4, 4.5}) {
    const auto base = static_cast<std::uint32_t>(soup.positions.size());
    const float x = static_cast<float>(std::cos(turn)), z = static_cast<float>(std::sin(turn));
    soup.positions.insert(soup.positions.end(), {{x, -1, z}, {x, 1, z}});
    soup.triangles.insert(soup.triangles.end(), {{0, base, base + 1}, {0, base + 1, 1}});
  }
  soup.parts.emplace_back();
  soup.materials.emplace_back();
  soup.materials[0].two_sided = true;
  const Layer layer = drawn(scene_of(toon(assembled(soup), moved(0, 0, 4))), view(320, 240, 300));
  // Each wing is a rectangle upright in space: the union of their outlines, by the corners' perspective.
  double expected = 0;
  for (const double turn : {0.3, 2.4, 4.5}) {
    const double z = 4 + std::sin(turn), x = 300 * std::cos(turn) / z;
    expected += std::abs(x) * 300 * (1 / z + 1 / 4.0);  // a trapezium between the spine and the wing's far edge
  }
  // The first wing is alone to the right; the other two lie to the left, one before the other.
  const double second = std::abs(300 * std::cos(2.4) / (4 + std::sin(2.4))) * 300 * (1 / (4 + std::sin(2.4)) + 0.25);
  const double third = std::abs(300 * std::cos(4.5) / (4 + std::sin(4.5))) * 300 * (1 / (4 + std::sin(4.5)) + 0.25);
  const double first = expected - second - third;
  EXPECT_GE(area_px(layer), (first + std::max(second, third)) * 0.985);
  EXPECT_LE(area_px(layer), expected * 1.015);
}

// A Moebius strip has no outer side: it is drawn whole from wherever it is seen.
TEST_F(BadTriangles, MoebiusStripHasNoHole) {
  mesh::Soup soup;
  constexpr std::uint32_t steps = 200;
  for (std::uint32_t i = 0; i < steps; ++i) {
    const double a = 2 * std::numbers::pi * i / steps;
    for (const double w : {-0.3, 0.3}) {
      const double r = 1 + w * std::cos(a / 2);
      soup.positions.emplace_back(r * std::cos(a), r * std::sin(a), w * std::sin(a / 2));
    }
  }
  for (std::uint32_t i = 0; i < steps; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % steps);
    const bool last = i + 1 == steps;  // the strip closes upside down
    soup.triangles.emplace_back(a, last ? b + 1 : b, last ? b : b + 1);
    soup.triangles.emplace_back(a, last ? b : b + 1, a + 1);
  }
  soup.parts.emplace_back();
  soup.materials.emplace_back();
  const mesh::Mesh strip = assembled(soup);
  const passes::View v = view(320, 240, 300);
  const Layer layer = drawn(scene_of(toon(strip, moved(0, 0, 4))), v);
  // The middle of the strip's band is covered all the way round, wherever it is wider than three pixels.
  int open = 0;
  for (std::uint32_t i = 0; i < steps; ++i) {
    const double a = 2 * std::numbers::pi * i / steps;
    if (std::abs(std::cos(a / 2)) < 0.2) continue;
    const int x = static_cast<int>(std::lround(300 * std::cos(a) / 4 + v.camera.cx_px));
    const int y = static_cast<int>(std::lround(300 * std::sin(a) / 4 + v.camera.cy_px));
    open += at(layer, x, y)[3] < 250;
  }
  EXPECT_EQ(open, 0);
}

}  // namespace
}  // namespace rinkaku::test

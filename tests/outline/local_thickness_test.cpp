#include "outline/local_thickness.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/outline/surfaces.h"

namespace rinkaku::test {
namespace {

using outline::local_thickness;

constexpr double turn = 2 * std::numbers::pi;
const double cos20 = std::cos(turn / 18);

// A surface of revolution about z, closed by a point at each end: radius and height at v from 0 to 1.
mesh::Topology turned(int around, int along, const std::function<glm::dvec2(double)>& profile) {
  return grid_surface({around, along, true, false}, [&](double u, double v) {
    const glm::dvec2 at(v == 0 || v == 1 ? 0.0 : profile(v).x, profile(v).y);  // one point, not a ring of nearly one
    return glm::dvec3(at.x * std::cos(turn * u), at.x * std::sin(turn * u), at.y);
  });
}

mesh::Topology ball(double radius) {
  return turned(64, 32, [radius](double v) {
    return glm::dvec2(radius * std::sin(turn / 2 * v), -radius * std::cos(turn / 2 * v));
  });
}

// A slab 2 x 2 x thickness: its two sides, joined round the rim.
mesh::Topology plate(double thickness) {
  return grid_surface({60, 32, true, false}, [thickness](double u, double v) {
    // From the middle of the lower side out to the rim, up, and back to the middle of the upper side.
    const double out = v < 0.5 ? v * 2 : (1 - v) * 2, side = v < 0.5 ? -1 : 1;
    const double angle = turn * u;
    const double square = 1 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    const double radius = std::min(out * 16 / 15, 1.0) * square;
    return glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), side * thickness / 2);
  });
}

TEST(LocalThickness, IsThatOfAPlate) {
  for (const double thickness : {0.01, 0.1}) {
    const mesh::Topology surface = plate(thickness);
    const std::vector<float> found = local_thickness(surface);
    int looked = 0;
    for (std::size_t p = 0; p < found.size(); ++p) {
      const glm::vec3& at = surface.points[p];
      // Farther from the rim than smoothing reaches.
      if (std::max(std::abs(at.x), std::abs(at.y)) > 0.4) continue;
      // Six of seven rays lean by 20 degrees; float rounding.
      EXPECT_NEAR(found[p], thickness / cos20, 1e-3 * thickness);
      ++looked;
    }
    EXPECT_GT(looked, 300);
  }
}

TEST(LocalThickness, IsThatOfABallAtAnySize) {
  for (const double radius : {1e-6, 1.0, 1e6}) {
    for (const float found : local_thickness(ball(radius))) {
      // Normals lean by up to 3 degrees, half a triangle: cos 23 is 0.02 less; and the polyhedron's sides are flat.
      EXPECT_NEAR(found / (2 * radius), cos20, 0.03);
    }
  }
}

// Where only some points have rays, the others have what is beside them.
TEST(LocalThickness, OfAFineMeshIsThatOfACoarseOne) {
  const mesh::Topology fine =
      turned(160, 80, [](double v) { return glm::dvec2(std::sin(turn / 2 * v), -std::cos(turn / 2 * v)); });
  ASSERT_GT(fine.points.size(), 12000u);
  // As above; triangles are less than half as large.
  for (const float found : local_thickness(fine)) EXPECT_NEAR(found / 2, cos20, 0.02);
}

// Rays across the axis take D cos 20°, along it D / cos 20°.
TEST(LocalThickness, IsThatOfARod) {
  const double diameter = 0.1;
  const mesh::Topology rod = turned(24, 60, [&](double v) { return glm::dvec2(diameter / 2, v); });
  const std::vector<float> found = local_thickness(rod);
  for (std::size_t p = 0; p < found.size(); ++p) {
    if (std::abs(rod.points[p].z - 0.5) > 0.3) continue;
    EXPECT_GT(found[p], diameter * cos20 * 0.99);  // 1 - cos(7.5 degrees): the polygon's flat sides
    EXPECT_LT(found[p], diameter / cos20 * 1.001);
  }
}

// At the way s from a cone's tip, along its side, the ray against the normal takes s tan(2 a); a = 10 degrees.
TEST(LocalThickness, GoesToNothingAtAConesTip) {
  const double a = turn / 36;
  const mesh::Topology cone = turned(48, 101, [&](double v) {
    const double way = std::min(1.0, (1 - v) * 101 / 100);  // the first ring closes the base
    return v == 0 ? glm::dvec2(0, -1) : glm::dvec2(way * std::tan(a), -way);
  });
  const std::vector<float> found = local_thickness(cone);
  for (std::size_t p = 0; p < found.size(); ++p) {
    const double depth = -cone.points[p].z;
    if (depth > 0.6) continue;  // leaning rays meet the base
    const double way = depth / std::cos(a);
    // Leaning towards the tip a ray is shorter by 5 %, away from it longer by a fifth; the middle of seven is within a
    // tenth. At the tip itself, averaging eight times takes in some three rings of a hundredth each.
    EXPECT_NEAR(found[p], way * std::tan(2 * a), 0.1 * way * std::tan(2 * a) + 0.03 * std::tan(2 * a)) << depth;
  }
}

// A finely cut box is about as thick at its edges as elsewhere: the largest ball that touches there would be none.
TEST(LocalThickness, DoesNotVanishAlongHardEdges) {
  const mesh::Topology box = plate(1);
  const std::vector<float> found = local_thickness(box);
  int looked = 0;
  for (std::size_t p = 0; p < found.size(); ++p) {
    const glm::vec3 at = glm::abs(box.points[p]);
    if (std::max(at.x, at.y) < 0.999f) continue;
    EXPECT_GT(found[p], 0.9) << at.x << ' ' << at.y << ' ' << at.z;
    ++looked;
  }
  EXPECT_GT(looked, 50);
}

TEST(LocalThickness, OfAnOpenSheetIsItsDiagonal) {
  const mesh::Topology sheet = grid_surface({8, 8}, [](double u, double v) { return glm::dvec3(3 * u, 4 * v, 0); });
  for (const float found : local_thickness(sheet)) EXPECT_FLOAT_EQ(found, 5);
}

TEST(LocalThickness, OfEmptyAndBadSurfacesIsFinite) {
  EXPECT_TRUE(local_thickness(mesh::Topology{}).empty());
  mesh::Topology needle = mesh::topology(double_cone(3));
  needle.points[0] = needle.points[1] = needle.points[2];  // faces without area
  for (const float found : local_thickness(needle)) EXPECT_TRUE(std::isfinite(found) && found >= 0);
}

}  // namespace
}  // namespace rinkaku::test

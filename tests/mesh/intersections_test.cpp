#include "mesh/intersections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>

#include "mesh/assemble.h"
#include "tests/mesh/shapes.h"

namespace rinkaku::mesh {
namespace {

using test::cube;
using test::sphere;
using test::square;

Soup placed(Soup soup, const glm::mat4& place) {
  for (glm::vec3& p : soup.positions) p = glm::vec3(place * glm::vec4(p, 1));
  return soup;
}

glm::mat4 moved(float x, float y, float z) { return glm::translate(glm::mat4(1), glm::vec3(x, y, z)); }

Topology topology_of(const std::vector<Soup>& soups) {
  Soup all;
  for (const Soup& soup : soups) {
    const auto base = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), soup.positions.begin(), soup.positions.end());
    for (const glm::uvec3& t : soup.triangles) all.triangles.push_back(t + base);
  }
  return topology(assemble(test::one_part(std::move(all)), 60).mesh);
}

double length(const std::vector<Cut>& cuts) {
  double sum = 0;
  for (const Cut& cut : cuts) sum += glm::distance(cut.ends[0], cut.ends[1]);
  return sum;
}

glm::dvec3 at(const Topology& topology, std::uint32_t face, const glm::dvec3& weights) {
  glm::dvec3 sum(0);
  for (int k = 0; k < 3; ++k) sum += weights[k] * glm::dvec3(topology.points[topology.faces[face][k]]);
  return sum;
}

// Both faces' weights must give the ends, and lie in the faces. Rounding in double only: coordinates are about 1.
void expect_weights_to_fit(const Topology& topology, const std::vector<Cut>& cuts) {
  for (const Cut& cut : cuts) {
    EXPECT_NE(topology.component[cut.faces[0]], topology.component[cut.faces[1]]);
    for (int side : {0, 1}) {
      for (int end : {0, 1}) {
        const glm::dvec3 weights = cut.weights[side][end];
        EXPECT_LT(glm::distance(at(topology, cut.faces[side], weights), cut.ends[end]), 1e-9);
        EXPECT_NEAR(weights.x + weights.y + weights.z, 1, 1e-12);
        EXPECT_GE(std::min({weights.x, weights.y, weights.z}), 0);
      }
    }
  }
}

// How deep inside the unit ball its facets lie at most: at the foot of its middle.
double deepest_facet(const Soup& ball) {
  double least = 1;
  for (const glm::uvec3& t : ball.triangles) {
    const glm::dvec3 a = ball.positions[t.x], b = ball.positions[t.y], c = ball.positions[t.z];
    least = std::min(least, glm::dot(glm::normalize(glm::cross(b - a, c - a)), a));
  }
  return 1 - least;
}

// Two balls whose middles lie 1.2 apart meet in a circle of radius 0.8. With facets, the distances a and b of a point
// of both surfaces from the middles are between 1 - depth and 1; so x = (a^2 - b^2) / 2.4, and the radius squared is
// (a^2 + b^2) / 2 - x^2 - 0.36.
TEST(Intersections, TwoBallsMeetInTheirCircle) {
  const Soup ball = sphere(4);
  const glm::mat4 turned = glm::rotate(moved(0.6f, 0, 0), 0.7f, glm::vec3(0.3f, 0.5f, 0.8f));
  const Topology t = topology_of({placed(ball, moved(-0.6f, 0, 0)), placed(ball, turned)});
  const std::vector<Cut> cuts = intersections(t);
  expect_weights_to_fit(t, cuts);
  const double depth = deepest_facet(ball), most_x = depth / 1.2 + 1e-6;
  double turned_by = 0;
  std::vector<glm::dvec3> ends;
  for (const Cut& cut : cuts) {
    for (const glm::dvec3& p : cut.ends) {
      const double radius = std::hypot(p.y, p.z);
      EXPECT_LE(std::abs(p.x), most_x);
      EXPECT_LE(radius, 0.8 + 1e-6) << "floats";
      EXPECT_GE(radius, std::sqrt((1 - depth) * (1 - depth) - most_x * most_x - 0.36));
      ends.push_back(p);
    }
    const auto angle = [](const glm::dvec3& p) { return std::atan2(p.z, p.y); };
    turned_by += std::abs(std::remainder(angle(cut.ends[1]) - angle(cut.ends[0]), glm::two_pi<double>()));
  }
  EXPECT_NEAR(turned_by, glm::two_pi<double>(), 1e-9) << "once round";
  // The chain is closed: every end is that of two segments, to the last bit.
  for (const glm::dvec3& p : ends) EXPECT_EQ(std::count(ends.begin(), ends.end(), p), 2);
}

// As they are mirror images, their edges and corners meet each other.
TEST(Intersections, MirroredBallsMeetInTheirCircleToo) {
  const Soup ball = sphere(4);
  const Topology t = topology_of({placed(ball, moved(-0.6f, 0, 0)), placed(ball, moved(0.6f, 0, 0))});
  const std::vector<Cut> cuts = intersections(t);
  expect_weights_to_fit(t, cuts);
  for (const Cut& cut : cuts) {
    for (const glm::dvec3& p : cut.ends) EXPECT_NEAR(p.x, 0, 1e-6) << "corners are rounded to float";
  }
  // Between the circles on which facets lie deepest and not at all.
  const double depth = deepest_facet(ball);
  EXPECT_LT(length(cuts), glm::two_pi<double>() * 0.8);
  EXPECT_GT(length(cuts), glm::two_pi<double>() * std::sqrt((1 - depth) * (1 - depth) - 0.36));
}

TEST(Intersections, ACubeCutsASquareAlongItsSides) {
  const Topology t = topology_of(
      {cube(), placed(square(), glm::scale(moved(-2, -2, 0.3f), glm::vec3(4)))});  // from -2 to 2 in z = 0.3
  const std::vector<Cut> cuts = intersections(t);
  expect_weights_to_fit(t, cuts);
  EXPECT_NEAR(length(cuts), 8, 1e-6);
  for (const Cut& cut : cuts) {
    for (const glm::dvec3& p : cut.ends) {
      EXPECT_NEAR(p.z, 0.3, 1e-7);
      EXPECT_NEAR(std::max(std::abs(p.x), std::abs(p.y)), 1, 1e-7);
    }
  }
}

TEST(Intersections, OnePieceHasNone) { EXPECT_TRUE(intersections(topology_of({sphere(3)})).empty()); }

TEST(Intersections, PiecesThatOnlyTouchHaveNone) {
  EXPECT_TRUE(intersections(topology_of({cube(), placed(cube(), moved(2, 0.5f, 0.25f))})).empty()) << "side by side";
  EXPECT_TRUE(intersections(topology_of({cube(), placed(cube(), moved(2.5f, 0, 0))})).empty()) << "apart";
  const glm::mat4 inside = glm::scale(glm::mat4(1), glm::vec3(0.5f));
  EXPECT_TRUE(intersections(topology_of({cube(), placed(cube(), inside)})).empty()) << "one inside the other";
}

TEST(Intersections, FacesWithoutAreaCutNothing) {
  Soup needle;
  needle.positions = {{0, 0, 0}, {1, 1, 2}, {2, 2, 4}};
  needle.triangles = {{0, 1, 2}};
  EXPECT_TRUE(intersections(topology_of({cube(), needle})).empty());
}

// Whether an edge of one triangle goes through the other: by the signs of the volumes that it spans with its sides.
bool pierces(const std::array<glm::dvec3, 3>& edges_of, const std::array<glm::dvec3, 3>& face) {
  const auto volume = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
  };
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 &p = edges_of[k], &q = edges_of[(k + 1) % 3];
    if (volume(face[0], face[1], face[2], p) * volume(face[0], face[1], face[2], q) >= 0) continue;
    const double u = volume(p, q, face[0], face[1]), v = volume(p, q, face[1], face[2]),
                 w = volume(p, q, face[2], face[0]);
    if ((u > 0) == (v > 0) && (v > 0) == (w > 0)) return true;
  }
  return false;
}

TEST(Intersections, FindsEveryPairThatTryingAllPairsFinds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0, 1), reach(-0.15f, 0.15f);
  std::vector<Soup> soups(400);
  for (Soup& soup : soups) {
    const glm::vec3 middle(place(random), place(random), place(random));
    for (int k = 0; k < 3; ++k) {
      soup.positions.push_back(middle + glm::vec3(reach(random), reach(random), reach(random)));
    }
    soup.triangles = {{0, 1, 2}};
  }
  const Topology t = topology_of(soups);
  ASSERT_EQ(t.component_count, soups.size());
  std::vector<std::array<std::uint32_t, 2>> expected, found;
  const auto corners = [&t](std::uint32_t f) {
    return std::array<glm::dvec3, 3>{t.points[t.faces[f].x], t.points[t.faces[f].y], t.points[t.faces[f].z]};
  };
  for (std::uint32_t f = 0; f < t.faces.size(); ++f) {
    for (std::uint32_t g = f + 1; g < t.faces.size(); ++g) {
      if (pierces(corners(f), corners(g)) || pierces(corners(g), corners(f))) expected.push_back({f, g});
    }
  }
  const std::vector<Cut> cuts = intersections(t);
  expect_weights_to_fit(t, cuts);
  for (const Cut& cut : cuts) {
    const auto [less, more] = std::minmax(cut.faces[0], cut.faces[1]);
    found.push_back({less, more});
  }
  std::sort(found.begin(), found.end());
  EXPECT_GT(expected.size(), 100u);
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace rinkaku::mesh

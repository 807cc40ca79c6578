#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include "mesh/import.h"
#include "silhouette/surface.h"
#include "silhouette/view_regions.h"
#include "tests/mesh/shapes.h"
#include "tests/support/test_data.h"

namespace rinkaku::test {

inline silhouette::Surface surface_of(const mesh::Mesh& mesh) {
  return silhouette::make_surface(mesh, mesh::topology(mesh));
}
inline silhouette::Surface surface_of(Soup soup) { return surface_of(mesh::assemble(std::move(soup), 60).mesh); }
inline silhouette::Surface surface_from(const std::string& file) { return surface_of(mesh::import(data(file)).mesh); }

/// A sphere with waves on it: concave places, several layers over each other at grazing angles.
inline Soup wavy_sphere(int levels) {
  Soup soup = sphere(levels);
  for (glm::vec3& p : soup.positions) p *= 1 + 0.12f * std::sin(7 * p.x) * std::sin(6 * p.y + 1) * std::sin(8 * p.z);
  return soup;
}

/// Only the triangles on one side of a plane: open.
inline Soup cut_open(Soup soup, const glm::vec3& normal, float offset) {
  std::erase_if(soup.triangles, [&](const glm::uvec3& t) { return glm::dot(normal, soup.positions[t.x]) > offset; });
  return one_part(std::move(soup));
}

/// Moebius strip: one-sided, with a border.
inline Soup moebius(std::uint32_t around, std::uint32_t across) {
  Soup soup;
  for (std::uint32_t i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * i / around;
    for (std::uint32_t j = 0; j <= across; ++j) {
      const double w = 0.8 * (double(j) / across - 0.5);
      const double r = 1 + w * std::cos(angle / 2);
      soup.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), w * std::sin(angle / 2));
    }
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t a = i * (across + 1) + j;
      const bool last = i + 1 == around;  // there, the strip meets itself upside down
      const std::uint32_t b = last ? across - j : a + across + 1;
      const std::uint32_t c = last ? across - j - 1 : b + 1;
      soup.triangles.emplace_back(a, b, c);
      soup.triangles.emplace_back(a, c, a + 1);
    }
  }
  return one_part(std::move(soup));
}

/// Turns every `nth` triangle round.
inline Soup shuffled_winding(Soup soup, std::size_t nth) {
  for (std::size_t t = 0; t < soup.triangles.size(); t += nth) std::swap(soup.triangles[t].y, soup.triangles[t].z);
  return soup;
}

/// An eye somewhere in the hull, in the unit frame: finite even where the hull reaches to infinity.
inline glm::dvec3 eye_in(const silhouette::ViewRegion& region, std::mt19937& random) {
  std::exponential_distribution<double> weight(1);
  glm::dvec4 sum(0);
  for (const glm::dvec4& h : region.hull) sum += h * weight(random) * (h.w > 0 ? 1.0 : 4.0);
  return glm::dvec3(sum) / sum.w;
}

}  // namespace rinkaku::test

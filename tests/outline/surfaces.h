#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include <glm/vec2.hpp>

#include "mesh/assemble.h"
#include "mesh/topology.h"

// Surfaces whose curvature is known.
namespace rinkaku::test {

struct Grid {
  int columns = 0, rows = 0;  // cells
  bool wraps_columns = false, wraps_rows = false;
};

/// Two triangles a cell; `at` maps the unit square to space. Seen from outside, columns run anticlockwise into rows.
inline mesh::Mesh grid_mesh(const Grid& grid, const std::function<glm::dvec3(double, double)>& at) {
  mesh::Soup soup;
  const int across = grid.wraps_columns ? grid.columns : grid.columns + 1;
  const int along = grid.wraps_rows ? grid.rows : grid.rows + 1;
  for (int row = 0; row < along; ++row) {
    for (int column = 0; column < across; ++column) {
      soup.positions.emplace_back(at(static_cast<double>(column) / grid.columns, static_cast<double>(row) / grid.rows));
    }
  }
  const auto number = [&](int column, int row) {
    return static_cast<std::uint32_t>((row % along) * across + column % across);
  };
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::uint32_t a = number(column, row), b = number(column + 1, row), c = number(column + 1, row + 1),
                          d = number(column, row + 1);
      soup.triangles.insert(soup.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  }
  mesh::Part part;
  part.triangle_count = static_cast<std::uint32_t>(soup.triangles.size());
  soup.parts = {part};
  soup.materials.emplace_back();
  return mesh::assemble(std::move(soup), 180).mesh;
}

inline mesh::Topology grid_surface(const Grid& grid, const std::function<glm::dvec3(double, double)>& at) {
  return mesh::topology(grid_mesh(grid, at));
}

/// A torus about z as the analytic test meshes are.
struct Torus {
  double outer = 1, inner = 0.7;

  double cosine(const glm::dvec3& p) const { return (std::hypot(p.x, p.y) - outer) / inner; }
  double smallest(const glm::dvec3& p) const { return cosine(p) / (outer + inner * cosine(p)); }
  double largest(const glm::dvec3&) const { return 1 / inner; }
  double mean(const glm::dvec3& p) const { return (largest(p) + smallest(p)) / 2; }
  double gauss(const glm::dvec3& p) const { return largest(p) * smallest(p); }

  mesh::Mesh mesh(int around, int across) const {
    constexpr double turn = 2 * std::numbers::pi;
    return grid_mesh({around, across, true, true}, [this](double u, double v) {
      const double radius = outer + inner * std::cos(turn * v);
      return glm::dvec3(radius * std::cos(turn * u), radius * std::sin(turn * u), inner * std::sin(turn * v));
    });
  }
};

/// An open cylinder of radius 2 and height 3 about z.
inline mesh::Topology cylinder(int around, int along) {
  return grid_surface({around, along, true, false}, [](double u, double v) {
    const double angle = 2 * std::numbers::pi * u;
    return glm::dvec3(2 * std::cos(angle), 2 * std::sin(angle), 3 * v);
  });
}

/// z = x y over the square from -1 to 1, seen from +z.
inline mesh::Topology saddle(int cells) {
  return grid_surface({cells, cells}, [](double u, double v) {
    const double x = 2 * u - 1, y = 2 * v - 1;
    return glm::dvec3(x, y, x * y);
  });
}

/// A closed double cone: a ring of `valence` points and two tips.
inline mesh::Mesh double_cone(int valence) {
  mesh::Soup soup;
  soup.positions = {{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < valence; ++i) {
    const double angle = 2 * std::numbers::pi * i / valence;
    soup.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  for (int i = 0; i < valence; ++i) {
    const auto a = static_cast<std::uint32_t>(2 + i), b = static_cast<std::uint32_t>(2 + (i + 1) % valence);
    soup.triangles.insert(soup.triangles.end(), {{0, a, b}, {1, b, a}});
  }
  mesh::Part part;
  part.triangle_count = static_cast<std::uint32_t>(soup.triangles.size());
  soup.parts = {part};
  soup.materials.emplace_back();
  return mesh::assemble(std::move(soup), 180).mesh;
}

}  // namespace rinkaku::test

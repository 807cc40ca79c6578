#include "report/sections/shapes.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>

#include <glm/geometric.hpp>

#include "mesh/assemble.h"

namespace rinkaku::report {
namespace {

mesh::Mesh assembled(mesh::Soup soup) {
  mesh::Part part;
  part.triangle_count = static_cast<std::uint32_t>(soup.triangles.size());
  soup.parts = {part};
  soup.materials.emplace_back();
  return mesh::assemble(std::move(soup), 60).mesh;
}

// The points of an octahedron's faces cut n times along each edge, as integers: those on common edges are the same.
mesh::Mesh octahedral(int n, const std::function<glm::dvec3(const glm::dvec3&)>& at) {
  mesh::Soup soup;
  for (int octant = 0; octant < 8; ++octant) {
    const glm::dvec3 sign((octant & 1) != 0 ? -1 : 1, (octant & 2) != 0 ? -1 : 1, (octant & 4) != 0 ? -1 : 1);
    const bool turned = sign.x * sign.y * sign.z < 0;
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n - i; ++j) {
        soup.positions.emplace_back(at(glm::normalize(sign * glm::dvec3(n - i - j, i, j))));
      }
    }
    // Rows of falling length.
    const auto number = [&](int i, int j) {
      return first + static_cast<std::uint32_t>(i * (n + 1) - i * (i - 1) / 2 + j);
    };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      soup.triangles.emplace_back(a, turned ? c : b, turned ? b : c);
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n - i; ++j) {
        add(number(i, j), number(i + 1, j), number(i, j + 1));
        if (j + 1 < n - i) add(number(i + 1, j), number(i + 1, j + 1), number(i, j + 1));
      }
    }
  }
  return assembled(std::move(soup));
}

}  // namespace

mesh::Mesh closed_grid(int around, int across, const std::function<glm::dvec3(double u, double v)>& at) {
  constexpr double turn = 2 * std::numbers::pi;
  const auto number = [across](int row, int column) { return static_cast<std::uint32_t>(row * across + column); };
  mesh::Soup soup;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      soup.positions.emplace_back(at(turn * i / around, turn * j / across));
      const int next_i = (i + 1) % around, next_j = (j + 1) % across;
      const std::uint32_t a = number(i, j), b = number(next_i, j), c = number(next_i, next_j), d = number(i, next_j);
      soup.triangles.insert(soup.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  }
  return assembled(std::move(soup));
}

mesh::Mesh Torus::mesh(int around, int across, double unrest, std::uint64_t seed) const {
  constexpr double turn = 2 * std::numbers::pi;
  std::mt19937_64 engine(seed);
  const auto off = [&engine, unrest] { return unrest * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1); };
  return closed_grid(around, across, [&](double even_u, double even_v) {
    const double u = even_u + turn * off() / around, v = even_v + turn * off() / across;
    const double radius = outer + inner * std::cos(v);
    return glm::dvec3(radius * std::cos(u), radius * std::sin(u), inner * std::sin(v));
  });
}

double Torus::mean_curvature(const glm::dvec3& p) const {
  const double cosine = (std::hypot(p.x, p.y) - outer) / inner;
  return (1 / inner + cosine / (outer + inner * cosine)) / 2;
}

double Torus::gauss_curvature(const glm::dvec3& p) const {
  const double cosine = (std::hypot(p.x, p.y) - outer) / inner;
  return cosine / (inner * (outer + inner * cosine));
}

mesh::Mesh Ellipsoid::mesh(int n) const {
  return octahedral(n, [this](const glm::dvec3& p) { return p * axes; });
}

double Ellipsoid::mean_curvature(const glm::dvec3& p) const {
  const glm::dvec3 squares = axes * axes, g = p / squares;
  const double h = glm::dot(g, g), product = squares.x * squares.y * squares.z;
  return (squares.x + squares.y + squares.z - glm::dot(p, p)) / (2 * product * h * std::sqrt(h));
}

double Ellipsoid::gauss_curvature(const glm::dvec3& p) const {
  const glm::dvec3 squares = axes * axes, g = p / squares;
  const double h = glm::dot(g, g);
  return 1 / (squares.x * squares.y * squares.z * h * h);
}

mesh::Mesh bumpy_ball(int n) {
  return octahedral(n, [](const glm::dvec3& p) {
    const double bumps = 0.09 * std::sin(5 * p.x + 1) * std::sin(6 * p.y) * std::cos(5 * p.z);
    const double dent = 0.35 * std::exp(-6 * glm::dot(p - glm::dvec3(0.6, 0.8, 0), p - glm::dvec3(0.6, 0.8, 0)));
    return p * (1 + bumps - dent);
  });
}

}  // namespace rinkaku::report

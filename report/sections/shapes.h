#pragma once

#include <cstdint>
#include <functional>

#include <glm/vec3.hpp>

#include "mesh/mesh.h"

namespace rinkaku::report {

/// Meshes made by formulas, so that nothing needs to be at hand and curvature is known.

/// A mesh closed both ways round, of `around` x `across` points, two triangles a cell: u runs around and v across, from
/// 0 to 2 pi.
mesh::Mesh closed_grid(int around, int across, const std::function<glm::dvec3(double u, double v)>& at);

/// A torus about z.
struct Torus {
  double outer = 1, inner = 0.7;
  /// Two triangles a cell; `unrest` moves points along the surface by up to so many cells, by `seed`.
  mesh::Mesh mesh(int around, int across, double unrest = 0, std::uint64_t seed = 1) const;
  double mean_curvature(const glm::dvec3& p) const;
  double gauss_curvature(const glm::dvec3& p) const;
};

struct Ellipsoid {
  glm::dvec3 axes{1.3, 1.0, 0.7};
  /// 8 n^2 triangles: an octahedron's faces cut up and pushed out.
  mesh::Mesh mesh(int n) const;
  double mean_curvature(const glm::dvec3& p) const;
  double gauss_curvature(const glm::dvec3& p) const;
};

/// A ball with bumps and a dent, of 8 n^2 triangles, in all about 1 in radius.
mesh::Mesh bumpy_ball(int n);

}  // namespace rinkaku::report

#include "outline/quadric_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::outline {
namespace {

// x, y, x^2, xy, y^2, x^3, x^2 y, x y^2, y^3
constexpr std::size_t kQuadricTerms = 5, kTerms = 9;
using Vector = std::array<double, kTerms>;

struct NormalEquations {
  std::array<Vector, kTerms> matrix{};  // the lower triangle
  Vector right{};

  void add(const Vector& terms, double height, double weight) {
    for (std::size_t r = 0; r < kTerms; ++r) {
      const double weighted = weight * terms[r];
      right[r] += weighted * height;
      for (std::size_t c = 0; c <= r; ++c) matrix[r][c] += weighted * terms[c];
    }
  }

  // Cholesky's factorisation of the first `count` equations, each unknown scaled by its own diagonal. False where they
  // don't determine the unknowns.
  bool solve(std::size_t count, Vector& solution) const {
    constexpr double least_pivot = 1e-7;  // squared: the unknown's own share after the others took theirs
    std::array<Vector, kTerms> l{};
    Vector scale{};
    for (std::size_t r = 0; r < count; ++r) {
      if (!(matrix[r][r] > 0)) return false;
      scale[r] = 1 / std::sqrt(matrix[r][r]);
    }
    for (std::size_t r = 0; r < count; ++r) {
      for (std::size_t c = 0; c <= r; ++c) {
        double sum = matrix[r][c] * scale[r] * scale[c];
        for (std::size_t k = 0; k < c; ++k) sum -= l[r][k] * l[c][k];
        if (r == c) {
          if (!(sum > least_pivot)) return false;
          l[r][r] = std::sqrt(sum);
        } else {
          l[r][c] = sum / l[c][c];
        }
      }
    }
    for (std::size_t r = 0; r < count; ++r) {
      double sum = right[r] * scale[r];
      for (std::size_t k = 0; k < r; ++k) sum -= l[r][k] * solution[k];
      solution[r] = sum / l[r][r];
    }
    for (std::size_t r = count; r-- > 0;) {
      double sum = solution[r];
      for (std::size_t k = r + 1; k < count; ++k) sum -= l[k][r] * solution[k];
      solution[r] = sum / l[r][r];
    }
    for (std::size_t r = 0; r < count; ++r) solution[r] *= scale[r];
    return true;
  }
};

// Curvatures at the origin of z = d x + e y + a x^2 + b xy + c y^2, z outwards: convex is where z falls.
MeanAndGauss curvature_of(const Vector& z) {
  const double zx = z[0], zy = z[1], zxx = 2 * z[2], zxy = z[3], zyy = 2 * z[4];
  const double slope = 1 + zx * zx + zy * zy;
  const double mean = ((1 + zx * zx) * zyy + (1 + zy * zy) * zxx - 2 * zx * zy * zxy) / (2 * slope * std::sqrt(slope));
  return {static_cast<float>(-mean), static_cast<float>((zxx * zyy - zxy * zxy) / (slope * slope))};
}

// Appends each number that isn't marked yet.
struct Collector {
  std::vector<std::uint32_t>& out;
  std::vector<std::uint32_t>& mark;
  void add(std::uint32_t point, std::uint32_t around) {
    if (mark[point] == around) return;
    mark[point] = around;
    out.push_back(point);
  }
};

}  // namespace

QuadricFit::QuadricFit(const FaceStars& stars) {
  constexpr std::size_t most_in_ring = 64, most_faces_passed = 32;
  std::vector<std::uint32_t> mark(stars.point_count(), 0xffffffffu), ring;
  first_.assign(1, 0);
  for (std::uint32_t p = 0; p < stars.point_count(); ++p) {
    ring.clear();
    mark[p] = p;
    Collector inner{ring, mark};
    for (const std::uint32_t corner : stars.at(p)) {
      for (int c = 0; c < 3; ++c) inner.add(stars.faces[corner / 3][c], p);
    }
    const std::size_t step = (ring.size() + most_in_ring - 1) / most_in_ring;
    for (std::size_t i = 0; i < ring.size(); i += step) rings_.push_back(ring[i]);
    Collector outer{rings_, mark};
    if (step <= 1) {
      for (const std::uint32_t q : ring) {
        if (stars.at(q).size() > most_faces_passed) continue;
        for (const std::uint32_t corner : stars.at(q)) {
          for (int c = 0; c < 3; ++c) outer.add(stars.faces[corner / 3][c], p);
        }
      }
    }
    first_.push_back(static_cast<std::uint32_t>(rings_.size()));
  }
}

void QuadricFit::run(std::span<const glm::vec4> points, std::span<const glm::vec4> normals,
                     std::span<MeanAndGauss> values) const {
  for (std::size_t p = 0; p < values.size(); ++p) {
    const std::span<const std::uint32_t> rings = std::span(rings_).subspan(first_[p], first_[p + 1] - first_[p]);
    const glm::dvec3 w(normals[p].x, normals[p].y, normals[p].z), centre(points[p].x, points[p].y, points[p].z);
    if (rings.size() < kQuadricTerms || !(glm::dot(w, w) > 0.5)) continue;
    const glm::dvec3 u = glm::normalize(glm::cross(w, std::abs(w.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 v = glm::cross(w, u);
    double reach_sq = 0;
    for (const std::uint32_t q : rings) {
      const glm::dvec3 d = glm::dvec3(points[q].x, points[q].y, points[q].z) - centre;
      reach_sq = std::max(reach_sq, glm::dot(d, d));
    }
    if (!(reach_sq > 0)) continue;
    const double reach = std::sqrt(reach_sq);
    NormalEquations equations;
    for (const std::uint32_t q : rings) {
      const glm::dvec3 d = (glm::dvec3(points[q].x, points[q].y, points[q].z) - centre) / reach;
      const double x = glm::dot(d, u), y = glm::dot(d, v);
      constexpr double nearest_sq = 1e-3;  // of the reach: nearer points weigh no more
      equations.add({x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y}, glm::dot(d, w),
                    1 / (x * x + y * y + nearest_sq));
    }
    Vector solution{};
    const bool cubic = rings.size() > kTerms && equations.solve(kTerms, solution);
    if (!cubic && !equations.solve(kQuadricTerms, solution)) continue;
    const MeanAndGauss scaled = curvature_of(solution);
    values[p] = {static_cast<float>(scaled.mean / reach), static_cast<float>(scaled.gauss / reach_sq)};
  }
}

}  // namespace rinkaku::outline

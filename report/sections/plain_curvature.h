#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::report {

/// Curvature of a closed surface in plain loops over its faces, all of it in one precision: what a method loses in
/// float and costs in double. The methods are those of outline/curvature.h: corrected curvature measures (Lachaud and
/// others 2020) and cotangents with the mixed area (Meyer and others 2003).
template <class T>
class PlainCurvature {
 public:
  using Vec = glm::vec<3, T, glm::defaultp>;

  PlainCurvature(std::span<const glm::vec3> points, std::span<const glm::uvec3> faces)
      : points_(points.begin(), points.end()),
        faces_(faces.begin(), faces.end()),
        normals_(points.size()),
        sums_(points.size()),
        area_(points.size()),
        mean_(points.size()),
        gauss_(points.size()) {}

  void corrected() {
    std::fill(normals_.begin(), normals_.end(), Vec(0));
    for (const glm::uvec3& f : faces_) {
      const Vec a = points_[f.y] - points_[f.x], b = points_[f.z] - points_[f.x], c = b - a;
      const Vec cross = glm::cross(a, b);
      const T aa = glm::dot(a, a), bb = glm::dot(b, b), cc = glm::dot(c, c);
      normals_[f.x] += cross / (aa * bb);
      normals_[f.y] += cross / (aa * cc);
      normals_[f.z] += cross / (bb * cc);
    }
    for (Vec& n : normals_) n = glm::normalize(n);
    clear();
    for (const glm::uvec3& f : faces_) {
      const Vec a = points_[f.y] - points_[f.x], b = points_[f.z] - points_[f.x];
      const Vec &ui = normals_[f.x], &uj = normals_[f.y], &uk = normals_[f.z];
      const Vec middle = (ui + uj + uk) / T(3);
      const T area = glm::dot(middle, glm::cross(a, b)) / 2;
      const T mean = glm::dot(middle, glm::cross(ui - uk, a) + glm::cross(uj - ui, b)) / 2;
      const T gauss = glm::dot(ui, glm::cross(uj - ui, uk - ui)) / 2;
      for (int k = 0; k < 3; ++k) area_[f[k]] += area, mean_[f[k]] += mean, gauss_[f[k]] += gauss;
    }
    for (std::size_t p = 0; p < points_.size(); ++p) mean_[p] /= 2 * area_[p], gauss_[p] /= area_[p];
  }

  void cotangents() {
    clear();
    std::fill(normals_.begin(), normals_.end(), Vec(0));
    std::fill(sums_.begin(), sums_.end(), Vec(0));
    for (const glm::uvec3& f : faces_) {
      for (int k = 0; k < 3; ++k) {
        const unsigned i = f[k], j = f[(k + 1) % 3], l = f[(k + 2) % 3];
        const Vec u = points_[j] - points_[i], v = points_[l] - points_[i], w = v - u;
        const Vec cross = glm::cross(u, v);
        const T twice = glm::length(cross), at_i = glm::dot(u, v), at_j = -glm::dot(u, w), at_l = glm::dot(v, w);
        sums_[i] += (at_l / twice) * u + (at_j / twice) * v;
        normals_[i] += cross;
        gauss_[i] += std::atan2(twice, at_i);
        const bool obtuse = at_i < 0 || at_j < 0 || at_l < 0;
        area_[i] += obtuse ? twice * (at_i < 0 ? T(0.25) : T(0.125))
                           : (at_l / twice * glm::dot(u, u) + at_j / twice * glm::dot(v, v)) / 8;
      }
    }
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const T bend = glm::length(sums_[p]) / (4 * area_[p]);
      mean_[p] = glm::dot(sums_[p], normals_[p]) > 0 ? -bend : bend;
      gauss_[p] = (2 * std::numbers::pi_v<T> - gauss_[p]) / area_[p];
    }
  }

  T mean(std::size_t point) const { return mean_[point]; }
  T gauss(std::size_t point) const { return gauss_[point]; }

 private:
  void clear() {
    for (std::vector<T>* values : {&area_, &mean_, &gauss_}) std::fill(values->begin(), values->end(), T(0));
  }

  std::vector<Vec> points_;
  std::vector<glm::uvec3> faces_;
  std::vector<Vec> normals_, sums_;
  std::vector<T> area_, mean_, gauss_;
};

}  // namespace rinkaku::report

#include "outline/meyer_curvature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace rinkaku::outline {
namespace {

// Gaussian curvature of points on a border: the mean of their neighbours off it.
void fill_borders(const FaceStars& stars, std::span<MeanAndGauss> values) {
  for (std::size_t p = 0; p < values.size(); ++p) {
    if (!stars.open[p]) continue;
    float sum = 0;
    int count = 0;
    for (const std::uint32_t corner : stars.at(p)) {
      const glm::uvec3& face = stars.faces[corner / 3];
      for (int c = 0; c < 3; ++c) {
        if (stars.open[face[c]]) continue;
        sum += values[face[c]].gauss;
        ++count;
      }
    }
    values[p].gauss = count > 0 ? sum / static_cast<float>(count) : 0.0f;
  }
}

}  // namespace

MeyerCurvature::MeyerCurvature(const FaceStars& stars) : sums_(stars.point_count()) {}

void MeyerCurvature::add_face(const glm::uvec3& face, std::span<const glm::vec4> points) {
  constexpr double flattest = 1e-4;
  std::array<glm::dvec3, 3> edge;  // opposite each corner, running round the face
  for (int c = 0; c < 3; ++c) {
    edge[c] = glm::dvec3(glm::vec3(points[face[(c + 2) % 3]]) - glm::vec3(points[face[(c + 1) % 3]]));
  }
  const glm::dvec3 cross = glm::cross(edge[1], edge[2]);
  const double twice_area = glm::length(cross);
  std::array<double, 3> length_sq, dot;
  for (int c = 0; c < 3; ++c) {
    length_sq[c] = glm::dot(edge[c], edge[c]);
    dot[c] = -glm::dot(edge[(c + 1) % 3], edge[(c + 2) % 3]);  // of the two edges that leave the corner
  }
  if (!(twice_area > flattest * std::max({length_sq[0], length_sq[1], length_sq[2]}))) return;
  const int obtuse = dot[0] < 0 ? 0 : dot[1] < 0 ? 1 : dot[2] < 0 ? 2 : -1;
  const std::array<double, 3> cot = {dot[0] / twice_area, dot[1] / twice_area, dot[2] / twice_area};
  const double angle_0 = std::atan2(twice_area, dot[0]), angle_1 = std::atan2(twice_area, dot[1]);
  const std::array<double, 3> angle = {angle_0, angle_1, std::numbers::pi - angle_0 - angle_1};
  for (int c = 0; c < 3; ++c) {
    Sums& sums = sums_[face[c]];
    const int next = (c + 1) % 3, last = (c + 2) % 3;
    // The edge to the next corner is opposite the last one, and runs from here; the other one runs to here.
    sums.pull += cot[last] * edge[last] - cot[next] * edge[next];
    sums.normal += cross;
    sums.angle += angle[c];
    if (obtuse < 0) {
      sums.area += (cot[last] * length_sq[last] + cot[next] * length_sq[next]) / 8;
    } else {
      sums.area += twice_area * (obtuse == c ? 0.25 : 0.125);
    }
  }
}

void MeyerCurvature::run(const FaceStars& stars, std::span<const glm::vec4> points, std::span<MeanAndGauss> values) {
  std::fill(sums_.begin(), sums_.end(), Sums{});
  for (const glm::uvec3& face : stars.faces) add_face(face, points);
  bool any_open = false;
  for (std::size_t p = 0; p < sums_.size(); ++p) {
    const Sums& s = sums_[p];
    values[p] = {};
    if (!(s.area > 0)) continue;
    const glm::dvec3 curvature_normal = s.pull / (4 * s.area);
    const double size = glm::length(s.normal);
    const double along = size > 0 ? glm::dot(curvature_normal, s.normal) / size : 0;
    const double mean = stars.open[p] ? -along : -std::copysign(glm::length(curvature_normal), along);
    values[p] = {static_cast<float>(mean), static_cast<float>((2 * std::numbers::pi - s.angle) / s.area)};
    any_open = any_open || stars.open[p] != 0;
  }
  if (any_open) fill_borders(stars, values);
}

}  // namespace rinkaku::outline

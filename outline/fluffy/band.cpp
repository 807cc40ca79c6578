#include "outline/fluffy/band.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace rinkaku::fluffy {

BandSurface by_corners(const Frame& frame) { return {frame.points, frame.normals, frame.corners}; }

BandSurface by_faces(const Frame& frame) {
  BandSurface surface;
  for (std::uint32_t t = 0; t < frame.corners.size(); ++t) {
    const glm::uvec3& corners = frame.corners[t];
    const glm::dvec3 a = frame.points[corners.x], b = frame.points[corners.y], c = frame.points[corners.z];
    const glm::dvec3 outwards = glm::dvec3(frame.normals[corners.x]) + glm::dvec3(frame.normals[corners.y]) +
                                glm::dvec3(frame.normals[corners.z]);
    glm::dvec3 normal = glm::cross(b - a, c - a);
    // Mirrored and turned triangles are wound the other way; one without area has its corners' normal.
    if (glm::length(normal) > 0) {
      normal *= glm::dot(normal, outwards) < 0 ? -1.0 : 1.0;
    } else {
      normal = glm::length(outwards) > 0 ? outwards : glm::dvec3(0, 0, 1);
    }
    surface.points.emplace_back((a + b + c) / 3.0);
    surface.normals.emplace_back(glm::normalize(normal));
    surface.triangles.emplace_back(t);
  }
  return surface;
}

double band_sine(double width_rad) { return std::sin(width_rad / 2); }

bool in_band(const BandSurface& surface, std::size_t triangle, double sine, const glm::dvec3& eye) {
  double least = 1, most = -1;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t p = surface.triangles[triangle][k];
    const glm::dvec3 way = eye - glm::dvec3(surface.points[p]);
    const double facing = glm::dot(glm::dvec3(surface.normals[p]), way) / glm::length(way);
    least = std::min(least, facing);
    most = std::max(most, facing);
  }
  return least <= sine && most >= -sine;
}

BandCut::BandCut(BandSurface surface, double sine)
    : triangles_(std::move(surface.triangles)), sine_(static_cast<float>(sine + 1e-5)) {
  for (auto* list : {&x_, &y_, &z_, &nx_, &ny_, &nz_, &facing_}) list->resize(surface.points.size());
  move(surface.points, surface.normals);
  found_.resize(triangles_.size() + 1);  // written without branches, one past the last kept one
}

void BandCut::move(std::span<const glm::vec3> points, std::span<const glm::vec3> normals) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    x_[p] = points[p].x, y_[p] = points[p].y, z_[p] = points[p].z;
    nx_[p] = normals[p].x, ny_[p] = normals[p].y, nz_[p] = normals[p].z;
  }
}

std::span<const std::uint32_t> BandCut::find(const glm::dvec3& eye) {
  const glm::vec3 from(eye);
  const float *x = x_.data(), *y = y_.data(), *z = z_.data();
  const float *nx = nx_.data(), *ny = ny_.data(), *nz = nz_.data();
  float* facing = facing_.data();
  const std::size_t points = x_.size();
  for (std::size_t p = 0; p < points; ++p) {
    const float dx = from.x - x[p], dy = from.y - y[p], dz = from.z - z[p];
    const float square = dx * dx + dy * dy + dz * dz;
    facing[p] = (nx[p] * dx + ny[p] * dy + nz[p] * dz) / std::sqrt(square + 1e-30f);
  }
  std::uint32_t* out = found_.data();
  const auto count = static_cast<std::uint32_t>(triangles_.size());
  for (std::uint32_t t = 0; t < count; ++t) {
    const glm::uvec3& corners = triangles_[t];
    const float a = facing[corners.x], b = facing[corners.y], c = facing[corners.z];
    const float least = std::min(a, std::min(b, c)), most = std::max(a, std::max(b, c));
    *out = t;
    out += (least <= sine_ ? 1 : 0) & (most >= -sine_ ? 1 : 0);
  }
  return {found_.data(), out};
}

}  // namespace rinkaku::fluffy

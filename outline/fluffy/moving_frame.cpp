#include "outline/fluffy/moving_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rinkaku::fluffy {

MovingFrame::MovingFrame(Frame frame, const mesh::Topology& topology, const glm::dmat3& world_from_object)
    : frame_(std::move(frame)), world_from_object_(world_from_object), mesh_points_(frame_.mesh_points) {
  const std::size_t own = mesh_points_.size();
  std::vector<std::uint32_t> numbers(topology.points.size(), mesh::kNone);
  for (std::uint32_t p = 0; p < own; ++p) numbers[mesh_points_[p]] = p;
  const bool mirrored = glm::determinant(world_from_object) < 0;
  for (std::size_t f = 0; f < topology.faces.size(); ++f) {
    const glm::uvec3& face = topology.faces[f];
    const auto touches = [&](std::uint32_t p) { return numbers[p] < own; };
    if (!touches(face.x) && !touches(face.y) && !touches(face.z)) continue;
    const glm::uvec3 corners(local(numbers, face.x), local(numbers, face.y), local(numbers, face.z));
    faces_.push_back({corners, mirrored != (topology.turned[f] != 0)});
  }
  if (frame_.kind == Growth::Scaled) {
    for (const std::uint32_t f : frame_.chosen) {
      const glm::uvec3& face = topology.faces[f];
      chosen_.emplace_back(local(numbers, face.x), local(numbers, face.y), local(numbers, face.z));
    }
  }
  points_.resize(mesh_points_.size());
  normals_.assign(mesh_points_.size(), glm::dvec3(0, 0, 1));
}

std::uint32_t MovingFrame::local(std::vector<std::uint32_t>& numbers, std::uint32_t mesh_point) {
  std::uint32_t& number = numbers[mesh_point];
  if (number == mesh::kNone) {
    number = static_cast<std::uint32_t>(mesh_points_.size());
    mesh_points_.push_back(mesh_point);
  }
  return number;
}

void MovingFrame::move(std::span<const glm::vec3> points) {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    points_[p] = world_from_object_ * glm::dvec3(points[mesh_points_[p]]);
  }
  for (std::size_t p = 0; p < frame_.normals.size(); ++p) normals_[p] = frame_.normals[p];
  find_normals(points_, faces_, normals_);
  const bool scaled = frame_.kind == Growth::Scaled;
  const glm::dvec3 centre = scaled ? find_centre(points_, chosen_).place : glm::dvec3(0);
  double longest_squared = 0;
  for (std::size_t p = 0; p < frame_.points.size(); ++p) {
    const glm::dvec3 growth = frame_.reach[p] * (scaled ? points_[p] - centre : normals_[p]);
    frame_.points[p] = points_[p];
    frame_.normals[p] = normals_[p];
    frame_.growth[p] = growth;
    longest_squared = std::max(longest_squared, glm::dot(growth, growth));
  }
  frame_.longest_m = static_cast<float>(std::sqrt(longest_squared));
}

}  // namespace rinkaku::fluffy

#include "mesh/skin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rinkaku::mesh {
namespace {

/// Of any length that float can hold; zero for zero and for what is not finite.
glm::vec3 unit_of_any(const glm::vec3& v) {
  const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 && std::isfinite(largest) ? glm::normalize(v / largest) : glm::vec3(0);
}

/// Along the first, else along the others, which are what is known next best.
glm::vec3 first_direction(const glm::vec3& first, const glm::vec3& second, const glm::vec3& third) {
  for (const glm::vec3& each : {first, second}) {
    const glm::vec3 found = unit_of_any(each);
    if (found != glm::vec3(0)) return found;
  }
  return third;
}

/// Per point, the sum of its faces' cross products, so weighted by area; unit, or zero.
std::vector<glm::vec3> mean_normals(const Topology& topology, std::span<const glm::vec3> points) {
  std::vector<glm::dvec3> sums(points.size(), glm::dvec3(0));
  for (std::size_t f = 0; f < topology.faces.size(); ++f) {
    const glm::uvec3& t = topology.faces[f];
    const glm::dvec3 a(points[t.x]);
    glm::dvec3 cross = glm::cross(glm::dvec3(points[t.y]) - a, glm::dvec3(points[t.z]) - a);
    if (topology.turned[f] != 0) cross = -cross;
    for (int c = 0; c < 3; ++c) sums[t[c]] += cross;
  }
  std::vector<glm::vec3> normals;
  normals.reserve(points.size());
  for (const glm::dvec3& sum : sums) {
    const double length = glm::length(sum);
    normals.emplace_back(length > 0 ? sum / length : glm::dvec3(0));
  }
  return normals;
}

}  // namespace

Skin::Skin(const Mesh& mesh, const Topology& topology, const Rig& rig)
    : first_influence_(rig.first_influence),
      influences_(rig.influences),
      first_vertex_(mesh.point_count + std::size_t{1}, 0),
      vertices_(mesh.positions.size()),
      bind_points_(rig.bind_points),
      bind_normals_(mesh.normals),
      bind_outline_normals_(topology.outline_normals) {
  for (const std::uint32_t point : mesh.welded) ++first_vertex_[point + 1];
  for (std::size_t p = 0; p < mesh.point_count; ++p) first_vertex_[p + 1] += first_vertex_[p];
  std::vector<std::uint32_t> next(first_vertex_.begin(), first_vertex_.end() - 1);
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) vertices_[next[mesh.welded[v]]++] = v;

  // A normal n at rest is the cofactors' image of the transpose's image of n, up to its length; and where the matrix
  // mirrors, up to its sign.
  const Pose rest = Poser(rig).rest();
  for (const glm::mat4& joint : rest.joints) joints_.emplace_back(joint);
  std::vector<glm::mat3> bind_from_rest(mesh.point_count);
  for (std::size_t p = 0; p < mesh.point_count; ++p) {
    const FourColumns columns = blended(p);
    const glm::mat3 linear(three(columns.x), three(columns.y), three(columns.z));
    bind_from_rest[p] = glm::transpose(linear) * (glm::determinant(linear) < 0 ? -1.0f : 1.0f);
    const auto to_bind = [&](glm::vec3& n) { n = first_direction(bind_from_rest[p] * n, n, n); };
    to_bind(bind_outline_normals_[p]);
    for (std::uint32_t i = first_vertex_[p]; i < first_vertex_[p + 1]; ++i) to_bind(bind_normals_[vertices_[i]]);
  }
  morphed_points_ = bind_points_;
  morphed_normals_ = bind_normals_;
  morphed_outline_normals_ = bind_outline_normals_;
  points_.resize(bind_points_.size());
  normals_.resize(bind_normals_.size());
  outline_normals_.resize(bind_points_.size());
  add_shapes(topology, rig, bind_from_rest);
  pose(rest);
}

void Skin::add_shapes(const Topology& topology, const Rig& rig, std::span<const glm::mat3> bind_from_rest) {
  if (rig.morphs.empty()) return;
  constexpr float least = 1e-5f;
  const std::vector<glm::vec3> before = mean_normals(topology, topology.points);
  std::vector<glm::vec3> moved = topology.points;
  for (const Morph& morph : rig.morphs) {
    Shape& shape = shapes_.emplace_back();
    shape.points = morph.points;
    shape.offsets = morph.offsets;
    for (std::size_t i = 0; i < morph.points.size(); ++i) {
      const std::uint32_t p = morph.points[i];
      moved[p] += glm::transpose(bind_from_rest[p]) * morph.offsets[i];
    }
    const std::vector<glm::vec3> after = mean_normals(topology, moved);
    for (std::uint32_t p = 0; p < after.size(); ++p) {
      const glm::vec3 bend = after[p] - before[p];
      if (after[p] == glm::vec3(0) || !(glm::dot(bend, bend) > least * least)) continue;
      // Of a direction only: without the scale of the matrix.
      const glm::vec3 in_bind = bind_from_rest[p] * bend;
      const float length = glm::length(in_bind);
      if (!(length > 0)) continue;
      shape.bent.push_back(p);
      shape.bends.push_back(in_bind * (glm::length(bend) / length));
    }
    for (const std::uint32_t p : morph.points) moved[p] = topology.points[p];
  }
}

void Skin::add_morphs(const Pose& pose) {
  const bool any = std::any_of(pose.morph_weights.begin(), pose.morph_weights.end(), [](float w) { return w != 0; });
  if (!any && !morphed_) return;
  morphed_ = any;
  ++morphs_made_;
  std::copy(bind_points_.begin(), bind_points_.end(), morphed_points_.begin());
  std::copy(bind_normals_.begin(), bind_normals_.end(), morphed_normals_.begin());
  std::copy(bind_outline_normals_.begin(), bind_outline_normals_.end(), morphed_outline_normals_.begin());
  for (std::size_t m = 0; m < shapes_.size(); ++m) {
    const float weight = pose.morph_weights[m];
    if (weight == 0) continue;
    const Shape& shape = shapes_[m];
    for (std::size_t i = 0; i < shape.points.size(); ++i) morphed_points_[shape.points[i]] += weight * shape.offsets[i];
    for (std::size_t i = 0; i < shape.bent.size(); ++i) {
      const std::uint32_t p = shape.bent[i];
      const glm::vec3 bend = weight * shape.bends[i];
      morphed_outline_normals_[p] += bend;
      for (std::uint32_t k = first_vertex_[p]; k < first_vertex_[p + 1]; ++k) morphed_normals_[vertices_[k]] += bend;
    }
  }
}

void Skin::pose(const Pose& pose) {
  pose_points(pose);
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    pose_normals(p, [&](std::uint32_t v, const Four& normal, const Four&) { normals_[v] = three(normal); });
  }
}

void Skin::pose_points(const Pose& pose) {
  add_morphs(pose);
  pose_joints_.assign(pose.joints.begin(), pose.joints.end());
  joints_.resize(pose.joints.size());
  turns_.resize(pose.joints.size());
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    joints_[j] = FourColumns(pose.joints[j]);
    turns_[j] = Turn(joints_[j]);
  }
  constexpr float most = std::numeric_limits<float>::max();
  Four low{most, most, most, most}, high = -low;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const std::uint32_t first = first_influence_[p];
    const Four at = first_influence_[p + 1] - first == 1 ? joints_[influences_[first].joint].at(morphed_points_[p])
                                                         : blended(p).at(morphed_points_[p]);
    low = at < low ? at : low;
    high = at > high ? at : high;
    points_[p] = three(at);
  }
  box_ = points_.empty() ? Box{} : Box{three(low), three(high)};
}

Four Skin::turned_at_rest_or_so(const Four& along, const glm::vec3& n, std::size_t point) const {
  const FourColumns m = blended(point);
  return four(first_direction(three(along), three(m.x * n.x + m.y * n.y + m.z * n.z), n));
}

}  // namespace rinkaku::mesh

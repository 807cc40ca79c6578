#include "silhouette/peers/cluster_cones.h"

#include <meshoptimizer.h>

#include <glm/geometric.hpp>

namespace rinkaku::silhouette {
namespace {

glm::dvec3 vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

// meshoptimizer computes cones in float; a cluster has to face away by more than its rounding.
constexpr double margin = 1e-4;

}  // namespace

ClusterCones::ClusterCones(std::span<const glm::vec3> points, std::span<const std::uint32_t> indices) {
  constexpr std::size_t most_vertices = 64, most_triangles = 124;
  constexpr float cone_weight = 0.5f;
  std::vector<meshopt_Meshlet> meshlets(meshopt_buildMeshletsBound(indices.size(), most_vertices, most_triangles));
  std::vector<std::uint32_t> vertices(meshlets.size() * most_vertices);
  std::vector<unsigned char> triangles(meshlets.size() * most_triangles * 3);
  meshlets.resize(meshopt_buildMeshlets(meshlets.data(), vertices.data(), triangles.data(), indices.data(),
                                        indices.size(), &points[0].x, points.size(), sizeof(glm::vec3), most_vertices,
                                        most_triangles, cone_weight));
  indices_.reserve(indices.size());
  for (const meshopt_Meshlet& meshlet : meshlets) {
    const std::uint32_t* const own = &vertices[meshlet.vertex_offset];
    const unsigned char* const corners = &triangles[meshlet.triangle_offset];
    const meshopt_Bounds bounds = meshopt_computeMeshletBounds(own, corners, meshlet.triangle_count, &points[0].x,
                                                               points.size(), sizeof(glm::vec3));
    const auto first = static_cast<std::uint32_t>(indices_.size());
    for (std::size_t i = 0; i < meshlet.triangle_count * std::size_t{3}; ++i) indices_.push_back(own[corners[i]]);
    clusters_.push_back(
        {first, meshlet.triangle_count * 3, vector(bounds.cone_apex), vector(bounds.cone_axis), bounds.cone_cutoff});
  }
  facing_.reserve(indices_.size());
}

std::span<const std::uint32_t> ClusterCones::facing(const glm::dvec3& eye) {
  facing_.clear();
  for (const Cluster& cluster : clusters_) {
    const glm::dvec3 from_eye = cluster.apex - eye;
    const bool away =
        cluster.cutoff < 1 && glm::dot(from_eye, cluster.axis) >= (cluster.cutoff + margin) * glm::length(from_eye);
    if (away) continue;
    const auto first = indices_.begin() + cluster.first_index;
    facing_.insert(facing_.end(), first, first + cluster.index_count);
  }
  return facing_;
}

}  // namespace rinkaku::silhouette

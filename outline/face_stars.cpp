#include "outline/face_stars.h"

#include <numeric>
#include <utility>

namespace rinkaku::outline {

FaceStars face_stars(const mesh::Topology& topology) {
  FaceStars stars;
  stars.faces = topology.faces;
  for (std::size_t f = 0; f < stars.faces.size(); ++f) {
    if (topology.turned[f]) std::swap(stars.faces[f].y, stars.faces[f].z);
  }
  stars.first.assign(topology.points.size() + 1, 0);
  for (const glm::uvec3& face : stars.faces) {
    for (int c = 0; c < 3; ++c) ++stars.first[face[c] + 1];
  }
  std::partial_sum(stars.first.begin(), stars.first.end(), stars.first.begin());
  stars.corners.resize(stars.faces.size() * 3);
  std::vector<std::uint32_t> next(stars.first.begin(), stars.first.end() - 1);
  for (std::uint32_t f = 0; f < stars.faces.size(); ++f) {
    for (std::uint32_t c = 0; c < 3; ++c) stars.corners[next[stars.faces[f][static_cast<int>(c)]]++] = 3 * f + c;
  }
  stars.open.assign(topology.points.size(), 0);
  const std::size_t two_faced = topology.consistent_edges + topology.inconsistent_edges;
  for (std::size_t e = two_faced; e < topology.edges.size(); ++e) {
    stars.open[topology.edges[e].a] = stars.open[topology.edges[e].b] = 1;
  }
  return stars;
}

}  // namespace rinkaku::outline

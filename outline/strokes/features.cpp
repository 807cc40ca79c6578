#include "outline/strokes/features.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "mesh/intersections.h"

namespace rinkaku::outline {
namespace {

bool look_alike(const mesh::Material& a, const mesh::Material& b) {
  return a.base_colour == b.base_colour && a.texture == b.texture && a.alpha == b.alpha;
}

struct Found {
  std::vector<Segment> segments;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>> faces;  // by vertices
  void add(std::uint32_t from, std::uint32_t to, std::uint32_t face0, std::uint32_t face1) {
    segments.push_back({from, to});
    faces[std::minmax(from, to)] = {face0, face1};
  }
};

void add_edges(const mesh::Mesh& mesh, const mesh::Topology& topology, const FeatureOptions& options, Found& found) {
  const std::vector<std::uint32_t> part_of = mesh::part_of_triangles(mesh);
  const auto cos_crease = static_cast<float>(std::cos(glm::radians(options.crease_deg)));
  for (std::uint32_t e = 0; e < topology.consistent_edges + topology.inconsistent_edges; ++e) {
    const mesh::Edge& edge = topology.edges[e];
    const auto& material = [&](std::uint32_t face) -> const mesh::Material& {
      return mesh.materials[mesh.parts[part_of[face]].material];
    };
    const bool border = options.materials && part_of[edge.face0] != part_of[edge.face1] &&
                        !look_alike(material(edge.face0), material(edge.face1));
    const bool turned = topology.turned[edge.face0] != topology.turned[edge.face1];
    const float cosine = glm::dot(topology.face_normals[edge.face0], topology.face_normals[edge.face1]);
    const bool crease = options.creases && (turned ? -cosine : cosine) < cos_crease;
    if (border || crease) found.add(edge.vertex_a, edge.vertex_b, edge.face0, edge.face1);
  }
}

void add_cuts(const mesh::Mesh& mesh, const mesh::Topology& topology, Features& out, Found& found) {
  std::map<std::tuple<double, double, double>, std::uint32_t> known;
  std::uint32_t point = mesh.point_count;
  for (const mesh::Cut& cut : mesh::intersections(topology)) {
    std::uint32_t ends[2];
    for (std::size_t k = 0; k < 2; ++k) {
      const glm::dvec3& end = cut.ends[k];
      const auto fresh = static_cast<std::uint32_t>(mesh.positions.size() + out.more_positions.size());
      const auto [at, added] = known.try_emplace({end.x, end.y, end.z}, fresh);
      if (added) {
        out.more_positions.emplace_back(end);
        out.welded.push_back(point++);
        CutPlace& place = out.cut_places.emplace_back();
        for (std::size_t side = 0; side < 2; ++side) {
          place.sides[side] = {mesh.triangles[cut.faces[side]], glm::vec3(cut.weights[side][k])};
        }
      }
      ends[k] = at->second;
    }
    if (ends[0] != ends[1]) found.add(ends[0], ends[1], cut.faces[0], cut.faces[1]);
  }
}

}  // namespace

Features find_features(const mesh::Mesh& mesh, const mesh::Topology& topology, const FeatureOptions& options) {
  Features out;
  out.welded = mesh.welded;
  Found found;
  add_edges(mesh, topology, options, found);
  if (options.cuts) add_cuts(mesh, topology, out, found);
  for (const Segment& segment : in_order(found.segments, out.welded)) {
    const auto [face0, face1] = found.faces.at(std::minmax(segment.from, segment.to));
    out.list.push_back({segment, face0, face1});
  }
  return out;
}

}  // namespace rinkaku::outline

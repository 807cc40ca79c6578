#include "mesh/bind_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "mesh/bounds.h"

namespace rinkaku::mesh {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Tells whether two vertices that are at one place at rest stay together.
class Movement {
 public:
  explicit Movement(const Rig& rig) : rig_(rig), offsets_(rig.morphs.size()) {
    const glm::dvec3 size = bounding_box(rig.bind_points).size();
    const double near = 1e-4 * std::max({size.x, size.y, size.z});
    near_ = std::isfinite(near) ? static_cast<float>(near) : 0.0f;
    for (std::size_t m = 0; m < offsets_.size(); ++m) {
      offsets_[m].resize(rig.bind_points.size(), glm::vec3(0));
      const Morph& morph = rig.morphs[m];
      for (std::size_t i = 0; i < morph.points.size(); ++i) offsets_[m][morph.points[i]] = morph.offsets[i];
    }
  }

  bool alike(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t first_a = rig_.first_influence[a], first_b = rig_.first_influence[b];
    const std::uint32_t count = rig_.first_influence[a + 1] - first_a;
    if (count != rig_.first_influence[b + 1] - first_b) return false;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (!alike(rig_.influences[first_a + i], a, rig_.influences[first_b + i], b)) return false;
    }
    return std::all_of(offsets_.begin(), offsets_.end(),
                       [&](const auto& offsets) { return glm::distance(offsets[a], offsets[b]) <= near_; });
  }

 private:
  // By what they mean, as two meshes may give one bone in different coordinates.
  bool alike(const Influence& ia, std::uint32_t a, const Influence& ib, std::uint32_t b) const {
    const Joint &ja = rig_.joints[ia.joint], &jb = rig_.joints[ib.joint];
    if (ja.node != jb.node || std::abs(ia.weight - ib.weight) > 0.005f) return false;
    const glm::vec4 pa = ja.node_from_bind * glm::vec4(rig_.bind_points[a], 1);
    const glm::vec4 pb = jb.node_from_bind * glm::vec4(rig_.bind_points[b], 1);
    return glm::distance(glm::vec3(pa), glm::vec3(pb)) <= near_;
  }

  const Rig& rig_;
  std::vector<std::vector<glm::vec3>> offsets_;  // per morph, of each vertex
  float near_ = 0;
};

}  // namespace

void split_by_movement(const Rig& rig, std::vector<std::uint32_t>& point, std::size_t& count) {
  const Movement movement(rig);
  // The points that each old point becomes, as lists of their first vertices.
  std::vector<std::uint32_t> first(count, kNone);
  struct Split {
    std::uint32_t vertex, next;
  };
  std::vector<Split> splits;
  for (std::uint32_t v = 0; v < point.size(); ++v) {
    std::uint32_t* at = &first[point[v]];
    while (*at != kNone && !movement.alike(splits[*at].vertex, v)) at = &splits[*at].next;
    if (*at == kNone) {
      *at = static_cast<std::uint32_t>(splits.size());
      point[v] = *at;
      splits.push_back({v, kNone});
    } else {
      point[v] = *at;
    }
  }
  count = splits.size();
}

Rig rig_of_points(Rig of_vertices, std::span<const std::uint32_t> vertices) {
  Rig rig;
  rig.nodes = std::move(of_vertices.nodes);
  rig.joints = std::move(of_vertices.joints);
  rig.animations = std::move(of_vertices.animations);
  rig.first_influence.push_back(0);
  std::vector<std::uint32_t> point_of(of_vertices.bind_points.size(), kNone);
  for (std::uint32_t p = 0; p < vertices.size(); ++p) {
    const std::uint32_t v = vertices[p];
    point_of[v] = p;
    rig.bind_points.push_back(of_vertices.bind_points[v]);
    const auto influence = of_vertices.influences.begin();
    rig.influences.insert(rig.influences.end(), influence + of_vertices.first_influence[v],
                          influence + of_vertices.first_influence[v + 1]);
    rig.first_influence.push_back(static_cast<std::uint32_t>(rig.influences.size()));
  }
  for (Morph& morph : of_vertices.morphs) {
    Morph kept{std::move(morph.name), morph.rest_weight, {}, {}};
    for (std::size_t i = 0; i < morph.points.size(); ++i) {
      if (point_of[morph.points[i]] == kNone) continue;
      kept.points.push_back(point_of[morph.points[i]]);
      kept.offsets.push_back(morph.offsets[i]);
    }
    rig.morphs.push_back(std::move(kept));
  }
  return rig;
}

}  // namespace rinkaku::mesh

#include "silhouette/region_faces.h"

#include <utility>

namespace rinkaku::silhouette {
namespace {

// A region's numbers: how many faces are doubtful, how many edges there are, which, and a byte for each face.
constexpr std::size_t head = 2;

enum class Facing : std::uint8_t { Back, Front, Doubtful };

}  // namespace

std::shared_ptr<const RegionFaces::Base> RegionFaces::base_of(const mesh::Topology& topology) {
  auto base = std::make_shared<Base>();
  base->edges.reserve(topology.consistent_edges);
  for (std::uint32_t e = 0; e < topology.consistent_edges; ++e) {
    base->edges.push_back({topology.edges[e].face0, topology.edges[e].face1});
  }
  base->uncertain.reserve(topology.faces.size());
  for (const std::uint32_t component : topology.component) {
    base->uncertain.push_back(topology.component_two_sided[component]);
  }
  return base;
}

void RegionFaces::make(const Base& base, const RegionFile& file, std::uint32_t region,
                       std::vector<std::uint32_t>& out) {
  thread_local std::vector<Role> roles;
  file.decode_roles(region, roles);
  thread_local std::vector<Facing> facing;
  facing.resize(roles.size());
  out.assign(head, 0);
  for (std::size_t f = 0; f < roles.size(); ++f) {
    facing[f] = Facing::Doubtful;
    if (base.uncertain[f] == 0 && roles[f] == Role::Front) facing[f] = Facing::Front;
    if (base.uncertain[f] == 0 && roles[f] == Role::Dropped) facing[f] = Facing::Back;
    if (facing[f] == Facing::Doubtful) out.push_back(static_cast<std::uint32_t>(f));
  }
  out[0] = static_cast<std::uint32_t>(out.size() - head);
  for (std::size_t e = 0; e < base.edges.size(); ++e) {
    const Facing a = facing[base.edges[e].face0], b = facing[base.edges[e].face1];
    if (a != b || a == Facing::Doubtful) out.push_back(static_cast<std::uint32_t>(e));
  }
  out[1] = static_cast<std::uint32_t>(out.size() - head - out[0]);
  const std::size_t first = out.size();
  out.resize(first + (facing.size() + 3) / 4);
  auto* front = reinterpret_cast<std::uint8_t*>(out.data() + first);
  for (std::size_t f = 0; f < facing.size(); ++f) front[f] = facing[f] == Facing::Front ? 1 : 0;
}

RegionFaces::RegionFaces(std::shared_ptr<const RegionFile> file, const mesh::Topology& topology,
                         const RegionListsOptions& options)
    : faces_(topology.faces.size()),
      lists_(
          std::move(file),
          [base = base_of(topology)](const RegionFile& of, std::uint32_t region, std::vector<std::uint32_t>& out) {
            make(*base, of, region, out);
          },
          options) {}

const mesh::KnownFaces* RegionFaces::at(const glm::dvec3& eye_in_mesh) {
  const RegionList list = lists_.at(eye_in_mesh);
  if (list.whole) return nullptr;
  const std::size_t doubtful = list.indices[0], edges = list.indices[1];
  const auto rest = list.indices.subspan(head + doubtful + edges);
  known_ = {{reinterpret_cast<const std::uint8_t*>(rest.data()), faces_},
            list.indices.subspan(head, doubtful),
            list.indices.subspan(head + doubtful, edges),
            list.serial};
  return &known_;
}

}  // namespace rinkaku::silhouette

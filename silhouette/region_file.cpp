#include "silhouette/region_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <meshoptimizer.h>

#include "pipeline/frame/error.h"
#include "silhouette/mapped_file.h"
#include "silhouette/reduce.h"
#include "silhouette/region_check.h"
#include "silhouette/value_runs.h"

namespace rinkaku::silhouette {
namespace {

// A fuzzer can't guess sums; without them it gets at what lies behind.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool kSums = false;
#else
constexpr bool kSums = true;
#endif

constexpr std::uint8_t kTwoSided = 1;
constexpr std::uint8_t kFromBehind = 2;

Error damaged(const std::string& name, const char* what) {
  return input_error(name, std::string("is no sound region file: ") + what, "bake it again");
}

template <typename T>
std::span<const std::uint8_t> bytes_of(const flatbuffers::Vector<const T*>* vector) {
  return vector ? std::span(vector->Data(), vector->size() * sizeof(T)) : std::span<const std::uint8_t>();
}

RegionFileHead head_of(const format::RegionSet& set) {
  RegionFileHead head;
  head.mesh_hash = set.mesh_hash();
  head.points = set.points();
  head.mesh_triangles = set.mesh_triangles();
  head.full_triangles = set.full_triangles();
  if (set.centre()) {
    head.centre[0] = set.centre()->x();
    head.centre[1] = set.centre()->y();
    head.centre[2] = set.centre()->z();
  }
  head.radius = set.radius();
  head.cells = set.cells();
  head.shells = set.shells();
  head.inner_radii = set.inner_radii();
  head.depth_distance = set.depth_distance();
  return head;
}

ViewSpace space_of(const format::RegionSet& set) {
  if (set.cells() > 0) {
    constexpr std::uint32_t kMost = 1000;  // so that they fit; check() has the limits
    return RegionLayout{static_cast<int>(std::min(set.cells(), kMost)), static_cast<int>(std::min(set.shells(), kMost)),
                        set.inner_radii()};
  }
  ViewRegion region;
  if (set.hull() && set.hull()->size() <= 64) {
    for (const format::Vec4* h : *set.hull()) region.hull.emplace_back(h->x(), h->y(), h->z(), h->w());
  }
  return region;
}

std::span<const std::uint8_t> bytes_of(const flatbuffers::Vector<std::uint8_t>* vector) {
  return {vector->data(), vector->size()};
}

std::uint64_t size_of(const format::Region& region) {
  return std::uint64_t{region.role_bytes()} + region.matte_front().bytes() + region.depth_front().bytes();
}

bool possible(const format::List& list) {
  // The codec takes a byte a triangle at least.
  return list.bytes() == 0 ? list.triangles() == 0 : list.triangles() < list.bytes();
}

}  // namespace

struct RegionFile::State {
  std::string name;
  MappedFile mapped;
  std::vector<std::uint8_t> memory;
  const format::RegionSet* set = nullptr;
  ViewSpace space;
  UnitFrame frame;

  std::vector<std::uint32_t> triangles;  // the mesh's, three points each
  std::vector<std::uint8_t> sides;       // per triangle: kTwoSided, kFromBehind

  void verify(std::span<const std::uint8_t> bytes);
  void verify_table() const;
  void unpack_mesh();
  const format::Region& region(std::uint32_t index) const { return *set->regions()->Get(index); }
  std::span<const std::uint8_t> sound_data_of(const format::Region& region) const;
  void append_list(const format::List& list, std::span<const std::uint8_t> bytes,
                   std::vector<std::uint32_t>& out) const;
  void append_role(const RunReader::Run& run, std::vector<std::uint32_t>& out) const;
};

void RegionFile::State::verify(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 16 || !format::RegionSetBufferHasIdentifier(bytes.data())) {
    throw input_error(name, "is no region file", "give a .rgn file that bake wrote");
  }
  flatbuffers::Verifier verifier(bytes.data(), bytes.size());
  if (bytes.size() >= FLATBUFFERS_MAX_BUFFER_SIZE || !format::VerifyRegionSetBuffer(verifier)) {
    throw damaged(name, "it is damaged or cut short");
  }
  set = format::GetRegionSet(bytes.data());
  if (set->version() != kVersion) {
    throw input_error(
        name,
        "is of version " + std::to_string(set->version()) + ", this program reads version " + std::to_string(kVersion),
        "bake it again");
  }
  const RegionFileHead head = head_of(*set);
  if (kSums && set->check() != check_of(head, {bytes_of(set->hull()), bytes_of(set->triangles()),
                                               bytes_of(set->sides()), bytes_of(set->regions())})) {
    throw damaged(name, "its head is damaged");
  }
  const bool finite = std::isfinite(head.centre[0]) && std::isfinite(head.centre[1]) && std::isfinite(head.centre[2]);
  if (!finite || !(head.radius > 0) || !std::isfinite(head.radius) || !(head.depth_distance >= 0)) {
    throw damaged(name, "its head makes no sense");
  }
  frame = {{head.centre[0], head.centre[1], head.centre[2]}, head.radius};
  space = space_of(*set);
  check(space, name.c_str());
  if (region_count(space) != set->regions()->size()) throw damaged(name, "regions are missing");
  verify_table();
  unpack_mesh();
}

void RegionFile::State::verify_table() const {
  std::uint64_t first = 0;
  const std::uint64_t most = std::uint64_t{set->mesh_triangles()} * 2;
  for (const format::Region* region : *set->regions()) {
    if (region->first() != first) throw damaged(name, "its table of regions makes no sense");
    first += size_of(*region);
    if (!possible(region->matte_front()) || !possible(region->depth_front()) || region->silhouette() > most ||
        region->hidden() > most || region->colour() > set->mesh_triangles()) {
      throw damaged(name, "a list can't be as long as it says");
    }
  }
  if (first != set->data()->size()) throw damaged(name, "its regions take more or less than there is");
}

void RegionFile::State::unpack_mesh() {
  const format::List all(set->mesh_triangles(), set->triangles()->size());
  if (all.triangles() == 0 || !possible(all)) throw damaged(name, "its mesh can't be as large as it says");
  append_list(all, bytes_of(set->triangles()), triangles);
  RunReader runs(bytes_of(set->sides()), set->mesh_triangles());
  while (const auto run = runs.next()) sides.insert(sides.end(), run->count, run->value);
  if (!runs.complete()) throw damaged(name, "its mesh can't be unpacked");
}

std::span<const std::uint8_t> RegionFile::State::sound_data_of(const format::Region& region) const {
  const auto data = bytes_of(set->data()).subspan(region.first(), size_of(region));
  if (kSums && check_of(data) != region.check()) throw damaged(name, "a region is damaged");
  return data;
}

void RegionFile::State::append_list(const format::List& list, std::span<const std::uint8_t> bytes,
                                    std::vector<std::uint32_t>& out) const {
  if (list.triangles() == 0) return;
  const std::size_t first = out.size();
  const std::size_t count = std::size_t{list.triangles()} * 3;
  out.resize(first + count);
  if (meshopt_decodeIndexBuffer(&out[first], count, sizeof(std::uint32_t), bytes.data(), bytes.size()) != 0) {
    throw damaged(name, "a list can't be unpacked");
  }
  if (*std::max_element(out.begin() + static_cast<std::ptrdiff_t>(first), out.end()) >= set->points()) {
    throw damaged(name, "a list has points that the mesh has not");
  }
}

/// Appends the triangles of a run, two-sided ones in both windings.
void RegionFile::State::append_role(const RunReader::Run& run, std::vector<std::uint32_t>& out) const {
  for (std::size_t t = run.first; t < std::size_t{run.first} + run.count; ++t) {
    const std::uint32_t* v = &triangles[t * 3];
    out.insert(out.end(), v, v + 3);
    if (sides[t] & kTwoSided) out.insert(out.end(), {v[0], v[2], v[1]});
  }
}

RegionFile::RegionFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
RegionFile::RegionFile(RegionFile&&) noexcept = default;
RegionFile& RegionFile::operator=(RegionFile&&) noexcept = default;
RegionFile::~RegionFile() = default;

RegionFile RegionFile::open(const std::filesystem::path& path) {
  auto state = std::make_unique<State>();
  state->name = path.string();
  state->mapped = MappedFile(path);
  state->verify(state->mapped.bytes());
  return RegionFile(std::move(state));
}

RegionFile RegionFile::from_memory(std::vector<std::uint8_t> bytes, std::string name) {
  auto state = std::make_unique<State>();
  state->name = std::move(name);
  state->memory = std::move(bytes);
  state->verify(state->memory);
  return RegionFile(std::move(state));
}

void RegionFile::must_belong_to(const Surface& surface) const {
  if (mesh_hash() == surface.hash && points() == surface.points.size() &&
      mesh_triangles() == surface.triangles.size()) {
    return;
  }
  throw input_error(state_->name, "was baked from another mesh", "bake it again from this one");
}

const std::string& RegionFile::name() const { return state_->name; }
const ViewSpace& RegionFile::space() const { return state_->space; }
std::uint32_t RegionFile::regions() const { return state_->set->regions()->size(); }
std::uint64_t RegionFile::mesh_hash() const { return state_->set->mesh_hash(); }
std::uint32_t RegionFile::points() const { return state_->set->points(); }
std::uint32_t RegionFile::mesh_triangles() const { return state_->set->mesh_triangles(); }
std::uint64_t RegionFile::full_triangles() const { return state_->set->full_triangles(); }
const UnitFrame& RegionFile::frame() const { return state_->frame; }
double RegionFile::depth_distance() const { return state_->set->depth_distance(); }
std::uint64_t RegionFile::bytes() const {
  return state_->memory.empty() ? state_->mapped.bytes().size() : state_->memory.size();
}

std::uint32_t RegionFile::triangles(std::uint32_t region, Product product) const {
  const format::Region& r = state_->region(region);
  switch (product) {
    case Product::Matte:
      return r.silhouette() + r.matte_front().triangles();
    case Product::Depth:
      return r.silhouette() + r.hidden() + r.depth_front().triangles();
    case Product::Colour:
      break;
  }
  return r.colour();
}

void RegionFile::decode(std::uint32_t region, Product product, std::vector<std::uint32_t>& out) const {
  out.clear();
  const bool depth = product == Product::Depth;
  if (depth && !has_depth()) {
    throw input_error(state_->name, "has no lists for depth", "bake it again with a depth distance");
  }
  const format::Region& r = state_->region(region);
  const auto data = state_->sound_data_of(r);
  out.reserve(std::size_t{triangles(region, product)} * 3);
  RunReader runs(data.first(r.role_bytes()), mesh_triangles());
  while (const auto run = runs.next()) {
    const Role role{run->value};
    if (role == Role::Silhouette || (depth && role == Role::Hidden)) state_->append_role(*run, out);
  }
  if (!runs.complete()) throw damaged(state_->name, "a region can't be unpacked");
  const auto fronts = data.subspan(r.role_bytes());
  const std::size_t matte_bytes = r.matte_front().bytes();
  state_->append_list(depth ? r.depth_front() : r.matte_front(),
                      depth ? fronts.subspan(matte_bytes) : fronts.first(matte_bytes), out);
  if (out.size() != std::size_t{triangles(region, product)} * 3) {
    throw damaged(state_->name, "a list is not as long as it says");
  }
}

void RegionFile::decode_roles(std::uint32_t region, std::vector<Role>& out) const {
  out.clear();
  out.reserve(mesh_triangles());
  const format::Region& r = state_->region(region);
  RunReader runs(state_->sound_data_of(r).first(r.role_bytes()), mesh_triangles());
  while (const auto run = runs.next()) out.insert(out.end(), run->count, Role{run->value});
  if (!runs.complete()) throw damaged(state_->name, "a region can't be unpacked");
}

void RegionFile::decode_colour(std::uint32_t region, std::span<const glm::uvec3> mesh,
                               std::vector<std::uint32_t>& out) const {
  out.clear();
  if (mesh.size() != mesh_triangles()) {
    throw input_error(state_->name, "was baked from another mesh", "bake it again from this one");
  }
  const format::Region& r = state_->region(region);
  const auto data = state_->sound_data_of(r);
  out.reserve(std::size_t{r.colour()} * 3);
  RunReader runs(data.first(r.role_bytes()), mesh_triangles());
  while (const auto run = runs.next()) {
    for (std::size_t t = run->first; t < std::size_t{run->first} + run->count; ++t) {
      if (Role{run->value} == Role::Dropped && !(state_->sides[t] & kFromBehind)) continue;
      out.insert(out.end(), {mesh[t].x, mesh[t].y, mesh[t].z});
    }
  }
  if (!runs.complete() || out.size() != std::size_t{r.colour()} * 3) {
    throw damaged(state_->name, "a region can't be unpacked");
  }
}

}  // namespace rinkaku::silhouette

#include "silhouette/region_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include <meshoptimizer.h>

#include "pipeline/frame/error.h"
#include "silhouette/mapped_file.h"
#include "silhouette/region_check.h"

namespace rinkaku::silhouette {
namespace {

// A fuzzer can't guess sums; without them it gets at what lies behind.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool kSums = false;
#else
constexpr bool kSums = true;
#endif

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

/// The lists of a region, in the order their bytes lie.
std::array<format::List, 7> lists_of(const format::Region& region) {
  return {region.silhouette(),  region.silhouette_two_sided(), region.hidden(), region.hidden_two_sided(),
          region.matte_front(), region.depth_front(),          region.colour()};
}
constexpr std::size_t kColour = 6;

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

  void verify(std::span<const std::uint8_t> bytes);
  void verify_table() const;
  std::span<const std::uint8_t> data_of(const format::Region& region) const;
  std::span<const std::uint8_t> sound_data_of(std::uint32_t region) const;
  void append(const format::List& list, std::span<const std::uint8_t> bytes, bool both_windings,
              std::vector<std::uint32_t>& out) const;
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
  if (kSums && set->check() != check_of(head, bytes_of(set->hull()), bytes_of(set->regions()))) {
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
}

void RegionFile::State::verify_table() const {
  std::uint64_t first = 0;
  for (const format::Region* region : *set->regions()) {
    if (region->first() != first) throw damaged(name, "its table of regions makes no sense");
    const auto lists = lists_of(*region);
    for (std::size_t i = 0; i < lists.size(); ++i) {
      first += lists[i].bytes();
      if (i != kColour && !possible(lists[i])) throw damaged(name, "a list can't be as long as it says");
    }
    const std::uint64_t marks = (std::uint64_t{set->mesh_triangles()} + 7) / 8;
    if (lists[kColour].bytes() != marks || lists[kColour].triangles() > set->mesh_triangles()) {
      throw damaged(name, "a list is not as long as the mesh");
    }
  }
  if (first != set->data()->size()) throw damaged(name, "its regions take more or less than there is");
}

std::span<const std::uint8_t> RegionFile::State::data_of(const format::Region& region) const {
  std::uint64_t size = 0;
  for (const format::List& list : lists_of(region)) size += list.bytes();
  return std::span(set->data()->data(), set->data()->size()).subspan(region.first(), size);
}

std::span<const std::uint8_t> RegionFile::State::sound_data_of(std::uint32_t index) const {
  const format::Region& region = *set->regions()->Get(index);
  const auto data = data_of(region);
  if (kSums && check_of(data) != region.check()) throw damaged(name, "a region is damaged");
  return data;
}

void RegionFile::State::append(const format::List& list, std::span<const std::uint8_t> bytes, bool both_windings,
                               std::vector<std::uint32_t>& out) const {
  if (list.triangles() == 0) return;
  const std::size_t first = out.size();
  const std::size_t count = std::size_t{list.triangles()} * 3;
  out.resize(first + count * (both_windings ? 2 : 1));
  if (meshopt_decodeIndexBuffer(&out[first], count, sizeof(std::uint32_t), bytes.data(), bytes.size()) != 0) {
    throw damaged(name, "a list can't be unpacked");
  }
  const auto decoded = std::span(out).subspan(first, count);
  if (*std::max_element(decoded.begin(), decoded.end()) >= set->points()) {
    throw damaged(name, "a list has points that the mesh has not");
  }
  if (!both_windings) return;
  for (std::size_t i = 0; i < count; i += 3) {
    out[first + count + i] = out[first + i];
    out[first + count + i + 1] = out[first + i + 2];
    out[first + count + i + 2] = out[first + i + 1];
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
  const format::Region& r = *state_->set->regions()->Get(region);
  const std::uint32_t seen = r.silhouette().triangles() + 2 * r.silhouette_two_sided().triangles();
  switch (product) {
    case Product::Matte:
      return seen + r.matte_front().triangles();
    case Product::Depth:
      return seen + r.hidden().triangles() + 2 * r.hidden_two_sided().triangles() + r.depth_front().triangles();
    case Product::Colour:
      break;
  }
  return r.colour().triangles();
}

void RegionFile::decode(std::uint32_t region, Product product, std::vector<std::uint32_t>& out) const {
  out.clear();
  const bool depth = product == Product::Depth;
  if (depth && !has_depth()) {
    throw input_error(state_->name, "has no lists for depth", "bake it again with a depth distance");
  }
  std::span<const std::uint8_t> rest = state_->sound_data_of(region);
  const auto lists = lists_of(*state_->set->regions()->Get(region));
  const std::array<bool, 7> wanted{true, true, depth, depth, !depth, depth, false};
  for (std::size_t i = 0; i < lists.size(); ++i) {
    if (wanted[i]) state_->append(lists[i], rest.first(lists[i].bytes()), i == 1 || i == 3, out);
    rest = rest.subspan(lists[i].bytes());
  }
}

void RegionFile::decode_colour(std::uint32_t region, std::span<const glm::uvec3> triangles,
                               std::vector<std::uint32_t>& out) const {
  out.clear();
  if (triangles.size() != mesh_triangles()) {
    throw input_error(state_->name, "was baked from another mesh", "bake it again from this one");
  }
  const auto marks =
      state_->sound_data_of(region).last(lists_of(*state_->set->regions()->Get(region))[kColour].bytes());
  for (std::size_t byte = 0; byte < marks.size(); ++byte) {
    for (unsigned rest = marks[byte]; rest != 0; rest &= rest - 1) {
      const std::size_t t = byte * 8 + static_cast<std::size_t>(std::countr_zero(rest));
      if (t >= triangles.size()) throw damaged(state_->name, "a list has triangles that the mesh has not");
      out.insert(out.end(), {triangles[t].x, triangles[t].y, triangles[t].z});
    }
  }
}

}  // namespace rinkaku::silhouette

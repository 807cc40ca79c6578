#include "silhouette/region_pack.h"

#include <algorithm>
#include <bit>

#include <meshoptimizer.h>

#include "pipeline/frame/error.h"
#include "silhouette/region_check.h"
#include "silhouette/region_file.h"

namespace rinkaku::silhouette {
namespace {

bool is_reversed_copy(const glm::uvec3& a, const glm::uvec3& b) { return a.x == b.x && a.y == b.z && a.z == b.y; }

format::List list_of(const PackedRegion& region, PackedRegion::List list) {
  return {region.triangles[list], region.bytes[list]};
}

template <typename T>
std::span<const std::uint8_t> bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace

void RegionPacker::split_windings(std::span<const glm::uvec3> triangles) {
  single_.clear();
  both_.clear();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const glm::uvec3& t = triangles[i];
    const bool both = i + 1 < triangles.size() && is_reversed_copy(t, triangles[i + 1]);
    auto& list = both ? both_ : single_;
    list.insert(list.end(), {t.x, t.y, t.z});
    if (both) ++i;
  }
}

void RegionPacker::add_list(PackedRegion& out, PackedRegion::List list) {
  out.triangles[list] = static_cast<std::uint32_t>(indices_.size() / 3);
  if (indices_.empty()) return;
  ordered_.resize(indices_.size());
  meshopt_optimizeVertexCacheStrip(ordered_.data(), indices_.data(), indices_.size(), points_);
  const std::size_t first = out.data.size();
  out.data.resize(first + meshopt_encodeIndexBufferBound(indices_.size(), points_));
  const std::size_t size =
      meshopt_encodeIndexBuffer(&out.data[first], out.data.size() - first, ordered_.data(), ordered_.size());
  out.data.resize(first + size);
  out.bytes[list] = static_cast<std::uint32_t>(size);
}

PackedRegion RegionPacker::pack(const RegionMeshes& meshes) {
  PackedRegion out;
  const auto add_both = [&](const std::vector<glm::uvec3>& triangles, PackedRegion::List single,
                            PackedRegion::List both) {
    split_windings(triangles);
    indices_.swap(single_);
    add_list(out, single);
    indices_.swap(both_);
    add_list(out, both);
  };
  const auto add_front = [&](const std::vector<glm::uvec3>& triangles, PackedRegion::List list) {
    indices_.clear();
    for (const glm::uvec3& t : triangles) indices_.insert(indices_.end(), {t.x, t.y, t.z});
    add_list(out, list);
  };
  add_both(meshes.silhouette, PackedRegion::kSilhouette, PackedRegion::kSilhouetteTwoSided);
  add_both(meshes.hidden, PackedRegion::kHidden, PackedRegion::kHiddenTwoSided);
  add_front(meshes.matte_front, PackedRegion::kMatteFront);
  add_front(meshes.depth_front, PackedRegion::kDepthFront);

  for (const std::uint8_t byte : meshes.colour) {
    out.triangles[PackedRegion::kColour] += static_cast<std::uint32_t>(std::popcount(byte));
  }
  out.bytes[PackedRegion::kColour] = static_cast<std::uint32_t>(meshes.colour.size());
  out.data.insert(out.data.end(), meshes.colour.begin(), meshes.colour.end());
  out.data.shrink_to_fit();
  return out;
}

std::vector<std::uint8_t> region_file_bytes(const Surface& surface, const ViewSpace& space, double depth_distance,
                                            std::span<const PackedRegion> regions) {
  RegionFileHead head;
  head.mesh_hash = surface.hash;
  head.points = static_cast<std::uint32_t>(surface.points.size());
  head.mesh_triangles = static_cast<std::uint32_t>(surface.triangles.size());
  head.full_triangles = surface.triangles.size() + surface.treatment.two_sided_triangles;
  for (int i = 0; i < 3; ++i) head.centre[i] = surface.frame.centre[i];
  head.radius = surface.frame.radius;
  head.depth_distance = depth_distance;
  std::vector<format::Vec4> hull;
  if (const auto* layout = std::get_if<RegionLayout>(&space)) {
    head.cells = static_cast<std::uint64_t>(layout->cells);
    head.shells = static_cast<std::uint64_t>(layout->shells);
    head.inner_radii = layout->inner_radii;
  } else {
    for (const glm::dvec4& h : std::get<ViewRegion>(space).hull) hull.emplace_back(h.x, h.y, h.z, h.w);
  }

  std::vector<format::Region> table;
  std::uint64_t total = 0;
  for (const PackedRegion& r : regions) {
    table.emplace_back(total, check_of(r.data), list_of(r, PackedRegion::kSilhouette),
                       list_of(r, PackedRegion::kSilhouetteTwoSided), list_of(r, PackedRegion::kHidden),
                       list_of(r, PackedRegion::kHiddenTwoSided), list_of(r, PackedRegion::kMatteFront),
                       list_of(r, PackedRegion::kDepthFront), list_of(r, PackedRegion::kColour));
    total += r.data.size();
  }
  constexpr std::uint64_t kMost = 2'000'000'000;
  if (total + table.size() * sizeof(format::Region) > kMost) {
    throw input_error("bake", "the regions take more than 2 GB", "choose fewer cells or shells");
  }

  flatbuffers::FlatBufferBuilder builder(total + 65536);
  std::uint8_t* data = nullptr;
  const auto data_at = builder.CreateUninitializedVector(total, &data);
  for (const PackedRegion& r : regions) data = std::copy(r.data.begin(), r.data.end(), data);
  const auto table_at = builder.CreateVectorOfStructs(table);
  const auto hull_at = hull.empty() ? 0 : builder.CreateVectorOfStructs(hull);
  const format::Vec3 centre(head.centre[0], head.centre[1], head.centre[2]);
  const auto root = format::CreateRegionSet(
      builder, RegionFile::kVersion, head.mesh_hash, head.points, head.mesh_triangles, head.full_triangles, &centre,
      head.radius, static_cast<std::uint32_t>(head.cells), static_cast<std::uint32_t>(head.shells), head.inner_radii,
      hull_at, head.depth_distance, table_at, data_at, check_of(head, bytes_of(hull), bytes_of(table)));
  format::FinishRegionSetBuffer(builder, root);
  return {builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize()};
}

}  // namespace rinkaku::silhouette

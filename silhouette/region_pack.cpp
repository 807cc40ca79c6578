#include "silhouette/region_pack.h"

#include <algorithm>

#include <meshoptimizer.h>

#include "pipeline/frame/error.h"
#include "silhouette/region_check.h"
#include "silhouette/region_file.h"
#include "silhouette/value_runs.h"

namespace rinkaku::silhouette {
namespace {

template <typename T>
std::span<const std::uint8_t> bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)};
}

/// Appends an index list in the order it has; returns its bytes.
std::uint32_t append_encoded(const std::vector<std::uint32_t>& indices, std::size_t points,
                             std::vector<std::uint8_t>& data) {
  const std::size_t first = data.size();
  data.resize(first + meshopt_encodeIndexBufferBound(indices.size(), points));
  const std::size_t size = meshopt_encodeIndexBuffer(&data[first], data.size() - first, indices.data(), indices.size());
  data.resize(first + size);
  return static_cast<std::uint32_t>(size);
}

std::vector<std::uint8_t> encoded_triangles(const Surface& surface) {
  std::vector<std::uint32_t> indices;
  indices.reserve(surface.triangles.size() * 3);
  for (const glm::uvec3& t : surface.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
  std::vector<std::uint8_t> out;
  append_encoded(indices, surface.points.size(), out);
  return out;
}

std::vector<std::uint8_t> encoded_sides(const Surface& surface) {
  std::vector<std::uint8_t> sides(surface.triangles.size());
  for (std::size_t t = 0; t < sides.size(); ++t) {
    sides[t] = static_cast<std::uint8_t>((surface.two_sided[t] ? 1 : 0) | (surface.drawn_from_behind[t] ? 2 : 0));
  }
  std::vector<std::uint8_t> out;
  append_runs(sides, out);
  return out;
}

}  // namespace

std::uint32_t RegionPacker::append_front(const std::vector<glm::uvec3>& triangles, std::vector<std::uint8_t>& data) {
  if (triangles.empty()) return 0;
  indices_.clear();
  for (const glm::uvec3& t : triangles) indices_.insert(indices_.end(), {t.x, t.y, t.z});
  ordered_.resize(indices_.size());
  meshopt_optimizeVertexCacheStrip(ordered_.data(), indices_.data(), indices_.size(), surface_.points.size());
  return append_encoded(ordered_, surface_.points.size(), data);
}

PackedRegion RegionPacker::pack(const RegionMeshes& meshes) {
  PackedRegion out;
  static_assert(sizeof(Role) == 1);
  append_runs({reinterpret_cast<const std::uint8_t*>(meshes.roles.data()), meshes.roles.size()}, out.data);
  out.role_bytes = static_cast<std::uint32_t>(out.data.size());
  out.silhouette = meshes.silhouette;
  out.hidden = meshes.hidden;
  for (std::size_t t = 0; t < meshes.roles.size(); ++t) out.colour += can_show(surface_, meshes, t) ? 1 : 0;
  out.matte_front = static_cast<std::uint32_t>(meshes.matte_front.size());
  out.matte_front_bytes = append_front(meshes.matte_front, out.data);
  out.depth_front = static_cast<std::uint32_t>(meshes.depth_front.size());
  out.depth_front_bytes = append_front(meshes.depth_front, out.data);
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
    table.emplace_back(total, check_of(r.data), r.role_bytes, r.silhouette, r.hidden, r.colour,
                       format::List(r.matte_front, r.matte_front_bytes),
                       format::List(r.depth_front, r.depth_front_bytes));
    total += r.data.size();
  }
  constexpr std::uint64_t kMost = 2'000'000'000;
  if (total + table.size() * sizeof(format::Region) > kMost) {
    throw input_error("bake", "the regions take more than 2 GB", "choose fewer cells or shells");
  }

  flatbuffers::FlatBufferBuilder builder(total + surface.triangles.size() * 4 + 65536);
  std::uint8_t* data = nullptr;
  const auto data_at = builder.CreateUninitializedVector(total, &data);
  for (const PackedRegion& r : regions) data = std::copy(r.data.begin(), r.data.end(), data);
  const std::vector<std::uint8_t> triangles = encoded_triangles(surface);
  const std::vector<std::uint8_t> sides = encoded_sides(surface);
  const auto triangles_at = builder.CreateVector(triangles);
  const auto sides_at = builder.CreateVector(sides);
  const auto table_at = builder.CreateVectorOfStructs(table);
  const auto hull_at = hull.empty() ? 0 : builder.CreateVectorOfStructs(hull);
  const format::Vec3 centre(head.centre[0], head.centre[1], head.centre[2]);
  const auto root = format::CreateRegionSet(
      builder, RegionFile::kVersion, head.mesh_hash, head.points, head.mesh_triangles, head.full_triangles, &centre,
      head.radius, static_cast<std::uint32_t>(head.cells), static_cast<std::uint32_t>(head.shells), head.inner_radii,
      hull_at, head.depth_distance, triangles_at, sides_at, table_at, data_at,
      check_of(head, {bytes_of(hull), triangles, sides, bytes_of(table)}));
  format::FinishRegionSetBuffer(builder, root);
  return {builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize()};
}

}  // namespace rinkaku::silhouette

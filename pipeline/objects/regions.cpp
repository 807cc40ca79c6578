#include "pipeline/objects/regions.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "mesh/topology.h"
#include "silhouette/region_cache.h"
#include "silhouette/region_faces.h"
#include "silhouette/region_lists.h"

namespace rinkaku::pipeline {
namespace {

using silhouette::Product;
using silhouette::RegionFile;

// The depth product's distance from the surface, in radii: under a pixel for an object of 700 pixels.
constexpr double depth_distance = 0.0015;

std::array<glm::dvec3, 8> corners(const PlacedBox& placed) {
  std::array<glm::dvec3, 8> all;
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 corner(i & 1 ? placed.box.max.x : placed.box.min.x, i & 2 ? placed.box.max.y : placed.box.min.y,
                           i & 4 ? placed.box.max.z : placed.box.min.z);
    all[static_cast<std::size_t>(i)] = glm::dvec3(placed.world_from_object * glm::dvec4(corner, 1));
  }
  return all;
}

struct Range {
  double low, high;
};

Range along(const glm::dvec3& axis, const std::array<glm::dvec3, 8>& points) {
  Range range{glm::dot(axis, points[0]), glm::dot(axis, points[0])};
  for (const glm::dvec3& p : points) {
    range.low = std::min(range.low, glm::dot(axis, p));
    range.high = std::max(range.high, glm::dot(axis, p));
  }
  return range;
}

silhouette::BakeOptions bake_options(RegionUse use) {
  silhouette::BakeOptions options;
  if (use == RegionUse::Cover) options.reduce.depth_distance = depth_distance;
  return options;
}

bool is_there(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

// None if baking was stopped.
std::optional<RegionFile> read_or_bake(const ObjectScene& object, const silhouette::Surface& surface,
                                       const RegionOptions& options) {
  const std::filesystem::path& file = object.regions->file;
  if (!file.empty() && is_there(file)) {
    RegionFile read = RegionFile::open(file);
    read.must_belong_to(surface);
    return read;
  }
  const silhouette::BakeOptions baking = bake_options(region_use(object));
  if (auto found = silhouette::find_cached_regions(surface, baking)) return found;
  if (options.tell) {
    const std::string missing = file.empty() ? "" : file.filename().string() + " is not there; ";
    options.tell(object.name + ": " + missing + "its regions are baked, once, into " +
                 silhouette::region_cache_folder().string());
  }
  return silhouette::cached_regions(surface, baking, {}, options.stop);
}

bool is_opaque(const mesh::Mesh& mesh) {
  return std::all_of(mesh.materials.begin(), mesh.materials.end(),
                     [](const mesh::Material& m) { return m.alpha == mesh::Material::Alpha::Opaque; });
}

// Region lists index welded points, what is drawn has the mesh's vertices: per point one of them.
std::vector<std::uint32_t> vertex_of_points(const mesh::Mesh& mesh) {
  std::vector<std::uint32_t> vertex(mesh.point_count, 0);
  for (std::size_t v = mesh.welded.size(); v-- > 0;) vertex[mesh.welded[v]] = static_cast<std::uint32_t>(v);
  return vertex;
}

}  // namespace

bool are_apart(const PlacedBox& a, const PlacedBox& b) {
  constexpr double air = 0.01;
  const auto corners_a = corners(a), corners_b = corners(b);
  std::vector<glm::dvec3> axes;
  const auto edges = [](const std::array<glm::dvec3, 8>& c) {
    return std::array<glm::dvec3, 3>{c[1] - c[0], c[2] - c[0], c[4] - c[0]};
  };
  const auto edges_a = edges(corners_a), edges_b = edges(corners_b);
  for (const auto& e : {edges_a, edges_b}) {
    for (int k = 0; k < 3; ++k) axes.push_back(glm::cross(e[(k + 1) % 3], e[(k + 2) % 3]));
  }
  for (const glm::dvec3& along_a : edges_a) {
    for (const glm::dvec3& along_b : edges_b) axes.push_back(glm::cross(along_a, along_b));
  }
  return std::any_of(axes.begin(), axes.end(), [&](const glm::dvec3& axis) {
    const Range in_a = along(axis, corners_a), in_b = along(axis, corners_b);
    const double gap = std::max(in_a.low - in_b.high, in_b.low - in_a.high);
    return gap > air * (in_a.high - in_a.low + in_b.high - in_b.low);
  });
}

passes::RegionKnowledge region_knowledge(const ObjectScene& object, const mesh::Mesh& mesh, bool apart,
                                         const RegionOptions& options) {
  const mesh::Topology topology = mesh::topology(mesh);
  const silhouette::Surface surface = silhouette::make_surface(mesh, topology);
  auto read = read_or_bake(object, surface, options);
  if (!read) return {};
  const auto file = std::make_shared<const RegionFile>(std::move(*read));
  passes::RegionKnowledge known;
  const auto faces = std::make_shared<silhouette::RegionFaces>(file, topology);
  known.faces = [faces](const glm::dvec3& eye) { return faces->at(eye); };
  const bool shows_as_one = object.holdout || is_opaque(mesh);
  if (region_use(object) != RegionUse::Cover || !shows_as_one) return known;
  if (!apart && !file->has_depth()) {
    if (options.tell) {
      options.tell(file->name() + ": has no lists for depth, which " + object.name +
                   " needs beside objects so near; its surface is drawn whole (bake it with --depth)");
    }
    return known;
  }
  const auto decode = [product = apart ? Product::Matte : Product::Depth, vertex = vertex_of_points(mesh)](
                          const RegionFile& of, std::uint32_t region, std::vector<std::uint32_t>& out) {
    of.decode(region, product, out);
    for (std::uint32_t& index : out) index = vertex[index];
  };
  silhouette::RegionListsOptions to_draw;
  to_draw.decode_at_once = options.wait_for_lists;
  const auto lists = std::make_shared<silhouette::RegionLists>(file, decode, to_draw);
  known.least_px_per_unit = silhouette::least_radius_px(surface) / surface.frame.radius;
  known.cover = [lists](const glm::dvec3& eye) { return lists->at(eye).indices; };
  return known;
}

}  // namespace rinkaku::pipeline

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "silhouette/reduce.h"
#include "silhouette/surface.h"
#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

/// What a region's lists are for (see RegionMeshes).
enum class Product : std::uint8_t { Matte, Depth, Colour };

/// A baked file (.rgn): the lists of every region of a mesh, compressed.
///
/// Memory-mapped; everything in it is verified before it is used, so no file can do more harm than be refused.
/// Immutable: threads may share one.
class RegionFile {
 public:
  /// The layout of the file that this program writes and reads.
  static constexpr std::uint32_t kVersion = 1;

  /// Throws Error (Input), one line naming the file, if it can't be read, is no region file, is of another version,
  /// damaged or truncated. Cost: about 10 ns a triangle of the mesh.
  static RegionFile open(const std::filesystem::path& path);
  /// The same from memory; `name` stands for the file in messages.
  static RegionFile from_memory(std::vector<std::uint8_t> bytes, std::string name);

  RegionFile(RegionFile&&) noexcept;
  RegionFile& operator=(RegionFile&&) noexcept;
  ~RegionFile();

  /// Throws Error (Input) if the file was baked from another mesh.
  void must_belong_to(const Surface& surface) const;

  const std::string& name() const;
  const ViewSpace& space() const;
  std::uint32_t regions() const;
  std::uint64_t mesh_hash() const;
  std::uint32_t points() const;          ///< of the mesh
  std::uint32_t mesh_triangles() const;  ///< without reversed copies
  std::uint64_t full_triangles() const;  ///< as drawn whole, with reversed copies
  const UnitFrame& frame() const;
  bool has_depth() const { return depth_distance() > 0; }
  double depth_distance() const;  ///< in radii; 0: no depth product
  std::uint64_t bytes() const;

  /// How many triangles decode() gives. Colour: those of the mesh that can show.
  std::uint32_t triangles(std::uint32_t region, Product product) const;

  /// Decodes a region's matte or depth list: indices of the surface's points, to be drawn with back faces culled.
  /// `out` is overwritten and keeps its capacity. Every index is below points().
  /// Throws Error (Input) naming the file if the region is damaged, or if it has no such product.
  /// Preconditions: region < regions(); product is not Colour. Cost: about 5 ns a
  /// triangle of the list, 1 ns one of the mesh; allocates nothing if `out` has the capacity.
  void decode(std::uint32_t region, Product product, std::vector<std::uint32_t>& out) const;

  /// Gives each triangle's role in a region, in the surface's order. Throws as decode().
  void decode_roles(std::uint32_t region, std::vector<Role>& out) const;

  /// Gives the triangles of the mesh that can show in a region, as indices of the mesh's own vertices in the mesh's
  /// order. Precondition: `mesh` are the triangles of the mesh that the file belongs to. Throws as decode().
  void decode_colour(std::uint32_t region, std::span<const glm::uvec3> triangles,
                     std::vector<std::uint32_t>& out) const;

 private:
  struct State;
  explicit RegionFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace rinkaku::silhouette

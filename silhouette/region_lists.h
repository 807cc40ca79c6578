#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "silhouette/region_file.h"

namespace rinkaku::silhouette {

struct RegionListsOptions {
  Product product = Product::Matte;
  int kept = 8;                 ///< decoded lists kept, the least recently used one goes first; at least 4
  bool decode_at_once = false;  ///< decode a missing list in at() instead of drawing the whole mesh meanwhile
  bool decode_ahead = true;     ///< decode the regions the eye is heading for
};

/// What to draw this frame.
struct RegionList {
  /// Index list, see RegionFile::decode() and decode_colour(). Empty and `whole`: draw the whole mesh.
  std::span<const std::uint32_t> indices;
  bool whole = true;
  std::uint32_t region = 0;  ///< of `indices`
  /// Differs from the last frame's if the list does, so that it must be uploaded; 0 for the whole mesh.
  std::uint64_t serial = 0;
};

/// Follows an eye through a file's regions, frame after frame, without stalling it: lists are decoded by a thread of
/// its own, the next likely one ahead; while one is missing the whole mesh is drawn, which covers the same pixels.
///
/// One calling thread. Allocates nothing once the lists have grown to their sizes.
class RegionLists {
 public:
  /// For Product::Colour, `triangles` are the mesh's (they must outlive this), else empty.
  /// Throws Error (Input) if the file has no such product.
  RegionLists(std::shared_ptr<const RegionFile> file, const RegionListsOptions& options = {},
              std::span<const glm::uvec3> triangles = {});

  /// Makes what is to be known of a region, in place of its list: whatever fits into numbers. `out` keeps its capacity.
  /// Called on this object's own thread, and once in the constructor; what it throws is thrown by at().
  using Make = std::function<void(const RegionFile& file, std::uint32_t region, std::vector<std::uint32_t>& out)>;
  /// `options.product` is not read.
  RegionLists(std::shared_ptr<const RegionFile> file, Make make, const RegionListsOptions& options = {});
  ~RegionLists();
  RegionLists(const RegionLists&) = delete;
  RegionLists& operator=(const RegionLists&) = delete;

  /// The list for an eye in the mesh's own coordinates. Inside the inner radius, outside an explicit region, and for an
  /// eye that is not finite: the whole mesh. The indices stay valid until the next call.
  /// Throws what the decoding thread met (a damaged region). Cost: under a microsecond, without `decode_at_once`.
  RegionList at(const glm::dvec3& eye_in_mesh);

  /// Waits until everything asked for is decoded: for tests and for rendering to files, where every frame should use
  /// its region.
  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rinkaku::silhouette

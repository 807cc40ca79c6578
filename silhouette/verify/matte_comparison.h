#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/gl/target.h"
#include "silhouette/pass/matte_pass.h"
#include "silhouette/surface.h"
#include "silhouette/verify/check_views.h"
#include "silhouette/verify/draw_clock.h"

namespace rinkaku::silhouette {

/// How a triangle list's matte differs from the whole surface's in one view.
struct MatteDifference {
  std::int64_t mismatch_px = 0;
  bool has_edge = false;  ///< the whole surface's matte has both covered and uncovered pixels
  DrawTime full, other;
};

/// Draws mattes of one surface and compares them. Needs a current GL context.
class MatteComparison {
 public:
  explicit MatteComparison(const Surface& surface);

  const std::vector<std::uint32_t>& full_indices() const { return full_; }

  /// Draws the whole surface and `indices` through one pass, one after the other, and counts differing pixels. The
  /// pictures stay readable in full() and other().
  MatteDifference compare(const CheckView& view, std::span<const std::uint32_t> indices);

  /// One matte, and the time that clearing and drawing took; rows from the top.
  DrawTime draw(const CheckView& view, std::span<const std::uint32_t> indices, std::vector<std::uint8_t>& matte);

  const std::vector<std::uint8_t>& full() const { return full_matte_; }
  const std::vector<std::uint8_t>& other() const { return other_matte_; }

 private:
  std::vector<std::uint32_t> full_;
  MattePass pass_;
  gl::Target target_{gl::Target::Kind::Matte};
  std::vector<std::uint8_t> full_matte_, other_matte_;
};

/// From the object's coordinates to clip space, in double.
glm::dmat4 clip_from_object(const CheckView& view);

}  // namespace rinkaku::silhouette

#pragma once

#include <cstdint>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "pipeline/gl/buffer.h"
#include "pipeline/gl/handle.h"
#include "pipeline/gl/program.h"

namespace rinkaku::silhouette {

/// Draws which pixels an object covers: 1 where a front face lies, 0 elsewhere (Utsugi et al., "A Polygon Reduction
/// maintaining Silhouettes", 2001).
///
/// All triangle lists of an object (whole mesh or any region's) index the same points in one vertex buffer, and run
/// through the same shader with an invariant position, so that a vertex falls on the same spot of the pixel grid
/// whichever list it comes from. Together with what the lists promise, mattes are then equal to the last pixel:
/// docs/silhouette.md has the argument. It needs, and draw() sets: back faces culled, no depth test, no blending, and
/// depth clamped rather than clipped, since a region's list does not keep the surface's depth.
/// Needs a current GL context. Not for several samples a pixel: each sample would have to be compared.
class MattePass {
 public:
  /// `points`: the object's welded points, in its own coordinates.
  explicit MattePass(std::span<const glm::vec3> points);

  /// The triangles to draw from now on: three points each, anticlockwise seen from outside. Costs an upload (about
  /// 0.1 ms for 20,000 triangles): call it when the list changes, not every frame.
  void set_triangles(std::span<const std::uint32_t> indices);

  /// Draws the triangles into the bound MatteTarget. `clip_from_object` may scale unevenly and mirror: which way round
  /// a front face is seen follows from it. Compose it in double; it is rounded once, here.
  void draw(const glm::dmat4& clip_from_object);

 private:
  gl::Program program_;
  GLint clip_from_local_ = -1;
  glm::dvec3 centre_{0};  // vertices are stored relative to it, so a mesh far from its own origin loses nothing
  gl::StaticBuffer vertices_;
  gl::StreamBuffer indices_;
  GLsizei index_count_ = 0;
  gl::VertexArrayHandle array_;
};

}  // namespace rinkaku::silhouette

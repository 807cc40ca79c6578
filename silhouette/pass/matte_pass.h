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
/// maintaining Silhouettes", 2002).
///
/// All triangle lists of an object (whole mesh or any region's) index the same points in one vertex buffer, and run
/// through the same shader with an invariant position, so that a vertex falls on the same spot of the pixel grid
/// whichever list it comes from. Together with what the lists promise, mattes are then equal to the last pixel:
/// docs/silhouette.md has the argument. It needs, and draw() sets: back faces culled, no depth test, no blending, and
/// depth clamped rather than clipped, since a region's list does not keep the surface's depth.
///
/// Culling must not depend on what else is drawn. Mesa's software drivers cull by exact positions where some triangle
/// nearby in the list has to be clipped, else by positions on the pixel grid, and slivers may face the other way there.
/// So where an object may have to be clipped (it is cut by the plane through the eye, or reaches out of the
/// picture), faces are culled in the fragment shader, which always goes by the grid; that takes about half as long
/// again. Needs a current GL context. Not for several samples a pixel: each sample would have to be compared.
class MattePass {
 public:
  /// `points`: the object's welded points, in its own coordinates.
  explicit MattePass(std::span<const glm::vec3> points);

  /// The triangles to draw from now on: three points each, anticlockwise seen from outside. Costs an upload (about
  /// 0.1 ms for 20,000 triangles): call it when the list changes, not every frame.
  void set_triangles(std::span<const std::uint32_t> indices);

  /// Draws the triangles into the bound target (gl::Target, Kind::Matte). `clip_from_object` may scale unevenly and
  /// mirror: which way round a front face is seen follows from it. Compose it in double; it is rounded once, here.
  void draw(const glm::dmat4& clip_from_object);

 private:
  struct Shader {
    explicit Shader(bool cull_per_fragment);
    gl::Program program;
    GLint clip_from_local = -1;
  };
  bool may_be_clipped(const glm::dmat4& clip_from_local) const;

  Shader culled_before_{false};
  Shader culled_per_fragment_{true};
  glm::dvec3 centre_{0};  // vertices are stored relative to it, so a mesh far from its own origin loses nothing
  glm::dvec3 half_size_{0};
  gl::StaticBuffer vertices_;
  gl::StreamBuffer indices_;
  GLsizei index_count_ = 0;
  gl::VertexArrayHandle array_;
};

}  // namespace rinkaku::silhouette

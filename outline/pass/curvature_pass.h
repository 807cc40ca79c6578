#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "outline/face_stars.h"
#include "pipeline/gl/buffer.h"
#include "pipeline/gl/program.h"

namespace rinkaku::outline {

/// CorrectedCurvature on the GPU, for shapes that move there: the same sums in the same order, gathered by point, so
/// the result is the same each time and differs from the CPU's by rounding alone.
///
/// Needs a current GL context (4.3 or later).
class CurvaturePass {
 public:
  /// `rest`: positions in the rest pose, for the scale in which float is safe; poses may be a thousand times larger or
  /// smaller.
  CurvaturePass(const FaceStars& stars, std::span<const glm::vec3> rest);

  /// Computes curvatures and normals of this frame's positions. `points`: a buffer of one vec4 a point (w is not read).
  /// Does not wait. What reads curvatures() or normals() next is told so by a barrier here (shader storage and vertex
  /// attributes).
  void run(GLuint points);

  /// Per point a vec4: mean, Gaussian, largest and smallest principal curvature (see Curvature).
  const gl::StorageBuffer& curvatures() const { return curvatures_; }
  /// Per point a vec4: Max's unit normal, or 0 where there is no area; w is 0.
  const gl::StorageBuffer& normals() const { return normals_; }

  std::size_t point_count() const { return point_count_; }

 private:
  struct Step {
    gl::Program program;
    GLuint groups = 0;
  };
  Step step(std::string_view name, std::string_view text, const char* count_uniform, std::size_t count) const;
  void dispatch(const Step& step) const;

  std::size_t point_count_ = 0;
  float scale_ = 0;
  gl::StaticBuffer faces_, first_, corners_;
  gl::StorageBuffer normals_, measures_, curvatures_;
  Step normals_step_, faces_step_, gather_step_;
};

}  // namespace rinkaku::outline

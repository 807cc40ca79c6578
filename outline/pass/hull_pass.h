#pragma once

#include <glm/vec3.hpp>

#include "pipeline/gl/program.h"
#include "pipeline/passes/offset_uniforms.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::outline {

struct HullOptions {
  float width_px = 3;
  glm::vec3 colour{0.07f, 0.05f, 0.09f};  ///< sRGB-encoded
};

/// Draws a line of even width around an object by its hull: the mesh pushed outwards along welded normals, seen from
/// within (Raskar and Cohen, "Image precision silhouette edges", 1999), its width the same number of pixels at any
/// distance.
///
/// What can be seen of such a hull are the strips between the mesh's contour and the same contour pushed outwards; only
/// those are drawn, so the cost is the contour's, not the mesh's. They are in the depth buffer: a line hides what is
/// behind it, and what is before it hides the line. Neighbouring strips share their ends, pushed along one normal, so a
/// line has no gaps, also at hard edges.
class HullPass : public passes::ObjectPass {
 public:
  HullPass(passes::DrawnObject& object, const HullOptions& options);

  const char* name() const override { return "outline"; }
  double reach_px() const override { return options_.width_px + 1; }
  void draw_surface(const passes::DrawCall&) override {}
  void draw_edges(const passes::DrawCall& call) override;

 private:
  passes::DrawnObject& object_;
  HullOptions options_;
  gl::Program program_;
  passes::OffsetUniforms offset_;
  GLint offset_px_ = -1;
  GLint breadth_px_ = -1;
};

}  // namespace rinkaku::outline

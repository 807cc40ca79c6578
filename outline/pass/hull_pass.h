#pragma once

#include <glm/vec3.hpp>

#include "pipeline/gl/program.h"
#include "pipeline/passes/line_strips.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::outline {

struct HullOptions {
  float width_px = 3;                     ///< at any distance, in the plate; not read if width_m is given
  float width_m = 0;                      ///< above 0: the line is as wide as something of this size at its depth
  float least_px = 0, most_px = 40;       ///< between which width_m stays
  glm::vec3 colour{0.07f, 0.05f, 0.09f};  ///< sRGB-encoded
  passes::LineStyle style{};              ///< read at construction only; its base line is that of these options
};

/// Draws a line around an object by its hull: the mesh pushed outwards along welded normals, seen from within (Raskar
/// and Cohen, "Image precision silhouette edges", 1999), its width a number of pixels or metres, times a factor that
/// varies over the surface (see line_width.h).
///
/// What can be seen of such a hull are the strips between the mesh's contour and the same contour pushed outwards; only
/// those are drawn, so the cost is the contour's, not the mesh's. They are in the depth buffer: a line hides what is
/// behind it, and what is before it hides the line. Neighbouring strips share their ends, so a line has no gaps, also
/// at hard edges, where they end in a miter (passes::LineStrips). Where a line is thinner than a pixel it is fainter
/// instead. What factors above 1 add leans back by three times its width: around the object the line has its whole
/// width, but over a surface close behind, as around a mouth on a face, it adds no more than a third of that step.
class HullPass : public passes::ObjectPass {
 public:
  /// `object` must outlive the pass.
  HullPass(passes::DrawnObject& object, const HullOptions& options);

  const char* name() const override { return "outline"; }
  bool draws_lines() const override { return true; }
  double reach_px(const passes::View& view) const override;
  void draw_surface(const passes::DrawCall&) override {}
  void draw_edges(const passes::DrawCall& call) override;

 private:
  passes::DrawnObject& object_;
  HullOptions options_;
  gl::Program program_;
  GLint clip_from_object_ = -1;
  GLint viewport_px_ = -1;
  GLint width_px_ = -1;
  GLint soft_ = -1;
  GLint beyond_ = -1;
  GLint back_ = -1;
};

}  // namespace rinkaku::outline

#pragma once

#include <optional>

#include "outline/pass/line_look.h"
#include "outline/pass/line_room.h"
#include "pipeline/gl/program.h"
#include "pipeline/passes/line_strips.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::outline {

struct HullOptions {
  LineLook look{};
  float lean = 3;             ///< how steeply it leans back over what lies close behind (LineRoom); 0: not at all
  passes::LineStyle style{};  ///< read at construction only; its width is that of `look`
};

/// Draws a line around an object by its hull: the mesh pushed outwards along welded normals, seen from within (Raskar
/// and Cohen, "Image precision silhouette edges", 1999), its width a number of pixels or metres, times a factor that
/// varies over the surface (see line_width.h).
///
/// What can be seen of such a hull are the strips between the mesh's contour and the same contour pushed outwards; only
/// those are drawn, so the cost is the contour's, not the mesh's. They are in the depth buffer: a line hides what is
/// behind it, and what is before it hides the line. Neighbouring strips share their ends, so a line has no gaps, also
/// at hard edges, where they end in a miter (passes::LineStrips). Where a line is thinner than a pixel it is fainter
/// instead, and over what lies close behind it is narrower (LineRoom).
class HullPass : public passes::ObjectPass {
 public:
  /// `object` must outlive the pass.
  HullPass(passes::DrawnObject& object, const HullOptions& options);

  const char* name() const override { return "outline"; }
  bool draws_lines() const override { return true; }
  double reach_px(const passes::View& view) const override;
  void draw_surface(const passes::DrawCall&) override {}
  void look_behind(const passes::DrawCall& call) override;
  void draw_edges(const passes::DrawCall& call) override;

 private:
  passes::DrawnObject& object_;
  LineLook look_;
  std::optional<LineRoom> room_;
  bool has_looked_ = false;  // behind this frame's lines
  gl::Program program_;
  LineWidthUniforms width_;
  GLint clip_from_object_ = -1;
  GLint viewport_px_ = -1;
  GLint soft_ = -1;
};

}  // namespace rinkaku::outline

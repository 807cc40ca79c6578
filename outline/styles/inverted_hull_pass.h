#pragma once

#include "mesh/mesh.h"
#include "outline/pass/line_look.h"
#include "pipeline/gl/buffer.h"
#include "pipeline/gl/program.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::outline {

/// The uniform hull as it was published: the whole mesh again, every vertex moved outwards along its welded normal, of
/// which only the faces that face away are drawn (Raskar and Cohen, "Image precision silhouette edges", 1999).
///
/// The move is as long as the line's width is at the vertex's depth, so the line is that wide where the surface turns
/// away smoothly, and thinner at hard edges, where the normal is not at right angles to the line of sight. What
/// HullPass draws is without that fault and costs only the contour; this is what others are measured by. The hull's
/// edge fades over a pixel by the contour's strips.
class InvertedHullPass : public passes::ObjectPass {
 public:
  /// `object` must outlive the pass; `mesh` is the object's.
  InvertedHullPass(passes::DrawnObject& object, const mesh::Mesh& mesh, const LineLook& look);

  const char* name() const override { return "inverted hull"; }
  bool draws_lines() const override { return true; }
  double reach_px(const passes::View& view) const override;
  void draw_surface(const passes::DrawCall& call) override;
  void draw_edges(const passes::DrawCall& call) override;

 private:
  void use(const passes::DrawCall& call, bool soft) const;

  passes::DrawnObject& object_;
  LineLook look_;
  gl::StaticBuffer triangles_;
  GLsizei index_count_ = 0;
  gl::Program program_;
  LineWidthUniforms width_;
  GLint clip_from_object_ = -1, focal_px_ = -1, soft_ = -1;
};

}  // namespace rinkaku::outline

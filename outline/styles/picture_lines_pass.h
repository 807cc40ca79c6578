#pragma once

#include "outline/pass/line_look.h"
#include "outline/styles/surface_buffer.h"
#include "pipeline/gl/program.h"
#include "pipeline/gl/texture_target.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::outline {

struct PictureLinesOptions {
  LineLook look{};
  enum class Method {
    /// Steps in depth and bends in the normal between neighbouring samples (Saito and Takahashi, "Comprehensible
    /// rendering of 3-D shapes", 1990; on graphics cards Mitchell, Brennan and Card, 2002).
    DepthNormals,
    /// What the object covers, filled and made larger, behind the object (Kaneko's silhouette method): a line around
    /// the whole, none within.
    Silhouette,
    /// Where the second derivative of the drawn picture is large (Kaneko's edge method): borders of light and of colour
    /// too.
    Laplacian,
  } method = Method::DepthNormals;
  float depth_step_m = 0.01f;  ///< DepthNormals: the least step in depth
  float normal_deg = 25;       ///< DepthNormals: the least angle between normals half a pixel apart
  float contrast = 0.08f;      ///< Laplacian: the least step between colours that count from 0 to 1
};

/// Lines that are found in pictures of the object: its depth and normals, what it covers, or its drawing.
///
/// The object is drawn once more into textures of its own, as large as its rectangle and twice as fine, which are made
/// with the first frame. Edges are placed to a quarter pixel; around each a square is drawn, in which pixels are
/// covered by their distance. Except with Silhouette, lines lie half over the surface, and the pass comes before the
/// body in an object's passes. Cost: the object's triangles again, some 40 texel reads a pixel of its rectangle, and
/// (width + 2)^2 pixels an edge pixel.
class PictureLinesPass : public passes::ObjectPass {
 public:
  /// `object` and `body` must outlive the pass; `body` draws the picture that Laplacian looks at.
  PictureLinesPass(passes::DrawnObject& object, passes::ObjectPass& body, const PictureLinesOptions& options);

  const char* name() const override { return "picture lines"; }
  bool draws_lines() const override { return true; }
  double reach_px(const passes::View& view) const override;
  void draw_surface(const passes::DrawCall&) override {}
  void draw_edges(const passes::DrawCall& call) override;

 private:
  void find(const passes::DrawCall& call, const passes::PixelRect& rect);
  void spread(const passes::PixelRect& rect, double line_px, int reach);

  passes::DrawnObject& object_;
  passes::ObjectPass& body_;
  PictureLinesOptions options_;
  SurfaceBuffer surface_;
  gl::TextureTarget edges_, lines_;
  gl::Program find_, spread_, draw_;
  gl::VertexArrayHandle no_vertices_;
  GLint size_px_ = -1, reach_px_ = -1, radius_px_ = -1, origin_ = -1, strength_ = -1;
  GLint near_m_ = -1;
};

}  // namespace rinkaku::outline

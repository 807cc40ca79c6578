#pragma once

#include "pipeline/gl/program.h"
#include "pipeline/passes/offset_uniforms.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::passes {

/// Draws an object as a hole: CG behind it is cut away along its smooth contour, and the plate shows instead. For a
/// model of a filmed thing that stands where it was filmed (a holdout).
class HoldoutPass : public ObjectPass {
 public:
  /// `object` must outlive the pass.
  explicit HoldoutPass(DrawnObject& object);

  const char* name() const override { return "holdout"; }
  double reach_px(const View&) const override { return 1; }
  bool leaves_colour() const override { return false; }
  void draw_surface(const DrawCall& call) override;
  void draw_edges(const DrawCall& call) override;

 private:
  struct Variant {
    gl::Program program;
    OffsetUniforms offset;
    GLint offset_px = -1, edge_coverage = -1;
  };
  static Variant make(bool feather);
  static void use(const Variant& variant, const DrawCall& call, float overlap_px);

  DrawnObject& object_;
  Variant surface_, feather_;
};

}  // namespace rinkaku::passes

#pragma once

#include "pipeline/passes/layer.h"
#include "pipeline/passes/view.h"

namespace rinkaku::passes {

/// Something of the scene that is drawn as a whole, among the objects: water. It shares their depth.
/// Needs a current GL context.
class ScenePass {
 public:
  virtual ~ScenePass() = default;

  /// Finds what `view` sees of it, and the rectangle of `picture` that it will cover; empty if nothing.
  virtual PixelRect look(const View& view, const PixelRect& picture) = 0;
  /// Before anything is drawn into the layer: whatever it draws into targets of its own.
  virtual void draw_aside(const View& view, const PixelRect& rect) = 0;
  /// After the objects' surfaces, with their depth tested and written, and before their edges. Blending is on
  /// (premultiplied).
  virtual void draw(const View& view, const PixelRect& rect) = 0;
  /// After all edges: what lies over everything, depth tested but not written.
  virtual void draw_over(const View& view, const PixelRect& rect) = 0;
};

}  // namespace rinkaku::passes

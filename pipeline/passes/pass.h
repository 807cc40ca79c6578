#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "pipeline/passes/drawn_object.h"
#include "pipeline/passes/view.h"

namespace rinkaku::passes {

/// What a pass needs to draw its object into the current target.
struct DrawCall {
  const View& view;
  glm::mat4 clip_from_object;  ///< composed in double, rounded once
  PixelRect rect;              ///< what is drawn of the pinhole picture; it fills the viewport
  glm::vec2 viewport_px;
  float focal_px = 0;  ///< pixels that an outline normal of length 1 takes at a distance of 1 m
  float near_m = static_cast<float>(passes::near_m);  ///< of clip_from_object: depth is this, divided by Z
  bool lines_only = false;  ///< a picture of the lines is drawn: all else only covers them, by GL_ZERO for its colour
  bool elsewhere = false;   ///< into a picture of a style's own, of another viewport than rect's
  GLuint depths = 0;        ///< in look_behind(): the texture of all depths drawn so far, near_m / Z but in mirrors
  float empty_depth = 0;    ///< there: what it holds where nothing is
};

/// One way of drawing an object: its shading, its outline, ... An object has a list of them.
///
/// Edges are smoothed without multisampling: each pass draws its surface pulled in by half a pixel, and then, after all
/// surfaces of all objects, a feather one pixel wide along the contour that fades from the surface's colour to nothing,
/// depth-tested against the rest. Coverage is thus right to a few hundredths along smooth shapes (to a quarter at hard
/// edges, where the welded normal is not at right angles to the edge), at the cost of the contour alone.
/// Needs a current GL context.
class ObjectPass {
 public:
  virtual ~ObjectPass() = default;

  virtual const char* name() const = 0;
  /// How far beyond the mesh it draws in this frame, in pixels of the pinhole picture; the object has looked.
  virtual double reach_px(const View& view) const = 0;
  /// False if it only takes away what others drew: then nothing is drawn where no other object is.
  virtual bool leaves_colour() const { return true; }
  /// True if lines are what it draws, or a part of it: then it looks at DrawCall::lines_only itself.
  virtual bool draws_lines() const { return false; }
  /// Draws what is opaque: blending off, depth written.
  virtual void draw_surface(const DrawCall& call) = 0;
  /// Before draw_edges(), once all surfaces are drawn: may find out from the depths of the call what lies behind the
  /// edges. Draws nothing. The depths are the current target's: glTextureBarrier() comes before they are read.
  virtual void look_behind(const DrawCall&) {}
  /// Draws the feathers: blending on (premultiplied), depth tested but not written, which must hold again afterwards.
  virtual void draw_edges(const DrawCall& call) = 0;
};

}  // namespace rinkaku::passes

#pragma once

#include "outline/pass/line_look.h"
#include "pipeline/gl/buffer.h"
#include "pipeline/gl/program.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::outline {

/// How wide a line may be at each of its vertices: it leans back over what lies close behind. A place d pixels out from
/// the contour has ink only if what is seen there lies farther than the contour by `lean` * (d - 1.5) pixels, in
/// metres of its depth. Around an object a line has all of its width; around a mouth that stands out from a face by a
/// millimetre it has a pixel and a half; where a fold runs out on a surface, it gets thinner before it ends.
///
/// A vertex shader looks it up in the depths of all that was drawn before, and transform feedback keeps it; nothing
/// comes back to the CPU. (Of compute shaders each dispatch costs half a millisecond where OpenGL runs on the CPU.)
/// Needs the GL context that was current at construction to be current.
class LineRoom {
 public:
  static constexpr float any_width_px = 1e9f;  ///< the room where nothing lies close behind
  static constexpr float every_px = 8;         ///< along a line it is to be found at least so often

  /// `lean`: above 0.
  LineRoom(float lean, float largest_factor);

  /// Finds the room of the object's lines as they were uploaded, in a view without a mirror.
  void find(passes::DrawnObject& object, const LineLook& look, const passes::DrawCall& call);
  /// A float for each line vertex, in pixels.
  GLuint name() const { return room_.name(); }

 private:
  gl::Program program_;
  LineWidthUniforms width_;
  GLint clip_from_object_ = -1, viewport_px_ = -1, near_m_ = -1, empty_depth_ = -1, focal_px_ = -1;
  gl::StorageBuffer room_;
  GLsizei holds_ = 0;
};

}  // namespace rinkaku::outline

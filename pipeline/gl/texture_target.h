#pragma once

#include <array>
#include <vector>

#include "pipeline/gl/handle.h"

namespace rinkaku::gl {

/// What a pass draws into to read it back in a shader: colour textures of given formats, and a 32-bit float depth
/// texture if asked for. Sampled texel by texel, without filter. Grows to the largest size asked for.
class TextureTarget {
 public:
  enum class Depth { None, Float };
  TextureTarget(std::vector<GLenum> colours, Depth depth);

  /// Binds the target, all of `width_px` x `height_px` cleared to 0, after storage was made for it. Sets the viewport
  /// to the same. Throws Error (Runtime) where it is larger than the driver takes.
  void begin(int width_px, int height_px);

  GLuint colour(std::size_t i) const { return colours_[i].name(); }
  GLuint depth() const { return depth_.name(); }

 private:
  void make_storage(int width_px, int height_px);

  std::vector<GLenum> formats_;
  bool has_depth_;
  FramebufferHandle framebuffer_;
  std::vector<TextureHandle> colours_;
  TextureHandle depth_;
  int width_px_ = 0, height_px_ = 0;
};

/// While it lives, a pass may draw into targets of its own: blending is off and depth is written. At its end the
/// target, viewport and state that were there before are there again.
class ElsewhereScope {
 public:
  ElsewhereScope();
  ~ElsewhereScope();
  ElsewhereScope(const ElsewhereScope&) = delete;
  ElsewhereScope& operator=(const ElsewhereScope&) = delete;

 private:
  GLint framebuffer_ = 0;
  std::array<GLint, 4> viewport_{};
  GLboolean blends_ = GL_FALSE, writes_depth_ = GL_TRUE;
};

}  // namespace rinkaku::gl

#pragma once

#include "pipeline/frame/frame.h"
#include "pipeline/gl/handle.h"
#include "pipeline/gl/program.h"
#include "pipeline/window/to_rgba.h"

namespace rinkaku::window {

/// Shows frames as large as fits, black around them.
///
/// On a graphics card the frame's own planes are uploaded and turned into RGB by a shader; where OpenGL runs on the CPU
/// libyuv does that, which is several times faster there. Needs the context of construction to be current.
class Presenter {
 public:
  enum class Way { Shader, Cpu };
  explicit Presenter(Way way);

  /// Takes the frame's picture over. Frames may change their size and format. Throws Error (Input) for a format that
  /// can't be shown.
  void take(const Frame& frame);

  /// Draws what was taken last into a framebuffer of this size, by default the window's; only black if nothing was.
  void draw(int width_px, int height_px, GLuint framebuffer = 0) const;

  /// Where draw() puts the picture: from the lower left corner.
  struct Place {
    int x_px = 0, y_px = 0, width_px = 0, height_px = 0;
  };
  static Place place(const PictureFormat& format, int width_px, int height_px);

 private:
  void make_picture(int width_px, int height_px);
  void convert(const Frame& frame);
  void upload_planes(const Frame& frame);

  Way way_;
  gl::Program program_;
  gl::VertexArrayHandle nothing_;
  gl::TextureHandle picture_;
  gl::FramebufferHandle framebuffer_;
  gl::TextureHandle planes_[4];
  int plane_widths_[4] = {}, plane_heights_[4] = {};
  PictureFormat format_;
  RgbaConverter converter_;
};

}  // namespace rinkaku::window

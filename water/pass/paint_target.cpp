#include "water/pass/paint_target.h"

#include <algorithm>

#include "pipeline/frame/error.h"

namespace rinkaku::water {
namespace {

GLuint create_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return name;
}

int rounded(int px) { return (px + 127) / 128 * 128; }

}  // namespace

PaintTarget::PaintTarget() : framebuffer_(create_framebuffer()) {}

void PaintTarget::begin(int width_px, int height_px) {
  if (width_px > width_px_ || height_px > height_px_) {
    width_px_ = std::max(width_px_, rounded(width_px));
    height_px_ = std::max(height_px_, rounded(height_px));
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    texture_ = gl::TextureHandle(name);
    glTextureStorage2D(name, 1, GL_RGBA8, width_px_, height_px_);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, name, 0);
    if (glCheckNamedFramebufferStatus(framebuffer_.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw runtime_failure("OpenGL", "the driver can't paint water into an RGBA8 texture of this size");
    }
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width_px, height_px);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace rinkaku::water

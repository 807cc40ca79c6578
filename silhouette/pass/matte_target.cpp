#include "silhouette/pass/matte_target.h"

#include <algorithm>
#include <string>

#include "pipeline/frame/error.h"

namespace rinkaku::silhouette {
namespace {

gl::FramebufferHandle create_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return gl::FramebufferHandle(name);
}

}  // namespace

MatteTarget::MatteTarget() : framebuffer_(create_framebuffer()) {}

void MatteTarget::begin(int width_px, int height_px) {
  if (width_px > width_px_ || height_px > height_px_) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
    if (width_px > most || height_px > most) {
      throw runtime_failure("OpenGL", "a matte of " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                                          " pixels is larger than this driver draws");
    }
    width_px_ = std::max(width_px_, width_px);
    height_px_ = std::max(height_px_, height_px);
    GLuint name = 0;
    glCreateRenderbuffers(1, &name);
    coverage_ = gl::RenderbufferHandle(name);
    glNamedRenderbufferStorage(name, GL_R8, width_px_, height_px_);
    glNamedFramebufferRenderbuffer(framebuffer_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, name);
    if (glCheckNamedFramebufferStatus(framebuffer_.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw runtime_failure("OpenGL", "the driver can't draw into an 8-bit channel");
    }
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width_px, height_px);
  const GLfloat nothing[4] = {0, 0, 0, 0};
  glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, nothing);
}

void MatteTarget::read(int width_px, int height_px, std::uint8_t* matte) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_px, height_px, GL_RED, GL_UNSIGNED_BYTE, matte);
}

}  // namespace rinkaku::silhouette

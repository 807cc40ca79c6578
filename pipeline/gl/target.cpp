#include "pipeline/gl/target.h"

#include <algorithm>
#include <string>

#include "pipeline/frame/error.h"
#include "pipeline/gl/count.h"
#include "pipeline/gl/texture.h"

namespace rinkaku::gl {
namespace {

RenderbufferHandle storage(GLenum format, int width_px, int height_px) {
  GLuint name = 0;
  glCreateRenderbuffers(1, &name);
  RenderbufferHandle handle(name);
  glNamedRenderbufferStorage(name, format, width_px, height_px);
  return handle;
}

// The longest side that the driver draws.
GLint longest_side() {
  GLint buffer = 0, texture = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &buffer);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  return std::min(buffer, texture);
}

// Sizes are rounded up so that an object that comes nearer does not ask for new storage every frame.
int rounded(int px) { return (px + 127) / 128 * 128; }

}  // namespace

Target::Target(Kind kind) : kind_(kind), framebuffer_(make_framebuffer()) { ++counters().targets; }

void Target::begin(int width_px, int height_px, double depth) {
  if (width_px > width_px_ || height_px > height_px_) {
    const GLint most = longest_side();
    if (width_px > most || height_px > most) {
      throw runtime_failure("OpenGL", "a picture of " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                                          " pixels is larger than this driver draws");
    }
    width_px_ = std::min(most, std::max(width_px_, rounded(width_px)));
    height_px_ = std::min(most, std::max(height_px_, rounded(height_px)));
    colour_ = storage(kind_ == Kind::Picture ? GL_RGBA8 : GL_R8, width_px_, height_px_);
    glNamedFramebufferRenderbuffer(framebuffer_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.name());
    if (kind_ == Kind::Picture) {
      depth_ = texel_storage(GL_DEPTH_COMPONENT32F, width_px_, height_px_);
      glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
    }
    if (glCheckNamedFramebufferStatus(framebuffer_.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw runtime_failure("OpenGL", kind_ == Kind::Picture
                                          ? "the driver can't draw into RGBA8 with 32-bit float depth"
                                          : "the driver can't draw into an 8-bit channel");
    }
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width_px, height_px);
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 0);
  glClearDepth(depth);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Target::read(int width_px, int height_px, std::uint8_t* pixels) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_px, height_px, kind_ == Kind::Picture ? GL_RGBA : GL_RED, GL_UNSIGNED_BYTE, pixels);
}

void Target::read_depth(int width_px, int height_px, float* depth) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width_px, height_px, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
}

}  // namespace rinkaku::gl

#include "pipeline/gl/texture_target.h"

#include <algorithm>
#include <string>
#include <utility>

#include "pipeline/frame/error.h"
#include "pipeline/gl/count.h"
#include "pipeline/gl/texture.h"

namespace rinkaku::gl {
namespace {

// An object that comes nearer does not ask for new storage every frame.
int rounded(int px) { return (px + 127) / 128 * 128; }

}  // namespace

TextureTarget::TextureTarget(std::vector<GLenum> colours, Depth depth)
    : formats_(std::move(colours)), has_depth_(depth == Depth::Float), framebuffer_(make_framebuffer()) {
  colours_.resize(formats_.size());
  std::vector<GLenum> attachments;
  for (std::size_t i = 0; i < formats_.size(); ++i) {
    attachments.push_back(static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i));
  }
  glNamedFramebufferDrawBuffers(framebuffer_.name(), static_cast<GLsizei>(attachments.size()), attachments.data());
  ++counters().targets;
}

void TextureTarget::make_storage(int width_px, int height_px) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (width_px > most || height_px > most) {
    throw runtime_failure("OpenGL", "a picture of " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                                        " pixels is larger than this driver draws");
  }
  width_px_ = std::min(most, std::max(width_px_, rounded(width_px)));
  height_px_ = std::min(most, std::max(height_px_, rounded(height_px)));
  for (std::size_t i = 0; i < formats_.size(); ++i) {
    colours_[i] = texel_storage(formats_[i], width_px_, height_px_);
    glNamedFramebufferTexture(framebuffer_.name(), static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i), colours_[i].name(),
                              0);
  }
  if (has_depth_) {
    depth_ = texel_storage(GL_DEPTH_COMPONENT32F, width_px_, height_px_);
    glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  }
  if (glCheckNamedFramebufferStatus(framebuffer_.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw runtime_failure("OpenGL", "the driver can't draw into textures of the formats that this style needs");
  }
}

void TextureTarget::begin(int width_px, int height_px) {
  if (width_px > width_px_ || height_px > height_px_) make_storage(width_px, height_px);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, width_px, height_px);
  const GLfloat nothing[4] = {}, far = 0;
  // Only what is read: beyond it shaders see the last row and column again.
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, std::min(width_px + 2, width_px_), std::min(height_px + 2, height_px_));
  for (std::size_t i = 0; i < formats_.size(); ++i) glClearBufferfv(GL_COLOR, static_cast<GLint>(i), nothing);
  if (has_depth_) glClearBufferfv(GL_DEPTH, 0, &far);
  glDisable(GL_SCISSOR_TEST);
}

ElsewhereScope::ElsewhereScope() {
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer_);
  glGetIntegerv(GL_VIEWPORT, viewport_.data());
  blends_ = glIsEnabled(GL_BLEND);
  glGetBooleanv(GL_DEPTH_WRITEMASK, &writes_depth_);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

ElsewhereScope::~ElsewhereScope() {
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(framebuffer_));
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  if (blends_ == GL_TRUE) glEnable(GL_BLEND);
  glDepthMask(writes_depth_);
}

}  // namespace rinkaku::gl

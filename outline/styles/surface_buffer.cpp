#include "outline/styles/surface_buffer.h"

#include <glm/gtc/type_ptr.hpp>

#include "embedded/surface_buffer.frag.h"
#include "embedded/surface_buffer.vert.h"

namespace rinkaku::outline {

SurfaceBuffer::SurfaceBuffer(Content content)
    : fineness_(content == Content::Depth ? 1 : 2),
      target_(content == Content::Depth ? std::vector<GLenum>{} : std::vector<GLenum>{GL_RGBA8},
              gl::TextureTarget::Depth::Float) {
  if (content == Content::Picture) return;
  const std::string_view vertex[] = {embedded::surface_buffer_vert};
  const std::string_view fragment[] = {embedded::surface_buffer_frag};
  program_ = gl::Program("surface buffer", {}, vertex, fragment);
  clip_from_object_ = program_.uniform("clip_from_object");
  camera_from_normal_ = program_.uniform("camera_from_normal");
}

void SurfaceBuffer::draw(passes::DrawnObject& object, const passes::DrawCall& call, const passes::PixelRect& rect,
                         passes::ObjectPass* body) {
  target_.begin(fineness_ * rect.width_px + 2 * kMargin, fineness_ * rect.height_px + 2 * kMargin);
  // The whole layer's viewport, moved so that the rectangle comes to lie in the target.
  glViewport(fineness_ * (call.rect.x_px - rect.x_px) + kMargin, fineness_ * (call.rect.y_px - rect.y_px) + kMargin,
             fineness_ * call.rect.width_px, fineness_ * call.rect.height_px);
  if (!program_) {
    passes::DrawCall there = call;
    there.elsewhere = true;
    body->draw_surface(there);
    return;
  }
  const glm::mat3 camera_from_normal =
      glm::mat3(glm::dmat3(to_matrix(call.view.camera_from_world))) * object.shape().world_from_normal();
  const std::span<const passes::Run> runs = object.bind_front();
  glUseProgram(program_.name());
  glUniformMatrix4fv(clip_from_object_, 1, GL_FALSE, glm::value_ptr(call.clip_from_object));
  glUniformMatrix3fv(camera_from_normal_, 1, GL_FALSE, glm::value_ptr(camera_from_normal));
  for (const passes::Run& run : runs) passes::draw_run(run);
}

}  // namespace rinkaku::outline

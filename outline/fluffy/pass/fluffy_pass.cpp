#include "outline/fluffy/pass/fluffy_pass.h"

#include <cmath>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "embedded/fluffy.frag.h"
#include "embedded/fluffy.vert.h"

namespace rinkaku::fluffy {
namespace {

// FluffVertex of fluffy.vert.
struct GpuVertex {
  glm::vec3 position;
  float u;
  glm::vec3 growth;
  float v;
  glm::vec3 normal;
  std::array<std::uint8_t, 4> colour;
};
static_assert(sizeof(GpuVertex) == 48);

gl::StaticBuffer upload(const Frame& frame) {
  std::vector<GpuVertex> vertices;
  for (const FrameVertex& v : frame.vertices) {
    vertices.push_back(
        {frame.points[v.point], v.uv.x, frame.growth[v.point], v.uv.y, frame.normals[v.point], v.colour});
  }
  return gl::StaticBuffer(std::as_bytes(std::span(vertices)));
}

gl::VertexArrayHandle make_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return gl::VertexArrayHandle(name);
}

gl::Program make_program(bool lit) {
  std::vector<std::string_view> defines;
  if (lit) defines.push_back("LIT");
  const std::string_view vertex[] = {embedded::fluffy_vert};
  const std::string_view fragment[] = {embedded::fluffy_frag};
  return gl::Program("fluffy", defines, vertex, fragment);
}

}  // namespace

FluffyPass::FluffyPass(passes::DrawnObject& object, const Frame& frame, const TransmissionImage& image,
                       const FluffyOptions& options)
    : object_(object),
      options_(options),
      longest_m_(frame.longest_m * (1.0 + glm::length(options.hang))),
      cutter_(frame, options.cut),
      order_(frame, static_cast<std::uint32_t>(image.layers)),
      vertices_(upload(frame)),
      array_(make_array()),
      image_(image.width_px, image.height_px, image.layers, image.rgba),
      program_(make_program(options.bands > 0)),
      clip_from_frame_(program_.uniform("clip_from_frame")),
      eye_(program_.uniform("eye")) {
  const GLuint name = program_.name();
  glProgramUniform1ui(name, program_.uniform("layers"), static_cast<GLuint>(image.layers));
  glProgramUniform3fv(name, program_.uniform("hang"), 1, glm::value_ptr(options.hang));
  const glm::vec4 own = options.colour ? glm::vec4(*options.colour, 1) : glm::vec4(0);
  glProgramUniform4fv(name, program_.uniform("own_colour"), 1, glm::value_ptr(own));
  glProgramUniform1i(name, program_.uniform("transmission"), 0);
  glProgramUniform1f(name, program_.uniform("sine"), static_cast<float>(options.cut.sine));
  glProgramUniform1f(name, program_.uniform("fade_from"), options.fade_from);
  glProgramUniform1f(name, program_.uniform("foot_shade"), options.foot_shade);
  const glm::vec3 light = glm::normalize(options.light);
  glProgramUniform3fv(name, program_.uniform("light"), 1, glm::value_ptr(light));
  glProgramUniform3fv(name, program_.uniform("shade"), 1, glm::value_ptr(options.shade_colour));
  glProgramUniform1f(name, program_.uniform("bands"), static_cast<float>(options.bands));
  glProgramUniform1f(name, program_.uniform("last_band"), static_cast<float>(std::max(options.bands - 1, 1)));
}

double FluffyPass::reach_px(const passes::View& view) const {
  const passes::Look& look = object_.shape().last_look();
  const double nearest_m = look.nearest_m - longest_m_;
  // Where fluff reaches behind the eye it may be anywhere in the picture.
  if (look.crosses_eye_plane || nearest_m < passes::near_m) return view.camera.width_px + view.camera.height_px;
  // A point of the mesh at the border of the picture moves aside by its growth, and by what coming nearer adds.
  const double off_axis =
      std::hypot(view.camera.width_px / view.camera.fx_px, view.camera.height_px / view.camera.fy_px);
  return view.camera.fx_px * longest_m_ / nearest_m * (1 + off_axis);
}

void FluffyPass::draw_edges(const passes::DrawCall& call) {
  const glm::dmat4& world_from_object = object_.shape().world_from_object();
  const RigidTransform world_from_camera = inverse(call.view.camera_from_world);
  const glm::dvec3 eye = world_from_camera.translation_m - glm::dvec3(world_from_object[3]);
  const std::span<const std::uint32_t> indices = order_.sorted(cutter_.find(eye), eye);
  if (indices.empty()) return;
  indices_.write(std::as_bytes(indices));
  glVertexArrayElementBuffer(array_.name(), indices_.name());
  const glm::mat4 object_from_frame(glm::dmat4(glm::inverse(glm::dmat3(world_from_object))));
  const glm::mat4 clip_from_frame = call.clip_from_object * object_from_frame;
  glUseProgram(program_.name());
  glUniformMatrix4fv(clip_from_frame_, 1, GL_FALSE, glm::value_ptr(clip_from_frame));
  glUniform3fv(eye_, 1, glm::value_ptr(glm::vec3(eye)));
  glBindTextureUnit(0, image_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, vertices_.name());
  glBindVertexArray(array_.name());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace rinkaku::fluffy

#include "outline/fluffy/pass/gpu_cut.h"

#include <array>
#include <span>
#include <string_view>

#include <glm/gtc/type_ptr.hpp>

#include "embedded/band_cut.comp.h"

namespace rinkaku::fluffy {
namespace {

// What glDrawElementsIndirect reads.
using Command = std::array<GLuint, 5>;

gl::Program make_program() {
  const std::string_view parts[] = {embedded::band_cut_comp};
  return gl::Program::compute("band cut", {}, parts);
}

gl::VertexArrayHandle array_with(const gl::StorageBuffer& indices) {
  gl::VertexArrayHandle array = gl::make_vertex_array();
  glVertexArrayElementBuffer(array.name(), indices.name());
  return array;
}

}  // namespace

GpuCut::GpuCut(const Frame& frame, std::uint32_t layers, double sine)
    : triangles_(static_cast<std::uint32_t>(frame.triangles.size())),
      corners_(std::as_bytes(std::span(frame.triangles))),
      indices_(frame.triangles.size() * layers * 3 * sizeof(GLuint)),
      command_(sizeof(Command)),
      array_(array_with(indices_)),
      program_(make_program()),
      eye_(program_.uniform("eye")),
      step_between_(program_.uniform("step_between")) {
  const GLuint name = program_.name();
  glProgramUniform1f(name, program_.uniform("sine"), static_cast<float>(sine + 1e-5));  // as BandCut
  glProgramUniform1ui(name, program_.uniform("triangle_count"), triangles_);
  glProgramUniform1ui(name, program_.uniform("layers"), layers);
}

void GpuCut::run(GLuint vertices, const glm::dvec3& eye, std::uint32_t step) {
  glUseProgram(program_.name());
  glUniform3fv(eye_, 1, glm::value_ptr(glm::vec3(eye)));
  glUniform1ui(step_between_, step);
  const GLuint buffers[] = {vertices, corners_.name(), indices_.name(), command_.name()};
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 4, buffers);
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_ELEMENT_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void GpuCut::draw() const {
  glBindVertexArray(array_.name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command_.name());
  glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr);
}

std::vector<std::uint32_t> GpuCut::read() const {
  Command command{};
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  command_.read(std::as_writable_bytes(std::span(command)));
  std::vector<std::uint32_t> indices(command[0]);
  if (!indices.empty()) indices_.read(std::as_writable_bytes(std::span(indices)));
  return indices;
}

}  // namespace rinkaku::fluffy

#include "pipeline/passes/drawn_object.h"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace rinkaku::passes {

DrawnObject::DrawnObject(ObjectShape shape)
    : shape_(std::move(shape)), mesh_array_(make_vertex_array()), contour_array_(make_vertex_array()) {
  vertex_buffer_ = gl::StaticBuffer(std::as_bytes(shape_.vertices()));
  glVertexArrayVertexBuffer(mesh_array_.name(), 0, vertex_buffer_.name(), 0, sizeof(ShapeVertex));
  if (shape_.intersects_itself()) intersection_array_ = make_border_array();
  if (shape_.border_vertices().empty()) return;
  border_array_ = make_border_array();
  border_buffer_ = gl::StaticBuffer(std::as_bytes(shape_.border_vertices()));
  glVertexArrayVertexBuffer(border_array_.name(), 0, border_buffer_.name(), 0, sizeof(BorderVertex));
}

gl::VertexArrayHandle DrawnObject::make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  auto attribute = [name](GLuint location, GLint size, GLenum type, GLboolean normalised, std::size_t offset) {
    glEnableVertexArrayAttrib(name, location);
    glVertexArrayAttribFormat(name, location, size, type, normalised, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(name, location, 0);
  };
  attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(ShapeVertex, position));
  attribute(1, 3, GL_SHORT, GL_TRUE, offsetof(ShapeVertex, normal));
  attribute(2, 4, GL_SHORT, GL_TRUE, offsetof(ShapeVertex, outline_normal));
  attribute(3, 2, GL_FLOAT, GL_FALSE, offsetof(ShapeVertex, uv));
  attribute(4, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ShapeVertex, colour));
  return gl::VertexArrayHandle(name);
}

gl::VertexArrayHandle DrawnObject::make_border_array() {
  gl::VertexArrayHandle array = make_vertex_array();
  glEnableVertexArrayAttrib(array.name(), 5);
  glVertexArrayAttribFormat(array.name(), 5, 4, GL_SHORT, GL_TRUE, offsetof(BorderVertex, across));
  glVertexArrayAttribBinding(array.name(), 5, 0);
  return array;
}

void DrawnObject::upload() {
  const Look& look = shape_.last_look();
  front_buffer_.write(std::as_bytes(look.front));
  strip_buffer_.write(std::as_bytes(look.strip_vertices));
  strip_index_buffer_.write(std::as_bytes(look.strip_indices));
  glVertexArrayElementBuffer(mesh_array_.name(), front_buffer_.name());
  glVertexArrayElementBuffer(contour_array_.name(), strip_index_buffer_.name());
  glVertexArrayVertexBuffer(contour_array_.name(), 0, strip_buffer_.name(), 0, sizeof(ShapeVertex));
  if (!look.border_indices.empty()) {
    border_index_buffer_.write(std::as_bytes(look.border_indices));
    glVertexArrayElementBuffer(border_array_.name(), border_index_buffer_.name());
  }
  if (!look.intersection_indices.empty()) {
    intersection_buffer_.write(std::as_bytes(look.intersection_vertices));
    intersection_index_buffer_.write(std::as_bytes(look.intersection_indices));
    glVertexArrayElementBuffer(intersection_array_.name(), intersection_index_buffer_.name());
    glVertexArrayVertexBuffer(intersection_array_.name(), 0, intersection_buffer_.name(), 0, sizeof(BorderVertex));
  }
}

std::span<const Run> DrawnObject::bind_front() {
  glFrontFace(shape_.mirrored() ? GL_CCW : GL_CW);  // window rows run downwards (see clip_from_camera)
  glBindVertexArray(mesh_array_.name());
  return shape_.last_look().front_runs;
}

std::span<const Run> DrawnObject::bind_contour() {
  glBindVertexArray(contour_array_.name());
  return shape_.last_look().strip_runs;
}

std::span<const Run> DrawnObject::bind_borders() {
  if (shape_.last_look().border_runs.empty()) return {};
  glBindVertexArray(border_array_.name());
  return shape_.last_look().border_runs;
}

std::span<const Run> DrawnObject::bind_intersections() {
  if (shape_.last_look().intersection_runs.empty()) return {};
  glBindVertexArray(intersection_array_.name());
  return shape_.last_look().intersection_runs;
}

void draw_run(const Run& run) {
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(run.index_count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(static_cast<std::uintptr_t>(run.first_index) * sizeof(GLuint)));
}

}  // namespace rinkaku::passes

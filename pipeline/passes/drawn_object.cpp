#include "pipeline/passes/drawn_object.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "pipeline/gl/vertex_attribute.h"

namespace rinkaku::passes {
namespace {

gl::StaticBuffer colours_of(std::span<const ShapeVertex> vertices) {
  std::vector<VertexColour> colours;
  colours.reserve(vertices.size());
  for (const ShapeVertex& v : vertices) colours.push_back({v.uv, v.colour});
  return gl::StaticBuffer(std::as_bytes(std::span<const VertexColour>(colours)));
}

}  // namespace

DrawnObject::DrawnObject(ObjectShape shape, Skinning skinning)
    : shape_(std::move(shape)),
      mesh_array_(shape_.moves() ? make_moving_array() : make_vertex_array()),
      contour_array_(make_vertex_array()) {
  if (shape_.intersects_itself()) intersection_array_ = make_border_array();
  if (!shape_.border_vertices().empty()) border_array_ = make_border_array();
  if (shape_.moves()) {
    moved_vertices_.emplace(*shape_.moving(), skinning);
    vertex_buffer_ = colours_of(shape_.vertices());
    glVertexArrayVertexBuffer(mesh_array_.name(), 1, vertex_buffer_.name(), 0, sizeof(VertexColour));
    return;
  }
  vertex_buffer_ = gl::StaticBuffer(std::as_bytes(shape_.vertices()));
  glVertexArrayVertexBuffer(mesh_array_.name(), 0, vertex_buffer_.name(), 0, sizeof(ShapeVertex));
  if (shape_.border_vertices().empty()) return;
  border_buffer_ = gl::StaticBuffer(std::as_bytes(shape_.border_vertices()));
  glVertexArrayVertexBuffer(border_array_.name(), 0, border_buffer_.name(), 0, sizeof(BorderVertex));
}

gl::VertexArrayHandle DrawnObject::make_vertex_array() {
  gl::VertexArrayHandle array = gl::make_vertex_array();
  const GLuint name = array.name();
  gl::set_attribute(name, 0, {3, GL_FLOAT, GL_FALSE, offsetof(ShapeVertex, position)});
  gl::set_attribute(name, 1, {3, GL_SHORT, GL_TRUE, offsetof(ShapeVertex, normal)});
  gl::set_attribute(name, 2, {4, GL_SHORT, GL_TRUE, offsetof(ShapeVertex, outline_normal)});
  gl::set_attribute(name, 3, {2, GL_FLOAT, GL_FALSE, offsetof(ShapeVertex, uv)});
  gl::set_attribute(name, 4, {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ShapeVertex, colour)});
  return array;
}

gl::VertexArrayHandle DrawnObject::make_border_array() {
  gl::VertexArrayHandle array = make_vertex_array();
  gl::set_attribute(array.name(), 5, {4, GL_SHORT, GL_TRUE, offsetof(BorderVertex, across)});
  return array;
}

gl::VertexArrayHandle DrawnObject::make_moving_array() {
  gl::VertexArrayHandle array = gl::make_vertex_array();
  const GLuint name = array.name();
  gl::set_attribute(name, 0, {3, GL_FLOAT, GL_FALSE, offsetof(MovedVertex, position)});
  gl::set_attribute(name, 1, {3, GL_SHORT, GL_TRUE, offsetof(MovedVertex, normal)});
  gl::set_attribute(name, 2, {4, GL_SHORT, GL_TRUE, offsetof(MovedVertex, outline_normal)});
  gl::set_attribute(name, 3, {2, GL_FLOAT, GL_FALSE, offsetof(VertexColour, uv), 1});
  gl::set_attribute(name, 4, {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(VertexColour, colour), 1});
  return array;
}

void DrawnObject::upload_movement() {
  if (!shape_.moves() || moves_sent_ == shape_.moves_made()) return;
  moves_sent_ = shape_.moves_made();
  moved_vertices_->follow(*shape_.moving());
  glVertexArrayVertexBuffer(mesh_array_.name(), 0, moved_vertices_->name(), 0, sizeof(MovedVertex));
  if (shape_.border_vertices().empty()) return;
  moving_border_buffer_.write(std::as_bytes(shape_.border_vertices()));
  glVertexArrayVertexBuffer(border_array_.name(), 0, moving_border_buffer_.name(), 0, sizeof(BorderVertex));
}

void DrawnObject::upload() {
  upload_movement();
  const Look& look = shape_.last_look();
  front_buffer_.write(std::as_bytes(look.front));
  strip_buffer_.write(std::as_bytes(look.strip_vertices));
  strip_index_buffer_.write(std::as_bytes(look.strip_indices));
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
  if (!look.line_indices.empty()) {
    line_buffer_.write(std::as_bytes(look.line_vertices));
    line_index_buffer_.write(std::as_bytes(look.line_indices));
    glVertexArrayElementBuffer(line_array_.name(), line_index_buffer_.name());
    glVertexArrayVertexBuffer(line_array_.name(), 0, line_buffer_.name(), 0, sizeof(LineVertex));
  }
}

std::span<const Run> DrawnObject::bind_front() {
  if (shape_.last_look().cull_back_faces) {
    glEnable(GL_CULL_FACE);
  } else {
    glDisable(GL_CULL_FACE);
  }
  bind_triangles(front_buffer_.name());
  return shape_.last_look().front_runs;
}

void DrawnObject::bind_whole(const gl::StaticBuffer& triangles) {
  glDisable(GL_CULL_FACE);
  bind_triangles(triangles.name());
}

void DrawnObject::bind_triangles(GLuint buffer) {
  glFrontFace(shape_.mirrored() ? GL_CCW : GL_CW);  // window rows run downwards (see clip_from_camera)
  glVertexArrayElementBuffer(mesh_array_.name(), buffer);
  glBindVertexArray(mesh_array_.name());
}

std::span<const Run> DrawnObject::bind_contour() {
  glBindVertexArray(contour_array_.name());
  return shape_.last_look().strip_runs;
}

void DrawnObject::ask_for_lines(const LineStyle& style) {
  shape_.ask_for_lines(style);
  line_array_ = gl::make_vertex_array();
  const GLuint name = line_array_.name();
  gl::set_attribute(name, 0, {3, GL_FLOAT, GL_FALSE, offsetof(LineVertex, position)});
  gl::set_attribute(name, 1, {4, GL_SHORT, GL_TRUE, offsetof(LineVertex, line)});
  gl::set_attribute(name, 2, {1, GL_FLOAT, GL_FALSE, 0, 1});
}

GLsizei DrawnObject::bind_lines(GLuint room) {
  const auto count = static_cast<GLsizei>(shape_.last_look().line_indices.size());
  if (count == 0) return 0;
  const GLuint name = line_array_.name();
  if (room != 0) {
    glEnableVertexArrayAttrib(name, 2);
    glVertexArrayVertexBuffer(name, 1, room, 0, sizeof(float));
  } else {
    glDisableVertexArrayAttrib(name, 2);
  }
  glBindVertexArray(name);
  return count;
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

#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "pipeline/gl/buffer.h"
#include "pipeline/gl/handle.h"
#include "pipeline/passes/moved_vertices.h"
#include "pipeline/passes/object_shape.h"

namespace rinkaku::passes {

/// An object of the scene on the GPU: its vertices, and what each frame's look at its shape found. Needs a current GL
/// context for everything but look().
class DrawnObject {
 public:
  /// `skinning`: of an object that moves.
  explicit DrawnObject(ObjectShape shape, Skinning skinning = Skinning::Auto);

  const ObjectShape& shape() const { return shape_; }
  const Look& look(const View& view, const PixelRect& picture) { return shape_.look(view, picture); }

  /// Sends the last look's triangles and contour to the GPU.
  void upload();
  /// Binds vertices and the front-facing triangles; draw the runs with draw_run().
  std::span<const Run> bind_front();
  /// Binds vertices and, instead of the front-facing ones, the triangles of a buffer: three vertices of the mesh each.
  void bind_whole(const gl::StaticBuffer& triangles);
  /// Binds the contour's quads (see ContourStrips); draw them likewise.
  std::span<const Run> bind_contour();
  /// Has looks bring all vertices along (see ObjectShape::ask_for_vertices).
  void ask_for_vertices() { shape_.ask_for_vertices(); }
  /// Has looks find lines from now on (see ObjectShape::ask_for_lines).
  void ask_for_lines(const LineStyle& style);
  /// Binds the contour's lines; one draw of as many indices as is returned. Attribute 2 is each vertex's float of
  /// the buffer `room`; with 0, the context's current value.
  GLsizei bind_lines(GLuint room = 0);
  /// How many vertices they have.
  GLsizei line_vertices() const { return static_cast<GLsizei>(shape_.last_look().line_vertices.size()); }
  /// Binds the quads along borders between materials (see BorderStrips).
  std::span<const Run> bind_borders();
  /// Binds the quads along intersections (see IntersectionStrips).
  std::span<const Run> bind_intersections();

 private:
  void upload_movement();
  static gl::VertexArrayHandle make_vertex_array();
  static gl::VertexArrayHandle make_border_array();
  static gl::VertexArrayHandle make_moving_array();
  void bind_triangles(GLuint buffer);

  ObjectShape shape_;
  gl::StaticBuffer vertex_buffer_;  // where the object moves, of VertexColours
  std::optional<MovedVertices> moved_vertices_;
  gl::StreamBuffer moving_border_buffer_;
  std::uint64_t moves_sent_ = 0;
  gl::StreamBuffer front_buffer_;
  gl::StreamBuffer strip_buffer_;
  gl::StreamBuffer strip_index_buffer_;
  gl::StreamBuffer line_buffer_;
  gl::StreamBuffer line_index_buffer_;
  gl::VertexArrayHandle mesh_array_;
  gl::StaticBuffer border_buffer_;
  gl::StreamBuffer border_index_buffer_;
  gl::VertexArrayHandle contour_array_;
  gl::VertexArrayHandle border_array_;
  gl::StreamBuffer intersection_buffer_;
  gl::StreamBuffer intersection_index_buffer_;
  gl::VertexArrayHandle intersection_array_;
  gl::VertexArrayHandle line_array_;  // if asked for
};

/// Draws a run of what is bound.
void draw_run(const Run& run);

}  // namespace rinkaku::passes

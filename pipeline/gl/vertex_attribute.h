#pragma once

#include <cstddef>

#include <epoxy/gl.h>

namespace rinkaku::gl {

/// One attribute of a vertex array's vertices.
struct VertexAttribute {
  GLint size;
  GLenum type;
  GLboolean normalised;
  std::size_t offset;  ///< in bytes, from the vertex' start
  GLuint binding = 0;  ///< of the buffer that it is in
};

/// The array takes the attribute at `location` from its buffer. Needs a current context.
void set_attribute(GLuint array, GLuint location, const VertexAttribute& attribute);

}  // namespace rinkaku::gl

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
};

/// The array takes the attribute at `location` from the buffer of binding 0. Needs a current context.
void set_attribute(GLuint array, GLuint location, const VertexAttribute& attribute);

}  // namespace rinkaku::gl

#include "pipeline/gl/vertex_attribute.h"

namespace rinkaku::gl {

void set_attribute(GLuint array, GLuint location, const VertexAttribute& attribute) {
  glEnableVertexArrayAttrib(array, location);
  glVertexArrayAttribFormat(array, location, attribute.size, attribute.type, attribute.normalised,
                            static_cast<GLuint>(attribute.offset));
  glVertexArrayAttribBinding(array, location, attribute.binding);
}

}  // namespace rinkaku::gl

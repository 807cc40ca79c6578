#include "silhouette/pass/matte_pass.h"

#include <vector>

#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "embedded/matte.frag.h"
#include "embedded/matte.vert.h"
#include "mesh/bounds.h"

namespace rinkaku::silhouette {
namespace {

gl::StaticBuffer centred_vertices(std::span<const glm::vec3> points, const glm::dvec3& centre) {
  std::vector<glm::vec3> local;
  local.reserve(points.size());
  for (const glm::vec3& point : points) local.emplace_back(glm::dvec3(point) - centre);
  return gl::StaticBuffer(std::as_bytes(std::span(local)));
}

gl::VertexArrayHandle vertex_array(GLuint vertices) {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  glVertexArrayVertexBuffer(name, 0, vertices, 0, sizeof(glm::vec3));
  glEnableVertexArrayAttrib(name, 0);
  glVertexArrayAttribFormat(name, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(name, 0, 0);
  return gl::VertexArrayHandle(name);
}

// With the eye at e, rows x, y and w of the matrix take p to A (p - e), so a triangle that faces the eye is seen
// clockwise in window coordinates exactly if det A is positive.
GLenum front_winding(const glm::dmat4& clip_from_object) {
  glm::dmat3 a;
  for (int column = 0; column < 3; ++column) {
    const glm::dvec4& c = clip_from_object[column];
    a[column] = {c.x, c.y, c.w};
  }
  return glm::determinant(a) > 0 ? GL_CW : GL_CCW;
}

}  // namespace

MattePass::MattePass(std::span<const glm::vec3> points) : centre_(mesh::bounding_box(points).centre()) {
  const std::string_view vertex[] = {embedded::matte_vert};
  const std::string_view fragment[] = {embedded::matte_frag};
  program_ = gl::Program("matte", {}, vertex, fragment);
  clip_from_local_ = program_.uniform("clip_from_local");
  vertices_ = centred_vertices(points, centre_);
  array_ = vertex_array(vertices_.name());
}

void MattePass::set_triangles(std::span<const std::uint32_t> indices) {
  indices_.write(std::as_bytes(indices));
  index_count_ = static_cast<GLsizei>(indices.size());
  glVertexArrayElementBuffer(array_.name(), indices_.name());
}

void MattePass::draw(const glm::dmat4& clip_from_object) {
  glm::dmat4 clip_from_local = clip_from_object;
  clip_from_local[3] = clip_from_object * glm::dvec4(centre_, 1.0);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_CLAMP);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(front_winding(clip_from_object));
  glUseProgram(program_.name());
  glUniformMatrix4fv(clip_from_local_, 1, GL_FALSE, glm::value_ptr(glm::mat4(clip_from_local)));
  glBindVertexArray(array_.name());
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_DEPTH_CLAMP);  // other passes clip, and cull nothing
  glDisable(GL_CULL_FACE);
}

}  // namespace rinkaku::silhouette

#include "silhouette/pass/matte_pass.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "embedded/matte.frag.h"
#include "embedded/matte.vert.h"
#include "mesh/bounds.h"
#include "pipeline/gl/vertex_attribute.h"

namespace rinkaku::silhouette {
namespace {

gl::StaticBuffer centred_vertices(std::span<const glm::vec3> points, const glm::dvec3& centre) {
  std::vector<glm::vec3> local;
  local.reserve(points.size());
  for (const glm::vec3& point : points) local.emplace_back(glm::dvec3(point) - centre);
  return gl::StaticBuffer(std::as_bytes(std::span(local)));
}

gl::VertexArrayHandle vertex_array(GLuint vertices) {
  gl::VertexArrayHandle array = gl::make_vertex_array();
  const GLuint name = array.name();
  glVertexArrayVertexBuffer(name, 0, vertices, 0, sizeof(glm::vec3));
  gl::set_attribute(name, 0, {3, GL_FLOAT, GL_FALSE, 0});
  return array;
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

MattePass::Shader::Shader(bool cull_per_fragment) {
  const std::string_view defines[] = {"CULL_PER_FRAGMENT"};
  const std::string_view vertex[] = {embedded::matte_vert};
  const std::string_view fragment[] = {embedded::matte_frag};
  program = gl::Program("matte", std::span(defines).first(cull_per_fragment ? 1 : 0), vertex, fragment);
  clip_from_local = program.uniform("clip_from_local");
}

MattePass::MattePass(std::span<const glm::vec3> points) {
  const mesh::Box box = mesh::bounding_box(points);
  centre_ = box.centre();
  half_size_ = box.size() * 0.5;
  vertices_ = centred_vertices(points, centre_);
  array_ = vertex_array(vertices_.name());
}

void MattePass::set_triangles(std::span<const std::uint32_t> indices) {
  indices_.write(std::as_bytes(indices));
  index_count_ = static_cast<GLsizei>(indices.size());
  glVertexArrayElementBuffer(array_.name(), indices_.name());
}

// As depth is clamped, only the plane through the eye and the picture's border are left to clip at. Drivers may let
// triangles reach beyond the border, but llvmpipe doesn't.
bool MattePass::may_be_clipped(const glm::dmat4& clip_from_local) const {
  constexpr double reach = 0.9999;  // less than what rounding the matrix moves
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sides(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const glm::dvec4 clip = clip_from_local * glm::dvec4(sides * half_size_, 1.0);
    if (!(std::max(std::abs(clip.x), std::abs(clip.y)) < reach * clip.w)) return true;
  }
  return false;
}

void MattePass::draw(const glm::dmat4& clip_from_object) {
  glm::dmat4 clip_from_local = clip_from_object;
  clip_from_local[3] = clip_from_object * glm::dvec4(centre_, 1.0);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_CLAMP);
  const bool per_fragment = may_be_clipped(clip_from_local);
  if (!per_fragment) glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(front_winding(clip_from_object));
  const Shader& shader = per_fragment ? culled_per_fragment_ : culled_before_;
  glUseProgram(shader.program.name());
  glUniformMatrix4fv(shader.clip_from_local, 1, GL_FALSE, glm::value_ptr(glm::mat4(clip_from_local)));
  glBindVertexArray(array_.name());
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_DEPTH_CLAMP);  // other passes clip, and cull nothing
  glDisable(GL_CULL_FACE);
}

}  // namespace rinkaku::silhouette

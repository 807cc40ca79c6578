#include "outline/styles/picture_lines_pass.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>

#include "embedded/draw_edges.frag.h"
#include "embedded/find_edges.frag.h"
#include "embedded/whole_picture.vert.h"

namespace rinkaku::outline {
namespace {

using Method = PictureLinesOptions::Method;

gl::VertexArrayHandle make_empty_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return gl::VertexArrayHandle(name);
}

std::string_view method_define(Method method) {
  return method == Method::DepthNormals ? "DEPTH_NORMALS" : method == Method::Laplacian ? "LAPLACIAN" : "SILHOUETTE";
}

}  // namespace

PictureLinesPass::PictureLinesPass(passes::DrawnObject& object, passes::ObjectPass& body,
                                   const PictureLinesOptions& options)
    : object_(object),
      body_(body),
      options_(options),
      surface_(options.method == Method::Laplacian ? SurfaceBuffer::Content::Picture : SurfaceBuffer::Content::Normals),
      edges_(std::vector<GLenum>{GL_RGBA32F}, gl::TextureTarget::Depth::None),
      no_vertices_(make_empty_array()) {
  const std::string_view vertex[] = {embedded::whole_picture_vert};
  const std::string_view finding[] = {embedded::find_edges_frag}, drawing[] = {embedded::draw_edges_frag};
  const std::string_view find_defines[] = {method_define(options.method)};
  const std::string_view outside[] = {"OUTSIDE"}, both_sides[] = {"BOTH_SIDES"};
  find_ = gl::Program("find edges", find_defines, vertex, finding);
  std::span<const std::string_view> draw_defines;
  if (options.method == Method::Silhouette) draw_defines = outside;
  if (options.method == Method::Laplacian) draw_defines = both_sides;
  draw_ = gl::Program("draw edges", draw_defines, vertex, drawing);
  const GLuint find = find_.name(), draw = draw_.name();
  glProgramUniform1i(find, find_.uniform("surface"), 0);
  glProgramUniform1i(find, find_.uniform("surface_depth"), 1);
  glProgramUniform1f(find, find_.uniform("depth_step_m"), options.depth_step_m);
  glProgramUniform1f(find, find_.uniform("cos_normal"), std::cos(glm::radians(options.normal_deg)));
  glProgramUniform1f(find, find_.uniform("contrast"), options.contrast);
  glProgramUniform1f(find, find_.uniform("near_m"), static_cast<float>(passes::near_m));
  glProgramUniform1i(draw, draw_.uniform("edges"), 0);
  glProgramUniform1i(draw, draw_.uniform("surface_depth"), 1);
  glProgramUniform3fv(draw, draw_.uniform("colour"), 1, glm::value_ptr(options.look.colour));
  last_texel_ = find_.uniform("last_texel");
  origin_ = draw_.uniform("origin");
  last_pixel_ = draw_.uniform("last_pixel");
  line_px_ = draw_.uniform("line_px");
  reach_px_ = draw_.uniform("reach_px");
}

double PictureLinesPass::reach_px(const passes::View& view) const {
  const double width = std::max(widest_px(options_.look, object_.shape().last_look(), view), 1.0);
  return (options_.method == Method::Silhouette ? width : 0.5 * width) + 1.5;
}

void PictureLinesPass::find(const passes::DrawCall& call, const passes::PixelRect& rect) {
  const gl::ElsewhereScope scope;
  surface_.draw(object_, call, rect, &body_);
  glDisable(GL_DEPTH_TEST);
  edges_.begin(rect.width_px, rect.height_px);
  glUseProgram(find_.name());
  glUniform2i(last_texel_, 2 * rect.width_px - 1, 2 * rect.height_px - 1);
  glBindTextureUnit(0, surface_.colour());
  glBindTextureUnit(1, surface_.depth());
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEnable(GL_DEPTH_TEST);
}

void PictureLinesPass::draw_edges(const passes::DrawCall& call) {
  const passes::Look& look = object_.shape().last_look();
  const int reach = static_cast<int>(std::ceil(reach_px(call.view)));
  const passes::PixelRect grown{look.bounds.x_px - reach, look.bounds.y_px - reach, look.bounds.width_px + 2 * reach,
                                look.bounds.height_px + 2 * reach};
  const passes::PixelRect rect = intersection(grown, call.rect);
  if (rect.empty()) return;
  find(call, rect);
  const int x = rect.x_px - call.rect.x_px, y = rect.y_px - call.rect.y_px;
  glViewport(x, y, rect.width_px, rect.height_px);
  glUseProgram(draw_.name());
  glUniform2i(origin_, x, y);
  glUniform2i(last_pixel_, rect.width_px - 1, rect.height_px - 1);
  glUniform1f(line_px_, static_cast<float>(widest_px(options_.look, look, call.view)));
  glUniform1i(reach_px_, reach - 1);
  glBindTextureUnit(0, edges_.colour(0));
  glBindTextureUnit(1, surface_.depth());
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glViewport(0, 0, call.rect.width_px, call.rect.height_px);
}

}  // namespace rinkaku::outline

#include "outline/styles/picture_lines_pass.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>

#include "embedded/draw_edges.frag.h"
#include "embedded/find_edges.frag.h"
#include "embedded/spread_edges.frag.h"
#include "embedded/spread_edges.vert.h"
#include "embedded/whole_picture.vert.h"

namespace rinkaku::outline {
namespace {

using Method = PictureLinesOptions::Method;

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
      lines_(std::vector<GLenum>{GL_RGBA32F}, gl::TextureTarget::Depth::None),
      no_vertices_(gl::make_vertex_array()) {
  const std::string_view vertex[] = {embedded::whole_picture_vert}, spreading[] = {embedded::spread_edges_vert};
  const std::string_view finding[] = {embedded::find_edges_frag}, spread_part[] = {embedded::spread_edges_frag};
  const std::string_view drawing[] = {embedded::draw_edges_frag};
  const std::string_view find_defines[] = {method_define(options.method)}, outside[] = {"OUTSIDE"};
  std::span<const std::string_view> draw_defines;
  if (options.method == Method::Silhouette) draw_defines = outside;
  find_ = gl::Program("find edges", find_defines, vertex, finding);
  spread_ = gl::Program("spread edges", {}, spreading, spread_part);
  draw_ = gl::Program("draw edges", draw_defines, vertex, drawing);
  const GLuint find = find_.name(), draw = draw_.name();
  glProgramUniform1i(find, find_.uniform("surface"), 0);
  glProgramUniform1i(find, find_.uniform("surface_depth"), 1);
  glProgramUniform1f(find, find_.uniform("depth_step_m"), options.depth_step_m);
  glProgramUniform1f(find, find_.uniform("cos_normal"), std::cos(glm::radians(options.normal_deg)));
  glProgramUniform1f(find, find_.uniform("contrast"), options.contrast);
  near_m_ = find_.uniform("near_m");
  glProgramUniform1i(spread_.name(), spread_.uniform("edges"), 0);
  glProgramUniform1i(draw, draw_.uniform("lines"), 0);
  glProgramUniform1i(draw, draw_.uniform("surface_depth"), 1);
  glProgramUniform3fv(draw, draw_.uniform("colour"), 1, glm::value_ptr(options.look.colour));
  size_px_ = spread_.uniform("size_px");
  reach_px_ = spread_.uniform("reach_px");
  radius_px_ = spread_.uniform("radius_px");
  origin_ = draw_.uniform("origin");
  strength_ = draw_.uniform("strength");
}

double PictureLinesPass::reach_px(const passes::View& view) const {
  const double width = std::max(widest_px(options_.look, object_.shape().last_look(), view), 1.0);
  return (options_.method == Method::Silhouette ? width : 0.5 * width) + 1.5;
}

void PictureLinesPass::find(const passes::DrawCall& call, const passes::PixelRect& rect) {
  surface_.draw(object_, call, rect, &body_);
  edges_.begin(rect.width_px, rect.height_px);
  glUseProgram(find_.name());
  glUniform1f(near_m_, call.near_m);
  glBindTextureUnit(0, surface_.colour());
  glBindTextureUnit(1, surface_.depth());
  glBindVertexArray(no_vertices_.name());
  glDisable(GL_DEPTH_TEST);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void PictureLinesPass::spread(const passes::PixelRect& rect, double line_px, int reach) {
  const double drawn_px = std::max(line_px, 1.0);
  // Laplacian finds an edge on both its sides.
  const double radius_px = options_.method == Method::Silhouette  ? drawn_px
                           : options_.method == Method::Laplacian ? std::max(0.5 * drawn_px - 0.3, 0.3)
                                                                  : 0.5 * drawn_px;
  lines_.begin(rect.width_px, rect.height_px);
  glUseProgram(spread_.name());
  glUniform2i(size_px_, rect.width_px, rect.height_px);
  glUniform1f(reach_px_, static_cast<float>(reach));
  glUniform1f(radius_px_, static_cast<float>(radius_px));
  glBindTextureUnit(0, edges_.colour(0));
  glEnable(GL_PROGRAM_POINT_SIZE);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  glDrawArrays(GL_POINTS, 0, rect.width_px * rect.height_px);
  glBlendEquation(GL_FUNC_ADD);
  glDisable(GL_PROGRAM_POINT_SIZE);
  glEnable(GL_DEPTH_TEST);
}

void PictureLinesPass::draw_edges(const passes::DrawCall& call) {
  const passes::Look& look = object_.shape().last_look();
  const int reach = static_cast<int>(std::ceil(reach_px(call.view)));
  const passes::PixelRect grown{look.bounds.x_px - reach, look.bounds.y_px - reach, look.bounds.width_px + 2 * reach,
                                look.bounds.height_px + 2 * reach};
  const passes::PixelRect rect = intersection(grown, call.rect);
  if (rect.empty()) return;
  const double line_px = widest_px(options_.look, look, call.view);
  {
    const gl::ElsewhereScope scope;
    find(call, rect);
    spread(rect, line_px, reach);
  }
  const int x = rect.x_px - call.rect.x_px, y = rect.y_px - call.rect.y_px;
  glViewport(x, y, rect.width_px, rect.height_px);
  glUseProgram(draw_.name());
  glUniform2i(origin_, x, y);
  glUniform1f(strength_, static_cast<float>(std::min(line_px, 1.0)));
  glBindTextureUnit(0, lines_.colour(0));
  glBindTextureUnit(1, surface_.depth());
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glViewport(0, 0, call.rect.width_px, call.rect.height_px);
}

}  // namespace rinkaku::outline

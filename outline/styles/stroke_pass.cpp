#include "outline/styles/stroke_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "embedded/stroke.frag.h"
#include "embedded/stroke.vert.h"
#include "mesh/bounds.h"

namespace rinkaku::outline {
namespace {

gl::VertexArrayHandle make_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  const struct {
    GLint size;
    std::size_t offset;
  } attributes[] = {{3, offsetof(StrokeVertex, position)},
                    {2, offsetof(StrokeVertex, push_px)},
                    {2, offsetof(StrokeVertex, along_px)},
                    {2, offsetof(StrokeVertex, half_px)}};
  for (GLuint i = 0; i < std::size(attributes); ++i) {
    glEnableVertexArrayAttrib(name, i);
    glVertexArrayAttribFormat(name, i, attributes[i].size, GL_FLOAT, GL_FALSE,
                              static_cast<GLuint>(attributes[i].offset));
    glVertexArrayAttribBinding(name, i, 0);
  }
  return gl::VertexArrayHandle(name);
}

double scale_of(const glm::dmat4& world_from_object) {
  return std::cbrt(std::abs(glm::determinant(glm::dmat3(world_from_object))));
}

}  // namespace

StrokePass::StrokePass(passes::DrawnObject& object, const mesh::Mesh& mesh, const mesh::Topology& topology,
                       const StrokeOptions& options)
    : object_(object),
      options_(options),
      radius_m_(mesh::bounding_sphere(mesh.positions).radius * scale_of(object.shape().world_from_object())),
      own_positions_(mesh.positions.size()),
      welded_(mesh.welded),
      contour_chains_(mesh.welded),
      inner_chains_({}),
      depth_(SurfaceBuffer::Content::Depth),
      array_(make_array()) {
  options_.brush = nullptr;
  if (options.lines != StrokeOptions::Lines::Contour) {
    features_ = find_features(mesh, topology, options.features);
    inner_chains_ = Chains(features_.welded);
  }
  if (options.isophote > 0) bends_.emplace(topology);

  const std::string_view vertex[] = {embedded::stroke_vert}, fragment[] = {embedded::stroke_frag};
  std::span<const std::string_view> defines;
  const std::string_view with_brush[] = {"BRUSH"};
  if (options.brush != nullptr) {
    defines = with_brush;
    brush_ = gl::Texture(options.brush->width_px, options.brush->height_px, options.brush->rgba);
    glTextureParameteri(brush_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  program_ = gl::Program("strokes", defines, vertex, fragment);
  const GLuint name = program_.name();
  glProgramUniform3fv(name, program_.uniform("colour"), 1, glm::value_ptr(options.look.colour));
  glProgramUniform1f(name, program_.uniform("taper_px"), options.taper_px);
  glProgramUniform1i(name, program_.uniform("outside"), options.outside ? 1 : 0);
  glProgramUniform4f(name, program_.uniform("strokes"), options.stroke_px, options.gap, options.pressure,
                     options.dryness);
  glProgramUniform1f(name, program_.uniform("near_m"), static_cast<float>(passes::near_m));
  glProgramUniform1f(name, program_.uniform("thickness_m"), static_cast<float>(0.12 * radius_m_));
  glProgramUniform1f(name, program_.uniform("brush_px"), options.brush_px);
  glProgramUniform1i(name, program_.uniform("own_depth"), 0);
  glProgramUniform1i(name, program_.uniform("brush"), 1);
  clip_from_object_ = program_.uniform("clip_from_object");
  viewport_px_ = program_.uniform("viewport_px");
  origin_ = program_.uniform("origin");
  last_pixel_ = program_.uniform("last_pixel");
  opacity_ = program_.uniform("opacity");
  dash_px_ = program_.uniform("dash_px");
}

double StrokePass::reach_px(const passes::View& view) const {
  double widest = std::max(widest_px(options_.look, object_.shape().last_look(), view), 1.0);
  if (options_.isophote > 0) widest *= options_.most_factor;
  if (options_.wobble > 0) widest *= std::min(1 + 1.8 * options_.wobble, 3.0) + options_.wobble;
  // At bends twice as far, and what smoothing moves.
  return 2 * (options_.outside ? widest : 0.5 * widest) + 3;
}

void StrokePass::add_lines(const passes::DrawCall& call, bool contour) {
  const passes::ObjectShape& shape = object_.shape();
  const passes::Look& look = shape.last_look();
  segments_.clear();
  if (contour) {
    for (const passes::ContourStrips::Piece& piece : look.contour_pieces) segments_.push_back({piece.from, piece.to});
  } else {
    for (const Feature& feature : features_.list) {
      const bool seen = look.front_faces[feature.face0] != 0 && look.front_faces[feature.face1] != 0;
      if (seen || options_.hidden_opacity > 0 || shape.two_sided()) segments_.push_back(feature.segment);
    }
  }
  Chains& chains = contour ? contour_chains_ : inner_chains_;
  chains.link(segments_);

  const PositionView positions{reinterpret_cast<const std::byte*>(shape.vertices().data()) +
                                   offsetof(passes::ShapeVertex, position),
                               sizeof(passes::ShapeVertex)};
  const glm::vec3 eye(glm::inverse(shape.world_from_object()) *
                      glm::dvec4(inverse(call.view.camera_from_world).translation_m, 1.0));
  const auto px_per_unit = static_cast<float>(call.view.camera.fx_px * scale_of(shape.world_from_object()));
  const float drop = 1 - std::sqrt(1 - options_.isophote * options_.isophote);
  const StrokeBand band{options_.outside && contour, shape.mirrored(), options_.wobble,
                        options_.wave_m / static_cast<float>(scale_of(shape.world_from_object())),
                        options_.redraw_frames > 0 ? frame_ / static_cast<std::uint32_t>(options_.redraw_frames) : 0};
  PathOptions how;
  if (!options_.hand) how.smoothing = 0;
  const float period_px = options_.stroke_px > 0 ? options_.stroke_px : brush_.name() != 0 ? options_.brush_px : 0;
  for (const Chain& chain : chains.chains()) {
    const auto vertices = chains.vertices().subspan(chain.first, chain.count);
    widths_px_.clear();
    for (const std::uint32_t v : vertices) {
      const glm::vec3 at = v < own_positions_ ? positions[v] : features_.more_positions[v - own_positions_];
      const float depth = std::abs((look.to_pixels * glm::vec4(at, 1)).z);
      float width = width_at_px(options_.look, call.view.camera.fx_px, depth);
      if (bends_ && contour) {
        const float bend = std::max(bends_->at(welded_[v], eye - at), 1e-12f);
        width = std::clamp(px_per_unit * drop / (bend * depth), 0.2f * width, options_.most_factor * width);
      }
      widths_px_.push_back(width);
    }
    path_.trace(vertices, widths_px_, positions, features_.more_positions, own_positions_, look.to_pixels, chain.closed,
                how);
    if (path_.samples().empty()) continue;
    const StrokeFit fit = memory_.fit(path_, period_px);
    memory_.remember(path_, fit);
    strips_.add(path_, fit, band);
  }
}

void StrokePass::collect(const passes::DrawCall& call) {
  strips_.clear();
  memory_.begin(object_.shape().last_look().to_pixels);
  if (options_.lines != StrokeOptions::Lines::Inner) add_lines(call, true);
  if (options_.lines != StrokeOptions::Lines::Contour) add_lines(call, false);
  ++frame_;
}

void StrokePass::draw_depth(const passes::DrawCall& call, const passes::PixelRect& rect) {
  const gl::ElsewhereScope scope;
  depth_.draw(object_, call, rect, nullptr);
}

void StrokePass::draw_edges(const passes::DrawCall& call) {
  collect(call);
  const passes::PixelRect rect = intersection(object_.shape().last_look().bounds, call.rect);
  if (strips_.indices().empty() || rect.empty()) return;
  draw_depth(call, rect);
  vertex_buffer_.write(std::as_bytes(strips_.vertices()));
  index_buffer_.write(std::as_bytes(strips_.indices()));
  glVertexArrayVertexBuffer(array_.name(), 0, vertex_buffer_.name(), 0, sizeof(StrokeVertex));
  glVertexArrayElementBuffer(array_.name(), index_buffer_.name());
  glBindVertexArray(array_.name());
  glUseProgram(program_.name());
  glUniformMatrix4fv(clip_from_object_, 1, GL_FALSE, glm::value_ptr(call.clip_from_object));
  glUniform2f(viewport_px_, call.viewport_px.x, call.viewport_px.y);
  glUniform2i(origin_, rect.x_px - call.rect.x_px, rect.y_px - call.rect.y_px);
  glUniform2i(last_pixel_, rect.width_px - 1, rect.height_px - 1);
  glBindTextureUnit(0, depth_.depth());
  if (brush_.name() != 0) glBindTextureUnit(1, brush_.name());
  const auto count = static_cast<GLsizei>(strips_.indices().size());
  for (const bool hidden : {true, false}) {
    if (hidden && options_.hidden_opacity <= 0) continue;
    constexpr float dash_px = 8;
    glUniform1f(dash_px_, hidden ? dash_px : 0);
    glUniform1f(opacity_, hidden ? options_.hidden_opacity : options_.opacity);
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
  }
}

}  // namespace rinkaku::outline

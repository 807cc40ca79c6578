#include "outline/styles/stroke_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "embedded/stroke.frag.h"
#include "embedded/stroke.vert.h"
#include "mesh/bounds.h"
#include "pipeline/gl/vertex_attribute.h"

namespace rinkaku::outline {
namespace {

gl::VertexArrayHandle make_array() {
  gl::VertexArrayHandle array = gl::make_vertex_array();
  const GLuint name = array.name();
  gl::set_attribute(name, 0, {3, GL_FLOAT, GL_FALSE, offsetof(StrokeVertex, position)});
  gl::set_attribute(name, 1, {2, GL_FLOAT, GL_FALSE, offsetof(StrokeVertex, push_px)});
  gl::set_attribute(name, 2, {2, GL_FLOAT, GL_FALSE, offsetof(StrokeVertex, along_px)});
  gl::set_attribute(name, 3, {3, GL_FLOAT, GL_FALSE, offsetof(StrokeVertex, half_px)});
  return array;
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
  // Strokes also look where they were in the last frame, beside this one's contour.
  object.ask_for_vertices();
  using Lines = StrokeOptions::Lines;
  for (const DrawnLine& line : options_.drawn) {
    for (const SurfacePlace& place : line) drawn_triangles_.push_back(mesh.triangles[place.triangle]);
  }
  if (options.lines == Lines::Inner || options.lines == Lines::All) {
    features_ = find_features(mesh, topology, options.features);
    more_positions_ = features_.more_positions;
    inner_chains_ = Chains(features_.welded);
  }
  if (options.isophote > 0) bends_.emplace(topology);
  if (options.wobble > 0 && object.shape().moves()) rest_positions_ = mesh.positions;

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
  near_m_ = program_.uniform("near_m");
  glProgramUniform1f(name, program_.uniform("brush_px"), options.brush_px);
  constexpr float dash_px = 8;
  glProgramUniform1f(name, program_.uniform("dash_px"), options.only_hidden ? dash_px : 0);
  glProgramUniform1f(name, program_.uniform("opacity"), options.opacity);
  glProgramUniform1i(name, program_.uniform("own_depth"), 0);
  glProgramUniform1i(name, program_.uniform("brush"), 1);
  clip_from_object_ = program_.uniform("clip_from_object");
  viewport_px_ = program_.uniform("viewport_px");
  origin_ = program_.uniform("origin");
  last_pixel_ = program_.uniform("last_pixel");
  opaque_ = program_.uniform("opaque");
  thickness_m_ = program_.uniform("thickness_m");
}

double StrokePass::reach_px(const passes::View& view) const {
  double widest = std::max(widest_px(options_.look, object_.shape().last_look(), view), 1.0);
  if (options_.isophote > 0) widest *= options_.most_factor;
  if (options_.wobble > 0) widest *= std::min(1 + 1.8 * options_.wobble, 3.0) + options_.wobble;
  // At bends twice as far, and what smoothing moves.
  return 2 * (options_.outside ? widest : 0.5 * widest) + 3;
}

LinePoints StrokePass::line_points() const {
  const auto* vertices = reinterpret_cast<const std::byte*>(object_.shape().vertices().data());
  return {{vertices + offsetof(passes::ShapeVertex, position), sizeof(passes::ShapeVertex)},
          own_positions_,
          moved_cuts_.positions.empty() ? more_positions_ : moved_cuts_.positions};
}

void StrokePass::add_contour(const passes::DrawCall& call) {
  constexpr float longest_px = 24;
  const passes::Look& look = object_.shape().last_look();
  segments_.clear();
  for (const auto& piece : look.contour_pieces) segments_.push_back({piece.from, piece.to});
  const auto seen = static_cast<std::uint32_t>(segments_.size());
  for (const auto& piece : look.hidden_contour_pieces) segments_.push_back({piece.from, piece.to});
  contour_chains_.link(segments_);
  if (bends_ && object_.shape().moves()) move_bends();
  runs_.part(contour_chains_, seen, line_points().own, look.to_pixels, longest_px);
  for (const SeenRuns::Run& run : runs_.runs()) {
    add_line(call, runs_.vertices().subspan(run.first, run.count), run.closed, true);
  }
}

// Looks at how the shape bends where this frame's contour runs.
void StrokePass::move_bends() {
  contour_points_.clear();
  for (const Segment& segment : segments_) {
    contour_points_.push_back(welded_[segment.from]);
    contour_points_.push_back(welded_[segment.to]);
  }
  bends_->move(object_.shape().moved_points(), object_.shape().moved_outline_normals(), contour_points_);
}

// Whether pieces that cut through each other still do where they did: to within half a line.
bool StrokePass::holds_together(const passes::DrawCall& call, const Feature& feature) const {
  if (moved_cuts_.apart.empty() || feature.segment.from < own_positions_) return true;
  const passes::ObjectShape& shape = object_.shape();
  const LinePoints points = line_points();
  const double px_per_unit = call.view.camera.fx_px * scale_of(shape.world_from_object());
  for (const std::uint32_t end : {feature.segment.from, feature.segment.to}) {
    const float depth = std::abs((shape.last_look().to_pixels * glm::vec4(points[end], 1)).z);
    const float most_px = std::max(0.5f * width_at_px(options_.look, call.view.camera.fx_px, depth), 0.5f);
    if (moved_cuts_.apart[end - own_positions_] * px_per_unit > most_px * depth) return false;
  }
  return true;
}

void StrokePass::add_inner(const passes::DrawCall& call) {
  const passes::ObjectShape& shape = object_.shape();
  const passes::Look& look = shape.last_look();
  segments_.clear();
  for (const Feature& feature : features_.list) {
    const bool seen = look.front_faces[feature.face0] != 0 && look.front_faces[feature.face1] != 0;
    if (!seen && !options_.only_hidden && !shape.two_sided()) continue;
    if (holds_together(call, feature)) segments_.push_back(feature.segment);
  }
  inner_chains_.link(segments_);
  for (const Chain& chain : inner_chains_.chains()) {
    add_line(call, inner_chains_.vertices().subspan(chain.first, chain.count), chain.closed, false);
  }
}

// Brings what lines run through beside the mesh's vertices to where the mesh is now.
void StrokePass::place_more() {
  const PositionView own = line_points().own;
  if (!features_.cut_places.empty() && object_.shape().moves()) moved_cuts_.move(features_.cut_places, own);
  if (options_.drawn.empty()) return;
  more_positions_.clear();
  for (const DrawnLine& line : options_.drawn) {
    for (const SurfacePlace& place : line) {
      const glm::uvec3& v = drawn_triangles_[more_positions_.size()];
      more_positions_.push_back((1 - place.b - place.c) * own[v.x] + place.b * own[v.y] + place.c * own[v.z]);
    }
  }
}

void StrokePass::add_drawn(const passes::DrawCall& call) {
  auto next = static_cast<std::uint32_t>(own_positions_);
  for (const DrawnLine& line : options_.drawn) {
    drawn_vertices_.resize(line.size());
    std::iota(drawn_vertices_.begin(), drawn_vertices_.end(), next);
    next += static_cast<std::uint32_t>(line.size());
    add_line(call, drawn_vertices_, false, false);
  }
}

void StrokePass::add_line(const passes::DrawCall& call, std::span<const std::uint32_t> vertices, bool closed,
                          bool contour) {
  // In widths: less is a blot.
  const float shortest = contour ? 1.5f : options_.lines == StrokeOptions::Lines::Drawn ? 0 : 5;
  const passes::ObjectShape& shape = object_.shape();
  const passes::Look& look = shape.last_look();
  const double scale = scale_of(shape.world_from_object());
  const LinePoints points = line_points();
  const float drop = 1 - std::sqrt(1 - options_.isophote * options_.isophote);
  const auto px_per_unit = static_cast<float>(call.view.camera.fx_px * scale);
  glm::vec3 eye(0);
  if (bends_) {
    eye = glm::vec3(glm::inverse(shape.world_from_object()) *
                    glm::dvec4(inverse(call.view.camera_from_world).translation_m, 1.0));
  }
  widths_px_.clear();
  for (const std::uint32_t v : vertices) {
    const glm::vec3& at = points[v];
    const float depth = std::abs((look.to_pixels * glm::vec4(at, 1)).z);
    float width = width_at_px(options_.look, call.view.camera.fx_px, depth);
    if (bends_ && contour) {
      // Where a surface is hollow that way, its contour ends: no wider there than at least.
      const float bend = bends_->at(welded_[v], eye - at);
      const float to_isophote_px = bend > 0 ? px_per_unit * drop / (bend * depth) : 0;
      width = std::clamp(to_isophote_px, 0.2f * width, options_.most_factor * width);
    }
    widths_px_.push_back(width);
  }
  PathOptions how;
  if (!options_.hand) how.smoothing = 0;
  if (bends_) how.most_growth = 0.15f;
  path_.trace(vertices, widths_px_, points, look.to_pixels, closed, how);
  if (path_.samples().empty() || path_.length_px() < shortest * widths_px_.front()) return;
  const float period_px = options_.stroke_px > 0 ? options_.stroke_px : brush_.name() != 0 ? options_.brush_px : 0;
  const StrokeFit fit = memory_.fit(path_, period_px);
  memory_.remember(path_, fit);
  const std::uint32_t draft =
      options_.redraw_frames > 0 ? frame_ / static_cast<std::uint32_t>(options_.redraw_frames) : 0;
  const LinePoints rest{{reinterpret_cast<const std::byte*>(rest_positions_.data())}, rest_positions_.size()};
  strips_.add(path_, fit,
              {options_.outside && contour, shape.mirrored(), options_.wobble,
               options_.wave_m / static_cast<float>(scale), rest_positions_.empty() ? nullptr : &rest, draft});
}

void StrokePass::collect(const passes::DrawCall& call) {
  strips_.clear();
  place_more();
  memory_.begin(line_points(), object_.shape().last_look().to_pixels);
  using Lines = StrokeOptions::Lines;
  if (options_.lines == Lines::Contour || options_.lines == Lines::All) add_contour(call);
  if (options_.lines == Lines::Inner || options_.lines == Lines::All) add_inner(call);
  if (options_.lines == Lines::Drawn) add_drawn(call);
  ++frame_;
}

void StrokePass::draw_depth(const passes::DrawCall& call, const passes::PixelRect& rect) {
  const gl::ElsewhereScope scope;
  depth_.draw(object_, call, rect, nullptr);
}

void StrokePass::draw_edges(const passes::DrawCall& call) {
  if (!call.lines_only) collect(call);  // else they are those of the picture that was just drawn
  const passes::Look& look = object_.shape().last_look();
  const passes::PixelRect rect = intersection(look.bounds, call.rect);
  if (strips_.indices().empty() || rect.empty()) return;
  draw_depth(call, rect);
  vertex_buffer_.write(std::as_bytes(strips_.vertices()));
  index_buffer_.write(std::as_bytes(strips_.indices()));
  glVertexArrayVertexBuffer(array_.name(), 0, vertex_buffer_.name(), 0, sizeof(StrokeVertex));
  glVertexArrayElementBuffer(array_.name(), index_buffer_.name());
  glBindVertexArray(array_.name());
  glUseProgram(program_.name());
  glUniformMatrix4fv(clip_from_object_, 1, GL_FALSE, glm::value_ptr(call.clip_from_object));
  glUniform1f(near_m_, call.near_m);
  glUniform2f(viewport_px_, call.viewport_px.x, call.viewport_px.y);
  glUniform2i(origin_, rect.x_px - call.rect.x_px - SurfaceBuffer::kMargin,
              rect.y_px - call.rect.y_px - SurfaceBuffer::kMargin);
  // How far a ball as large as the object bulges before its contour at the line's inner rim, and a third more.
  const double rim_px = 0.5 * widest_px(options_.look, look, call.view) + 1;
  const double ball_px = std::max(call.view.camera.fx_px * radius_m_ / std::max(look.distance_m, passes::near_m), 1.0);
  glUniform1f(thickness_m_, static_cast<float>(1.33 * radius_m_ * std::sqrt(2 * rim_px / ball_px)));
  glUniform2i(last_pixel_, rect.width_px + 2 * SurfaceBuffer::kMargin - 1,
              rect.height_px + 2 * SurfaceBuffer::kMargin - 1);
  glBindTextureUnit(0, depth_.depth());
  if (brush_.name() != 0) glBindTextureUnit(1, brush_.name());
  // Outside, what is opaque hides edges of the body behind it, which are drawn later.
  for (const bool opaque : {true, false}) {
    if (opaque && !options_.outside) continue;
    glUniform1i(opaque_, opaque ? 1 : 0);
    glDepthMask(opaque ? GL_TRUE : GL_FALSE);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(strips_.indices().size()), GL_UNSIGNED_INT, nullptr);
  }
}

}  // namespace rinkaku::outline

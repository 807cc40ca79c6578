#include "outline/fluffy/pass/fluffy_pass.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "embedded/fluffy.frag.h"
#include "embedded/fluffy.vert.h"

namespace rinkaku::fluffy {
namespace {

using Defines = std::vector<std::string_view>;

}  // namespace

std::vector<FluffyPass::GpuVertex> FluffyPass::vertices_of(const Frame& frame) {
  static_assert(sizeof(GpuVertex) == 48);
  std::vector<GpuVertex> vertices;
  for (const FrameVertex& v : frame.vertices) {
    vertices.push_back(
        {frame.points[v.point], v.uv.x, frame.growth[v.point], v.uv.y, frame.normals[v.point], v.colour});
  }
  return vertices;
}

FluffyPass::Painter::Painter(std::span<const std::string_view> defines) {
  const std::string_view vertex[] = {embedded::fluffy_vert};
  const std::string_view fragment[] = {embedded::fluffy_frag};
  program = gl::Program("fluffy", defines, vertex, fragment);
  clip_from_frame = program.uniform("clip_from_frame");
  eye = program.uniform("eye");
  viewport_px = program.uniform("viewport_px");
  step_between = program.uniform("step_between");
  fresh = program.uniform("fresh");
  rim_px = program.uniform("rim_px");
}

FluffyPass::FluffyPass(passes::DrawnObject& object, const Frame& frame, const TransmissionImage& image,
                       const FluffyOptions& options)
    : object_(object),
      options_(options),
      layers_(static_cast<std::uint32_t>(image.layers)),
      longest_at_rest_m_(frame.longest_m * (1.0 + glm::length(options.hang))),
      vertices_(std::as_bytes(std::span<const GpuVertex>(vertices_of(frame)))),
      array_(gl::make_vertex_array()),
      image_(image.width_px, image.height_px, image.layers, image.rgba),
      fluff_(options.bands > 0 ? Defines{"LIT"} : Defines{}) {
  if (options.cut_on_gpu) {
    gpu_cut_.emplace(frame, layers_, options.cut.sine);
  } else {
    cutter_.emplace(frame, options.cut);
    order_.emplace(frame, layers_);
  }
  set_up(fluff_);
  if (!options.rim) return;
  rim_.emplace(Defines{"RIM"});
  set_up(*rim_);
  const GLuint name = rim_->program.name();
  const glm::vec4 colour(options.rim->colour, 1);
  glProgramUniform4fv(name, rim_->program.uniform("rim_colour"), 1, glm::value_ptr(colour));
}

void FluffyPass::follow(MovingFrame frame) {
  movement_.emplace(Movement{std::move(frame), 0, 0, {}, {}});
  movement_->values = vertices_of(movement_->frame.frame());
  vertices_ = {};
}

double FluffyPass::longest_m() const {
  if (!movement_) return longest_at_rest_m_;
  Movement& m = *movement_;
  const passes::ObjectShape& shape = object_.shape();
  if (m.moves_seen != shape.moves_made()) m.frame.move(shape.moved_points());
  m.moves_seen = shape.moves_made();
  return m.frame.frame().longest_m * (1.0 + glm::length(options_.hang));
}

void FluffyPass::send_movement() {
  if (!movement_) return;
  Movement& m = *movement_;
  if (m.moves_sent == m.moves_seen) return;
  m.moves_sent = m.moves_seen;
  const Frame& frame = m.frame.frame();
  if (cutter_) cutter_->move(frame);
  if (order_) order_->move(frame);
  for (std::size_t v = 0; v < m.values.size(); ++v) {
    const std::uint32_t point = frame.vertices[v].point;
    m.values[v].position = frame.points[point];
    m.values[v].growth = frame.growth[point];
    m.values[v].normal = frame.normals[point];
  }
  m.vertices.write(std::as_bytes(std::span<const GpuVertex>(m.values)));
}

void FluffyPass::set_up(const Painter& painter) const {
  const gl::Program& program = painter.program;
  const GLuint name = program.name();
  glProgramUniform1ui(name, program.uniform("layers"), layers_);
  glProgramUniform3fv(name, program.uniform("hang"), 1, glm::value_ptr(options_.hang));
  const glm::vec4 own = options_.colour ? glm::vec4(*options_.colour, 1) : glm::vec4(0);
  glProgramUniform4fv(name, program.uniform("own_colour"), 1, glm::value_ptr(own));
  glProgramUniform1i(name, program.uniform("transmission"), 0);
  glProgramUniform1f(name, program.uniform("sine"), static_cast<float>(options_.cut.sine));
  glProgramUniform1f(name, program.uniform("fade_from"), options_.fade_from);
  glProgramUniform1f(name, program.uniform("foot_shade"), options_.foot_shade);
  const glm::vec3 light = glm::normalize(options_.light);
  glProgramUniform3fv(name, program.uniform("light"), 1, glm::value_ptr(light));
  glProgramUniform3fv(name, program.uniform("shade"), 1, glm::value_ptr(options_.shade_colour));
  glProgramUniform1f(name, program.uniform("bands"), static_cast<float>(options_.bands));
  glProgramUniform1f(name, program.uniform("last_band"), static_cast<float>(std::max(options_.bands - 1, 1)));
}

float FluffyPass::rim_px(const passes::View& view) const {
  if (!options_.rim) return 0;
  if (options_.rim->width_m <= 0) return options_.rim->width_px;
  const double distance_m = std::max(object_.shape().last_look().distance_m, passes::near_m);
  const double wished_px = view.camera.fx_px * static_cast<double>(options_.rim->width_m) / distance_m;
  return std::clamp(static_cast<float>(wished_px), options_.rim->least_px, options_.rim->most_px);
}

double FluffyPass::reach_px(const passes::View& view) const {
  const passes::Look& look = object_.shape().last_look();
  const double longest = longest_m();
  const double nearest_m = look.nearest_m - longest;
  // Where fluff reaches behind the eye it may be anywhere in the picture.
  if (look.crosses_eye_plane || nearest_m < passes::near_m) return view.camera.width_px + view.camera.height_px;
  // A point of the mesh at the border of the picture moves aside by its growth, and by what coming nearer adds.
  const double off_axis =
      std::hypot(view.camera.width_px / view.camera.fx_px, view.camera.height_px / view.camera.fy_px);
  const double line_px = 2.0 * static_cast<double>(rim_px(view));
  return view.camera.fx_px * longest / nearest_m * (1 + off_axis) + line_px;
}

// As many layers as lie about a pixel and a half apart where the object is nearest. From one number to its double the
// layers between fade in, so that none pops up.
FluffyPass::Density FluffyPass::density(const passes::View& view) const {
  constexpr double apart_px = 1.5;
  constexpr double fewest = 4;  // or there is nothing left of what the lower ones cover
  const passes::Look& look = object_.shape().last_look();
  const double nearest_m = std::max(look.nearest_m, passes::near_m);
  const double wished = std::max(view.camera.fx_px * longest_m() / (nearest_m * apart_px), fewest);
  std::uint32_t step = 1;
  while (step < layers_ && layers_ / (2.0 * step) >= wished) step *= 2;
  const double half = layers_ / (2.0 * step);  // how many there are without the fresh ones
  return {step, static_cast<float>(std::clamp(wished / half - 1, 0.0, 1.0))};
}

GLsizei FluffyPass::find(const glm::dvec3& eye, std::uint32_t step) {
  if (gpu_cut_) {
    gpu_cut_->run(vertices(), eye, step);
    return -1;
  }
  const std::span<const std::uint32_t> indices = order_->sorted(cutter_->find(eye), eye, step);
  if (indices.empty()) return 0;
  indices_.write(std::as_bytes(indices));
  glVertexArrayElementBuffer(array_.name(), indices_.name());
  return static_cast<GLsizei>(indices.size());
}

void FluffyPass::draw_edges(const passes::DrawCall& call) {
  const glm::dmat4& world_from_object = object_.shape().world_from_object();
  const RigidTransform world_from_camera = inverse(call.view.camera_from_world);
  const glm::dvec3 eye = world_from_camera.translation_m - glm::dvec3(world_from_object[3]);
  const Density drawn = density(call.view);
  send_movement();
  const GLsizei count = find(eye, drawn.step);
  if (count == 0) return;
  const glm::mat4 object_from_frame(glm::dmat4(glm::inverse(glm::dmat3(world_from_object))));
  const glm::mat4 clip_from_frame = call.clip_from_object * object_from_frame;
  glBindTextureUnit(0, image_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, vertices());
  glBindVertexArray(array_.name());
  for (const Painter* painter : {rim_ ? &*rim_ : nullptr, &fluff_}) {
    if (painter == nullptr) continue;
    if (call.lines_only && painter == &fluff_) glBlendFunc(GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(painter->program.name());
    glUniformMatrix4fv(painter->clip_from_frame, 1, GL_FALSE, glm::value_ptr(clip_from_frame));
    glUniform3fv(painter->eye, 1, glm::value_ptr(glm::vec3(eye)));
    glUniform2f(painter->viewport_px, call.viewport_px.x, call.viewport_px.y);
    glUniform1ui(painter->step_between, drawn.step);
    glUniform1f(painter->fresh, drawn.fresh);
    if (painter->rim_px >= 0) glUniform1f(painter->rim_px, rim_px(call.view));
    if (gpu_cut_) {
      gpu_cut_->draw();
    } else {
      glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
    }
  }
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace rinkaku::fluffy

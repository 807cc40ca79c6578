#include "pipeline/passes/moved_vertices.h"

#include <algorithm>
#include <span>
#include <string_view>

#include <glm/gtc/type_ptr.hpp>

#include "embedded/skin.comp.h"
#include "pipeline/gl/context.h"

namespace rinkaku::passes {
namespace {

constexpr GLuint kGroup = 256;         // as the shader has it
constexpr GLuint kMostGroups = 65535;  // that every driver takes in a row

static_assert(sizeof(mesh::Influence) == 8 && sizeof(glm::vec3) == 12 && sizeof(glm::mat4) == 64);  // as it reads them

bool is_gpu(Skinning skinning) {
  return skinning == Skinning::Gpu || (skinning == Skinning::Auto && !gl::draws_in_software());
}

}  // namespace

MovedVertices::MovedVertices(const MovingShape& shape, Skinning skinning) {
  if (is_gpu(skinning)) gpu_ = prepare(shape);
}

MovedVertices::Gpu MovedVertices::prepare(const MovingShape& shape) {
  const mesh::Skin& skin = shape.skin();
  const std::string_view text = embedded::skin_comp;
  Gpu gpu;
  gpu.program = gl::Program::compute("skin", {}, std::span(&text, 1));
  gpu.first = gl::StaticBuffer(std::as_bytes(skin.first_influence()));
  gpu.influences = gl::StaticBuffer(std::as_bytes(skin.influences()));
  gpu.welded = gl::StaticBuffer(std::as_bytes(shape.welded()));
  gpu.moved = gl::StorageBuffer(shape.welded().size() * sizeof(MovedVertex));
  const GLuint name = gpu.program.name();
  const OutlinePush& push = shape.push();
  glProgramUniform1ui(name, gpu.program.uniform("vertex_count"), static_cast<GLuint>(shape.welded().size()));
  glProgramUniform1i(name, gpu.program.uniform("evenly_scaled"), push.evenly_scaled() ? 1 : 0);
  glProgramUniformMatrix3fv(name, gpu.program.uniform("world_from_normal"), 1, GL_FALSE,
                            glm::value_ptr(push.world_from_normal()));
  glProgramUniformMatrix3fv(name, gpu.program.uniform("object_from_world"), 1, GL_FALSE,
                            glm::value_ptr(push.object_from_world()));
  return gpu;
}

void MovedVertices::follow(const MovingShape& shape) {
  if (gpu_) {
    dispatch(shape);
    return;
  }
  streamed_.fill(shape.welded().size() * sizeof(MovedVertex), [&](std::span<std::byte> bytes) {
    shape.write({reinterpret_cast<MovedVertex*>(bytes.data()), shape.welded().size()});
  });
}

void MovedVertices::dispatch(const MovingShape& shape) {
  const mesh::Skin& skin = shape.skin();
  gpu_->joints.write(std::as_bytes(skin.joints()));
  if (gpu_->morphs_sent != skin.morphs_made()) {
    gpu_->morphs_sent = skin.morphs_made();
    gpu_->points.write(std::as_bytes(skin.bind_points()));
    gpu_->normals.write(std::as_bytes(skin.bind_normals()));
    gpu_->outline_normals.write(std::as_bytes(skin.bind_outline_normals()));
  }
  const GLuint buffers[] = {gpu_->joints.name(),          gpu_->first.name(),  gpu_->influences.name(),
                            gpu_->welded.name(),          gpu_->points.name(), gpu_->normals.name(),
                            gpu_->outline_normals.name(), gpu_->moved.name()};
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizei>(std::size(buffers)), buffers);
  // What was drawn before still reads what is written now.
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  glUseProgram(gpu_->program.name());
  const GLuint groups = (static_cast<GLuint>(shape.welded().size()) + kGroup - 1) / kGroup;
  glDispatchCompute(std::min(groups, kMostGroups), (groups + kMostGroups - 1) / kMostGroups, 1);
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

}  // namespace rinkaku::passes

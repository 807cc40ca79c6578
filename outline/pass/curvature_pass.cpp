#include "outline/pass/curvature_pass.h"

#include <algorithm>

#include "embedded/curvature_faces.comp.h"
#include "embedded/curvature_gather.comp.h"
#include "embedded/curvature_normals.comp.h"
#include "outline/curvature.h"

namespace rinkaku::outline {
namespace {

constexpr GLuint kGroup = 256;         // as the shaders have it
constexpr GLuint kMostGroups = 65535;  // that every driver takes in a row
enum Binding : GLuint { kPoints, kFaces, kFirst, kCorners, kNormals, kMeasures, kCurvatures };

template <typename T>
gl::StaticBuffer sent(const std::vector<T>& values) {
  // GL takes no empty buffers.
  static constexpr T nothing{};
  return gl::StaticBuffer(values.empty() ? std::as_bytes(std::span(&nothing, 1)) : std::as_bytes(std::span(values)));
}

gl::StorageBuffer room_for(std::size_t count) { return gl::StorageBuffer(std::max<std::size_t>(count, 1) * 16); }

}  // namespace

CurvaturePass::CurvaturePass(const FaceStars& stars, std::span<const glm::vec3> rest)
    : point_count_(stars.point_count()),
      scale_(static_cast<float>(std::min(curvature_scale(stars, rest), 0x1p127))),
      faces_(sent(stars.faces)),
      first_(sent(stars.first)),
      corners_(sent(stars.corners)),
      normals_(room_for(point_count_)),
      measures_(room_for(stars.faces.size())),
      curvatures_(room_for(point_count_)) {
  normals_step_ = step("curvature_normals", embedded::curvature_normals_comp, "point_count", point_count_);
  faces_step_ = step("curvature_faces", embedded::curvature_faces_comp, "face_count", stars.faces.size());
  gather_step_ = step("curvature_gather", embedded::curvature_gather_comp, "point_count", point_count_);
}

CurvaturePass::Step CurvaturePass::step(std::string_view name, std::string_view text, const char* count_uniform,
                                        std::size_t count) const {
  Step made;
  made.program = gl::Program::compute(name, {}, std::span(&text, 1));
  made.groups = (static_cast<GLuint>(count) + kGroup - 1) / kGroup;
  glProgramUniform1ui(made.program.name(), made.program.uniform(count_uniform), static_cast<GLuint>(count));
  glProgramUniform1f(made.program.name(), made.program.uniform("scale"), scale_);
  return made;
}

void CurvaturePass::dispatch(const Step& step) const {
  glUseProgram(step.program.name());
  const GLuint rows = (step.groups + kMostGroups - 1) / kMostGroups;
  glDispatchCompute(std::min(step.groups, kMostGroups), rows, 1);
}

void CurvaturePass::run(GLuint points) {
  const GLuint buffers[] = {points,          faces_.name(),    first_.name(),     corners_.name(),
                            normals_.name(), measures_.name(), curvatures_.name()};
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, kPoints, kCurvatures + 1, buffers);
  dispatch(normals_step_);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  dispatch(faces_step_);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  dispatch(gather_step_);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

}  // namespace rinkaku::outline

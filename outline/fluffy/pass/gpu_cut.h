#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "outline/fluffy/frame.h"
#include "pipeline/gl/buffer.h"
#include "pipeline/gl/program.h"

namespace rinkaku::fluffy {

/// The cut of BandCut in a compute shader, for skins that move on the GPU: lists stay there, and the CPU never learns
/// how many triangles were found.
///
/// Triangles that face away come first, those that face the eye after them, layers in the order of DrawOrder; within
/// each run the frame's order, not that of distance. Needs the GL context that was current at construction.
class GpuCut {
 public:
  GpuCut(const Frame& frame, std::uint32_t layers, double sine);

  /// Lists what is in the band of `eye`, by the vertices of a buffer as fluffy.vert reads it; every `step`-th layer.
  void run(GLuint vertices, const glm::dvec3& eye, std::uint32_t step);
  /// Draws what was listed with the current program; binds the vertex array.
  void draw() const;
  /// The list, for those who want to see it. Waits for the GPU.
  std::vector<std::uint32_t> read() const;

 private:
  std::uint32_t triangles_ = 0;
  gl::StaticBuffer corners_;
  gl::StorageBuffer indices_;
  gl::StorageBuffer command_;
  gl::VertexArrayHandle array_;
  gl::Program program_;
  GLint eye_ = -1;
  GLint step_between_ = -1;
};

}  // namespace rinkaku::fluffy

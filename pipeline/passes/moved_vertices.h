#pragma once

#include <cstdint>
#include <optional>

#include "pipeline/gl/buffer.h"
#include "pipeline/gl/program.h"
#include "pipeline/passes/moving_shape.h"

namespace rinkaku::passes {

/// Where the vertices of what moves are made. Auto: on the GPU, unless OpenGL itself runs on the CPU: then doing it
/// there without OpenGL is quicker (docs/animation.md has both).
enum class Skinning { Auto, Cpu, Gpu };

/// The vertices of an object that moves, as OpenGL draws them (MovedVertex), made anew whenever it has moved: by a
/// compute shader from what was sent once and the joints of the moment, or on the CPU, right into OpenGL's memory. The
/// two differ by rounding alone, and not in positions, on hardware that rounds as IEEE 754 has it.
///
/// Needs the GL context that was current at construction to be current.
class MovedVertices {
 public:
  MovedVertices(const MovingShape& shape, Skinning skinning);

  /// Brings the buffer to the shape's last move. Does not wait.
  void follow(const MovingShape& shape);
  /// The current buffer; may be another one after each follow().
  GLuint name() const { return gpu_ ? gpu_->moved.name() : streamed_.name(); }
  bool on_gpu() const { return gpu_.has_value(); }

 private:
  // What the compute shader works on.
  struct Gpu {
    gl::Program program;
    gl::StaticBuffer first, influences, welded;
    gl::StreamBuffer joints, points, normals, outline_normals;
    gl::StorageBuffer moved;
    std::uint64_t morphs_sent = 0;
  };
  static Gpu prepare(const MovingShape& shape);
  void dispatch(const MovingShape& shape);

  std::optional<Gpu> gpu_;
  gl::StreamBuffer streamed_;
};

}  // namespace rinkaku::passes

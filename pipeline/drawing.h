#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mesh/import.h"
#include "pipeline/passes/layer.h"
#include "pipeline/scene/scene.h"

namespace rinkaku::gl {
class Context;
}
namespace rinkaku::passes {
class LayerRenderer;
}

namespace rinkaku::pipeline {

/// An object's mesh, in the colours that the scene gives it. Throws Error (Input).
mesh::Imported load_mesh(const ObjectScene& object);

/// The GL side of a scene: context, objects on the GPU, their passes. Lives on the thread that made it.
struct Drawing {
  Drawing();
  ~Drawing();
  Drawing(Drawing&&) noexcept;
  std::unique_ptr<gl::Context> context;
  std::unique_ptr<passes::LayerRenderer> renderer;
  std::vector<std::string> notices;  ///< what the meshes' import had to say
};

/// Reads the meshes, on threads of their own while the context is made. Shaders of passes that no object asks for are
/// not compiled. `picture` is the part of the pinhole picture that can be seen.
/// Throws Error: Input for a mesh, Runtime if there is no OpenGL 4.5.
Drawing make_drawing(const Scene& scene, const passes::PixelRect& picture);

}  // namespace rinkaku::pipeline

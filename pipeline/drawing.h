#pragma once

#include <memory>
#include <vector>

#include "mesh/import.h"
#include "pipeline/passes/layer.h"
#include "pipeline/scene.h"

namespace rinkaku::gl {
class Context;
}
namespace rinkaku::passes {
class LayerRenderer;
}

namespace rinkaku::pipeline {

/// An object's mesh as read, before any GL.
struct LoadedObject {
  const ObjectScene* scene = nullptr;
  mesh::Imported imported;
};

/// Reads every object's mesh. Throws Error (Input). `scene` must outlive the result.
std::vector<LoadedObject> load_objects(const Scene& scene);

/// The GL side of a scene: context, objects on the GPU, their passes. Lives on the thread that made it.
struct Drawing {
  Drawing();
  ~Drawing();
  Drawing(Drawing&&) noexcept;
  std::unique_ptr<gl::Context> context;
  std::unique_ptr<passes::LayerRenderer> renderer;
};

/// Shaders of passes that no object asks for are not compiled.
/// `picture` is the part of the pinhole picture that can be seen. Throws Error (Runtime) if there is no OpenGL 4.5.
Drawing make_drawing(const Scene& scene, const std::vector<LoadedObject>& objects, const passes::PixelRect& picture);

}  // namespace rinkaku::pipeline

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mesh/import.h"
#include "pipeline/objects/regions.h"
#include "pipeline/passes/layer.h"
#include "pipeline/scene/scene.h"
#include "water/section.h"

namespace rinkaku::gl {
class Context;
}
namespace rinkaku::passes {
class LayerRenderer;
}

namespace rinkaku::pipeline {

/// An object's mesh, in the colours that the scene gives it. Throws Error (Input).
mesh::Imported load_mesh(const ObjectScene& object);

/// What drawing a scene's objects takes apart from OpenGL: their meshes, read and looked over.
class PreparedObjects {
 public:
  struct All;
  explicit PreparedObjects(std::unique_ptr<All> all);
  ~PreparedObjects();
  PreparedObjects(PreparedObjects&&) noexcept;
  PreparedObjects& operator=(PreparedObjects&&) noexcept;

 private:
  friend void redraw(struct Drawing& drawing, const Scene& scene, PreparedObjects objects);
  std::unique_ptr<All> all_;
};

/// What surfaces show: the scene's colours, or the mean curvature of their shape at rest (see
/// outline::painted_with_curvature), unlit, but for holdouts.
enum class Paint { Scene, Curvature };

/// On any thread, without OpenGL. Throws Error (Input) for a mesh.
PreparedObjects prepare_objects(const Scene& scene, Paint paint = Paint::Scene);

/// The GL side of a scene: context, objects on the GPU, their passes. Lives on the thread that made it.
struct Drawing {
  Drawing();
  ~Drawing();
  Drawing(Drawing&&) noexcept;
  std::unique_ptr<gl::Context> context;
  std::unique_ptr<passes::LayerRenderer> renderer;
  std::vector<water::Solid> solids;  ///< the objects in the world, if there is water for them to stand in
  passes::PixelRect picture;
  std::vector<std::string> notices;  ///< what the meshes' import had to say
};

/// Reads the meshes, on threads of their own while the context is made. Shaders of passes that no object asks for are
/// not compiled. `picture` is the part of the pinhole picture that can be seen.
/// Throws Error: Input for a mesh or its regions, Runtime if there is no OpenGL 4.5.
Drawing make_drawing(const Scene& scene, const passes::PixelRect& picture, const RegionOptions& regions = {});

/// Draws these objects of the scene under its light from now on, in the context that there is; what make_drawing() got
/// of the scene beside them stays. `objects` are prepared from the same scene. On the drawing's thread; nothing changes
/// if it throws.
void redraw(Drawing& drawing, const Scene& scene, PreparedObjects objects);

}  // namespace rinkaku::pipeline

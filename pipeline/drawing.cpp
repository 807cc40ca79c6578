#include "pipeline/drawing.h"

#include <glm/vec3.hpp>

#include "outline/pass/hull_pass.h"
#include "pipeline/gl/context.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/passes/toon/toon_pass.h"
#include "pipeline/placement.h"

namespace rinkaku::pipeline {
namespace {

glm::vec3 colour(const std::array<double, 3>& c) { return glm::vec3(c[0], c[1], c[2]); }

using PassList = std::vector<std::unique_ptr<passes::ObjectPass>>;

void add_toon(PassList& list, passes::DrawnObject& drawn, const mesh::Mesh& mesh, const ObjectScene& object,
              const LightScene& light) {
  passes::ToonOptions options;
  options.bands = object.toon ? object.toon->bands : 0;
  if (object.toon) options.shade_colour = colour(object.toon->shade_colour);
  options.light = glm::vec3(light.direction);
  list.push_back(std::make_unique<passes::ToonPass>(drawn, mesh, options));
}

void add_outline(PassList& list, passes::DrawnObject& drawn, const ObjectScene& object) {
  if (!object.outline) return;
  outline::HullOptions options;
  options.width_px = static_cast<float>(object.outline->width_px);
  options.colour = colour(object.outline->colour);
  list.push_back(std::make_unique<outline::HullPass>(drawn, options));
}

}  // namespace

std::vector<LoadedObject> load_objects(const Scene& scene) {
  std::vector<LoadedObject> loaded;
  for (const ObjectScene& object : scene.objects) {
    mesh::ImportOptions options;
    options.crease_deg = object.crease_deg;
    LoadedObject one{&object, mesh::import(object.mesh, options)};
    if (object.colour) {
      for (mesh::Material& material : one.imported.mesh.materials) {
        material.base_colour = glm::vec4(colour(*object.colour), material.base_colour.a);
        material.texture = -1;
      }
      one.imported.mesh.colours.clear();
    }
    loaded.push_back(std::move(one));
  }
  return loaded;
}

Drawing::Drawing() = default;
Drawing::Drawing(Drawing&&) noexcept = default;
Drawing::~Drawing() {
  // What lives in the context goes before it.
  renderer.reset();
}

Drawing make_drawing(const Scene& scene, const std::vector<LoadedObject>& objects, const passes::PixelRect& picture) {
  Drawing drawing;
  drawing.context = gl::Context::headless();
  std::vector<passes::StyledObject> styled;
  for (const LoadedObject& loaded : objects) {
    const mesh::Mesh& mesh = loaded.imported.mesh;
    const glm::dmat4 place =
        world_from_object(*loaded.scene, mesh::bounding_box(mesh.positions), loaded.imported.summary.up);
    passes::StyledObject one;
    one.object = std::make_unique<passes::DrawnObject>(mesh, place);
    // The list of passes, in drawing order. A new pass adds its line here.
    add_toon(one.passes, *one.object, mesh, *loaded.scene, scene.light);
    add_outline(one.passes, *one.object, *loaded.scene);
    styled.push_back(std::move(one));
  }
  drawing.renderer = std::make_unique<passes::LayerRenderer>(std::move(styled), picture);
  return drawing;
}

}  // namespace rinkaku::pipeline

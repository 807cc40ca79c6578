#include "pipeline/drawing.h"

#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <glm/vec3.hpp>

#include "outline/curvature.h"
#include "outline/line_width.h"
#include "outline/pass/hull_pass.h"
#include "pipeline/gl/context.h"
#include "pipeline/in_parallel.h"
#include "pipeline/passes/holdout/holdout_pass.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/passes/toon/band_borders.h"
#include "pipeline/passes/toon/toon_pass.h"
#include "pipeline/placement.h"

namespace rinkaku::pipeline {
namespace {

glm::vec3 colour(const std::array<double, 3>& c) { return glm::vec3(c[0], c[1], c[2]); }

using PassList = std::vector<std::unique_ptr<passes::ObjectPass>>;

passes::ToonOptions toon_options(const ObjectScene& object, const LightScene& light) {
  passes::ToonOptions options;
  options.bands = object.toon ? object.toon->bands : 0;
  if (object.toon) options.shade_colour = colour(object.toon->shade_colour);
  options.light = glm::vec3(light.direction);
  return options;
}

// Per welded point; empty where the width doesn't follow the shape.
std::vector<float> line_factors(const ObjectScene& object, const mesh::Mesh& mesh) {
  if (!object.outline || object.outline->method != OutlineScene::Method::Curvature) return {};
  const OutlineScene& line = *object.outline;
  outline::WidthOptions options;
  options.kind = line.curvature;
  options.sign = line.sign;
  options.exaggeration = static_cast<float>(line.exaggeration);
  options.saturation = static_cast<float>(line.saturation);
  options.curve = static_cast<float>(line.curve);
  options.least = static_cast<float>(line.min_factor);
  options.smoothing = line.smoothing;
  const mesh::Topology topology = mesh::topology(mesh);
  const outline::Curvature found = outline::curvature(topology);
  return outline::line_width_factors(topology, found, outline::k95(found), options);
}

void add_outline(PassList& list, passes::DrawnObject& drawn, const ObjectScene& object,
                 std::span<const float> factors) {
  if (!object.outline) return;
  const OutlineScene& line = *object.outline;
  outline::HullOptions options;
  options.width_px = static_cast<float>(line.width_px);
  options.width_m = static_cast<float>(line.width_m.value_or(0));
  options.least_px = static_cast<float>(line.min_px);
  options.most_px = static_cast<float>(line.max_px);
  options.colour = colour(line.colour);
  options.style = {factors, static_cast<float>(line.taper_px)};
  list.push_back(std::make_unique<outline::HullPass>(drawn, options));
}

// What of an object needs no GL.
struct PreparedObject {
  mesh::Imported imported;
  passes::ToonOptions toon;
  passes::ObjectShape shape;
  std::vector<float> line_factors;
};

mesh::Imported import_mesh(const ObjectScene& object) {
  mesh::ImportOptions options;
  options.crease_deg = object.crease_deg;
  return mesh::import(object.mesh, options);
}

void give_colour(mesh::Mesh& mesh, const ObjectScene& object) {
  if (!object.colour) return;
  for (mesh::Material& material : mesh.materials) {
    material.base_colour = glm::vec4(colour(*object.colour), material.base_colour.a);
    material.texture = -1;
  }
  mesh.colours.clear();
  mesh.textures.clear();
}

PreparedObject prepare(mesh::Imported imported, const ObjectScene& object, const LightScene& light) {
  give_colour(imported.mesh, object);
  const mesh::Mesh& mesh = imported.mesh;
  const glm::dmat4 place = world_from_object(object, mesh::bounding_box(mesh.positions), imported.summary.up);
  const passes::ToonOptions toon = toon_options(object, light);
  passes::ObjectShape shape(mesh, place, passes::band_borders(mesh, place, toon));
  std::vector<float> factors = line_factors(object, mesh);
  return {std::move(imported), toon, std::move(shape), std::move(factors)};
}

// Objects of one file share its import, which takes a process.
std::vector<std::optional<PreparedObject>> prepare_all(const Scene& scene) {
  std::map<std::pair<std::filesystem::path, double>, std::size_t> known;
  std::vector<const ObjectScene*> distinct;
  std::vector<std::size_t> import_of;
  for (const ObjectScene& object : scene.objects) {
    const auto [at, added] = known.try_emplace({object.mesh, object.crease_deg}, distinct.size());
    if (added) distinct.push_back(&object);
    import_of.push_back(at->second);
  }
  std::vector<mesh::Imported> imported(distinct.size());
  in_parallel(distinct.size(), [&](std::size_t i) { imported[i] = import_mesh(*distinct[i]); });
  std::vector<std::optional<PreparedObject>> prepared(scene.objects.size());
  in_parallel(prepared.size(), [&](std::size_t i) {
    prepared[i].emplace(prepare(imported[import_of[i]], scene.objects[i], scene.light));
  });
  return prepared;
}

water::Solid in_world(const mesh::Mesh& mesh, const glm::dmat4& world_from_object) {
  water::Solid solid;
  solid.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  solid.positions_m.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) {
    solid.positions_m.emplace_back(world_from_object * glm::dvec4(p, 1));
  }
  return solid;
}

}  // namespace

mesh::Imported load_mesh(const ObjectScene& object) {
  mesh::Imported imported = import_mesh(object);
  give_colour(imported.mesh, object);
  return imported;
}

Drawing::Drawing() = default;
Drawing::Drawing(Drawing&&) noexcept = default;
Drawing::~Drawing() {
  // What lives in the context goes before it.
  renderer.reset();
}

Drawing make_drawing(const Scene& scene, const passes::PixelRect& picture) {
  auto preparing = std::async(std::launch::async, prepare_all, std::cref(scene));
  Drawing drawing;
  drawing.context = gl::Context::headless();
  std::vector<std::optional<PreparedObject>> all = preparing.get();
  std::vector<passes::StyledObject> styled;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ObjectScene& object = scene.objects[i];
    PreparedObject& prepared = *all[i];
    for (const std::string& warning : prepared.imported.summary.warnings) {
      drawing.notices.push_back(object.mesh.string() + ": " + warning);
    }
    if (scene.water) drawing.solids.push_back(in_world(prepared.imported.mesh, prepared.shape.world_from_object()));
    passes::StyledObject one;
    one.object = std::make_unique<passes::DrawnObject>(std::move(prepared.shape));
    // The list of passes, in drawing order. A new pass adds its line here.
    if (object.holdout) {
      one.passes.push_back(std::make_unique<passes::HoldoutPass>(*one.object));
    } else {
      one.passes.push_back(std::make_unique<passes::ToonPass>(*one.object, prepared.imported.mesh, prepared.toon));
    }
    add_outline(one.passes, *one.object, object, prepared.line_factors);
    styled.push_back(std::move(one));
  }
  drawing.renderer = std::make_unique<passes::LayerRenderer>(std::move(styled), picture);
  return drawing;
}

}  // namespace rinkaku::pipeline

#include "pipeline/drawing.h"

#include <functional>
#include <future>
#include <span>
#include <utility>

#include <glm/vec3.hpp>

#include "outline/curvature.h"
#include "outline/line_width.h"
#include "outline/pass/hull_pass.h"
#include "pipeline/gl/context.h"
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

outline::CurvatureKind kind(OutlineScene::Curvature curvature) {
  switch (curvature) {
    case OutlineScene::Curvature::Mean:
      return outline::CurvatureKind::Mean;
    case OutlineScene::Curvature::Gauss:
      return outline::CurvatureKind::Gauss;
    case OutlineScene::Curvature::Largest:
      return outline::CurvatureKind::Largest;
    case OutlineScene::Curvature::Smallest:
      return outline::CurvatureKind::Smallest;
  }
  return {};
}

outline::CurvatureSign sign(OutlineScene::Sign sign) {
  switch (sign) {
    case OutlineScene::Sign::Magnitude:
      return outline::CurvatureSign::Magnitude;
    case OutlineScene::Sign::Convex:
      return outline::CurvatureSign::Convex;
    case OutlineScene::Sign::Concave:
      return outline::CurvatureSign::Concave;
  }
  return {};
}

// Per welded point; empty where the width doesn't follow the shape.
std::vector<float> line_factors(const ObjectScene& object, const mesh::Mesh& mesh) {
  if (!object.outline || object.outline->method != OutlineScene::Method::Curvature) return {};
  const OutlineScene& line = *object.outline;
  outline::WidthOptions options;
  options.kind = kind(line.curvature);
  options.sign = sign(line.sign);
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

PreparedObject prepare(const ObjectScene& object, const LightScene& light) {
  mesh::Imported imported = load_mesh(object);
  const mesh::Mesh& mesh = imported.mesh;
  const glm::dmat4 place = world_from_object(object, mesh::bounding_box(mesh.positions), imported.summary.up);
  const passes::ToonOptions toon = toon_options(object, light);
  passes::ObjectShape shape(mesh, place, passes::band_borders(mesh, place, toon));
  std::vector<float> factors = line_factors(object, mesh);
  return {std::move(imported), toon, std::move(shape), std::move(factors)};
}

}  // namespace

mesh::Imported load_mesh(const ObjectScene& object) {
  mesh::ImportOptions options;
  options.crease_deg = object.crease_deg;
  mesh::Imported imported = mesh::import(object.mesh, options);
  if (object.colour) {
    for (mesh::Material& material : imported.mesh.materials) {
      material.base_colour = glm::vec4(colour(*object.colour), material.base_colour.a);
      material.texture = -1;
    }
    imported.mesh.colours.clear();
  }
  return imported;
}

Drawing::Drawing() = default;
Drawing::Drawing(Drawing&&) noexcept = default;
Drawing::~Drawing() {
  // What lives in the context goes before it.
  renderer.reset();
}

Drawing make_drawing(const Scene& scene, const passes::PixelRect& picture) {
  std::vector<std::future<PreparedObject>> preparing;
  for (const ObjectScene& object : scene.objects) {
    preparing.push_back(std::async(std::launch::async, prepare, std::cref(object), std::cref(scene.light)));
  }
  Drawing drawing;
  drawing.context = gl::Context::headless();
  std::vector<passes::StyledObject> styled;
  for (std::size_t i = 0; i < preparing.size(); ++i) {
    const ObjectScene& object = scene.objects[i];
    PreparedObject prepared = preparing[i].get();
    for (const std::string& warning : prepared.imported.summary.warnings) {
      drawing.notices.push_back(object.mesh.string() + ": " + warning);
    }
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

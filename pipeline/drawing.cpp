#include "pipeline/drawing.h"

#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <glm/vec3.hpp>

#include "outline/line_width.h"
#include "outline/pass/hull_pass.h"
#include "pipeline/animated.h"
#include "pipeline/control_line.h"
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

outline::WidthOptions width_options(const OutlineScene& line) {
  outline::WidthOptions options;
  options.kind = line.curvature;
  options.sign = line.sign;
  options.exaggeration = static_cast<float>(line.exaggeration);
  options.saturation = static_cast<float>(line.saturation);
  options.curve = static_cast<float>(line.curve);
  options.least = static_cast<float>(line.min_factor);
  options.smoothing = line.smoothing;
  return options;
}

// Widths that follow the shape: found once, in `factors`, or in every frame of an object that is animated.
template <typename Widths>
void follow_shape(std::shared_ptr<Widths> widths, const mesh::Topology& topology, const ObjectScene& object,
                  std::vector<float>& factors, passes::LineStyle& style) {
  if (object.animation) {
    style.most_factor = 1 + static_cast<float>(object.outline->exaggeration);
    style.follow = [widths](const passes::LineStyle::Moved& now) { widths->at(now.points, now.wanted, now.factors); };
    return;
  }
  const std::span<const float> found = widths->at(topology.points);
  factors.assign(found.begin(), found.end());
  style.factors = factors;
}

// What its width does along the line; the factors' memory is `factors`.
passes::LineStyle line_style(const ObjectScene& object, const mesh::Mesh& mesh, const glm::dmat4& world_from_object,
                             std::vector<float>& factors) {
  passes::LineStyle style;
  if (!object.outline) return style;
  const OutlineScene& line = *object.outline;
  style.taper_px = static_cast<float>(line.taper_px);
  if (line.method == OutlineScene::Method::Uniform) return style;
  const mesh::Topology topology = mesh::topology(mesh);
  if (line.method == OutlineScene::Method::Curvature) {
    follow_shape(std::make_shared<outline::CurvatureWidths>(topology, width_options(line)), topology, object, factors,
                 style);
  } else {
    follow_shape(std::make_shared<outline::ControlWidths>(control_widths(line, topology, world_from_object)), topology,
                 object, factors, style);
  }
  return style;
}

void add_outline(PassList& list, passes::DrawnObject& drawn, const ObjectScene& object,
                 const passes::LineStyle& style) {
  if (!object.outline) return;
  const OutlineScene& line = *object.outline;
  outline::HullOptions options;
  options.width_px = static_cast<float>(line.width_px);
  options.width_m = static_cast<float>(line.width_m.value_or(0));
  options.least_px = static_cast<float>(line.min_px);
  options.most_px = static_cast<float>(line.max_px);
  options.colour = colour(line.colour);
  options.style = style;
  list.push_back(std::make_unique<outline::HullPass>(drawn, options));
}

// What of an object needs no GL.
struct PreparedObject {
  mesh::Imported imported;
  passes::ToonOptions toon;
  passes::ObjectShape shape;
  std::vector<float> line_factors;  // what `line` refers to
  passes::LineStyle line;
};

mesh::Imported import_mesh(const ObjectScene& object) {
  mesh::ImportOptions options;
  options.crease_deg = object.crease_deg;
  options.rig = object.animation.has_value();
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
  if (object.animation) {
    shape.animate(mesh, imported.rig, playback(*object.animation, imported.rig, object.mesh));
  }
  std::vector<float> factors;
  passes::LineStyle line = line_style(object, mesh, place, factors);
  return {std::move(imported), toon, std::move(shape), std::move(factors), std::move(line)};
}

// Objects of one file share its import, which takes a process.
std::vector<std::optional<PreparedObject>> prepare_all(const Scene& scene) {
  std::map<std::tuple<std::filesystem::path, double, bool>, std::size_t> known;
  std::vector<const ObjectScene*> distinct;
  std::vector<std::size_t> import_of;
  for (const ObjectScene& object : scene.objects) {
    const auto [at, added] =
        known.try_emplace({object.mesh, object.crease_deg, object.animation.has_value()}, distinct.size());
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
    passes::StyledObject one;
    one.object = std::make_unique<passes::DrawnObject>(std::move(prepared.shape));
    // The list of passes, in drawing order. A new pass adds its line here.
    if (object.holdout) {
      one.passes.push_back(std::make_unique<passes::HoldoutPass>(*one.object));
    } else {
      one.passes.push_back(std::make_unique<passes::ToonPass>(*one.object, prepared.imported.mesh, prepared.toon));
    }
    add_outline(one.passes, *one.object, object, prepared.line);
    styled.push_back(std::move(one));
  }
  drawing.renderer = std::make_unique<passes::LayerRenderer>(std::move(styled), picture);
  return drawing;
}

}  // namespace rinkaku::pipeline

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

#include "pipeline/animated.h"
#include "pipeline/fluff.h"
#include "pipeline/gl/context.h"
#include "pipeline/in_parallel.h"
#include "pipeline/outline_passes.h"
#include "pipeline/passes/holdout/holdout_pass.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/passes/toon/band_borders.h"
#include "pipeline/passes/toon/toon_pass.h"
#include "pipeline/placement.h"

namespace rinkaku::pipeline {
namespace {

glm::vec3 colour(const std::array<double, 3>& c) { return glm::vec3(c[0], c[1], c[2]); }

passes::ToonOptions toon_options(const ObjectScene& object, const LightScene& light) {
  passes::ToonOptions options;
  options.bands = object.toon ? object.toon->bands : 0;
  if (object.toon) options.shade_colour = colour(object.toon->shade_colour);
  options.light = glm::vec3(light.direction);
  return options;
}

// What of an object needs no GL.
struct PreparedObject {
  mesh::Imported imported;
  passes::ToonOptions toon;
  passes::ObjectShape shape;
  std::vector<float> line_factors;  // what `line` refers to
  passes::LineStyle line;
  std::optional<Fluff> fluff;
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
  passes::LineStyle line;
  if (object.outline) line = line_style(mesh, place, *object.outline, object.animation.has_value(), factors);
  std::optional<Fluff> fluff;
  if (object.fluffy) fluff = prepare_fluff(object, mesh, place);
  if (object.fluffy && object.outline) thin_line_under_fluff(factors, object, mesh);
  line.factors = factors;
  return {std::move(imported), toon, std::move(shape), std::move(factors), std::move(line), std::move(fluff)};
}

// One object after the other, as baking takes all cores.
void use_regions(const Scene& scene, std::span<std::optional<PreparedObject>> all, const RegionOptions& options) {
  std::vector<PlacedBox> boxes;
  for (const auto& one : all) {
    boxes.push_back({mesh::bounding_box(one->imported.mesh.positions), one->shape.world_from_object()});
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ObjectScene& object = scene.objects[i];
    if (region_use(object) == RegionUse::None) continue;
    bool apart = true;
    for (std::size_t k = 0; k < boxes.size(); ++k) apart = apart && (k == i || are_apart(boxes[i], boxes[k]));
    all[i]->shape.use_regions(region_knowledge(object, all[i]->imported.mesh, apart, options));
  }
}

// Objects of one file share its import, which takes a process.
std::vector<std::optional<PreparedObject>> prepare_all(const Scene& scene, const RegionOptions& regions) {
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
  use_regions(scene, prepared, regions);
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

namespace {

// The objects on the GPU with their passes; what their import had to say goes to `notices`.
std::vector<passes::StyledObject> style(const Scene& scene, std::vector<std::optional<PreparedObject>> all,
                                        std::vector<std::string>& notices) {
  std::vector<passes::StyledObject> styled;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ObjectScene& object = scene.objects[i];
    PreparedObject& prepared = *all[i];
    for (const std::string& warning : prepared.imported.summary.warnings) {
      notices.push_back(object.mesh.string() + ": " + warning);
    }
    passes::StyledObject one;
    one.object = std::make_unique<passes::DrawnObject>(std::move(prepared.shape));
    // The list of passes, in drawing order. A new pass adds its line here.
    // Edges are drawn from the list's end on.
    std::unique_ptr<passes::ObjectPass> fluff;
    if (prepared.fluff) fluff = make_fluffy_pass(*one.object, *prepared.fluff, object, scene.light);
    if (fluff && !fluff_is_under_line(object)) one.passes.push_back(std::move(fluff));
    if (object.holdout) {
      one.passes.push_back(std::make_unique<passes::HoldoutPass>(*one.object));
    } else {
      one.passes.push_back(std::make_unique<passes::ToonPass>(*one.object, prepared.imported.mesh, prepared.toon));
    }
    if (object.outline) add_outline(one, prepared.imported.mesh, *object.outline, prepared.line);
    if (fluff) one.passes.push_back(std::move(fluff));
    styled.push_back(std::move(one));
  }
  return styled;
}

}  // namespace

Drawing make_drawing(const Scene& scene, const passes::PixelRect& picture, const RegionOptions& regions) {
  auto preparing = std::async(std::launch::async, prepare_all, std::cref(scene), std::cref(regions));
  Drawing drawing;
  drawing.context = gl::Context::headless();
  drawing.picture = picture;
  drawing.renderer =
      std::make_unique<passes::LayerRenderer>(style(scene, preparing.get(), drawing.notices), drawing.picture);
  return drawing;
}

struct PreparedObjects::All {
  std::vector<std::optional<PreparedObject>> objects;
};
PreparedObjects::PreparedObjects(std::unique_ptr<All> all) : all_(std::move(all)) {}
PreparedObjects::~PreparedObjects() = default;
PreparedObjects::PreparedObjects(PreparedObjects&&) noexcept = default;
PreparedObjects& PreparedObjects::operator=(PreparedObjects&&) noexcept = default;

PreparedObjects prepare_objects(const Scene& scene) {
  auto all = std::make_unique<PreparedObjects::All>();
  all->objects = prepare_all(scene, {});
  return PreparedObjects(std::move(all));
}

void redraw(Drawing& drawing, const Scene& scene, PreparedObjects objects) {
  std::vector<std::string> notices;  // said already when the run began
  std::vector<passes::StyledObject> styled = style(scene, std::move(objects.all_->objects), notices);
  drawing.renderer = std::make_unique<passes::LayerRenderer>(std::move(styled), drawing.picture);
}

}  // namespace rinkaku::pipeline

#include "pipeline/objects/drawing.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "mesh/topology.h"
#include "outline/curvature.h"
#include "outline/curvature_colours.h"
#include "pipeline/gl/context.h"
#include "pipeline/objects/animated.h"
#include "pipeline/objects/file_line.h"
#include "pipeline/objects/fluff.h"
#include "pipeline/objects/in_parallel.h"
#include "pipeline/objects/line_weights.h"
#include "pipeline/objects/outline_passes.h"
#include "pipeline/objects/placement.h"
#include "pipeline/passes/holdout/holdout_pass.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/passes/toon/band_borders.h"
#include "pipeline/passes/toon/toon_pass.h"

namespace rinkaku::pipeline {
namespace {

glm::vec3 colour(const std::array<double, 3>& c) { return glm::vec3(c[0], c[1], c[2]); }

passes::ToonOptions toon_options(const ObjectScene& object, const LightScene& light) {
  passes::ToonOptions options;
  options.bands = object.toon ? object.toon->bands : 0;
  if (object.toon) options.shade_colour = colour(object.toon->shade_colour);
  options.light = glm::vec3(light.direction);
  if (has_coarse_colour(object)) options.shading_scale = object.shading_scale;
  return options;
}

passes::Skinning skinning(const ObjectScene& object) {
  if (!object.animation || object.animation->skinning == Skinning::Auto) return passes::Skinning::Auto;
  return object.animation->skinning == Skinning::Gpu ? passes::Skinning::Gpu : passes::Skinning::Cpu;
}

// What of an object needs no GL.
struct PreparedObject {
  ObjectScene object;  // with what the mesh's file says of its line
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

void paint_with_curvature(mesh::Mesh& mesh) {
  const outline::Curvature curvature = outline::curvature(mesh::topology(mesh));
  mesh = outline::painted_with_curvature(std::move(mesh), curvature, outline::k95(curvature));
}

PreparedObject prepare(mesh::Imported imported, const Scene& scene, std::size_t number, Paint paint) {
  const LightScene& light = scene.light;
  const glm::dmat4 place =
      world_from_object(scene.objects[number], mesh::bounding_box(imported.mesh.positions), imported.summary.up);
  const double unit_m = std::cbrt(std::abs(glm::determinant(glm::dmat3(place))));
  ObjectScene object = with_file_line(scene.objects[number], imported.mesh, unit_m, scene.plate.camera);
  const std::vector<float> weights = line_weights(object, imported.mesh);
  give_colour(imported.mesh, object);
  const bool painted = paint == Paint::Curvature && !object.holdout;
  if (painted) paint_with_curvature(imported.mesh);
  const mesh::Mesh& mesh = imported.mesh;
  passes::ToonOptions toon = toon_options(object, light);
  if (painted) toon.bands = 0;
  passes::ObjectShape shape(mesh, place, passes::band_borders(mesh, place, toon));
  if (object.animation) {
    shape.animate(mesh, imported.rig, playback(*object.animation, imported.rig, object.mesh));
  }
  std::vector<float> factors;
  passes::LineStyle line;
  if (object.outline) {
    line = line_style(mesh, *object.outline, {place, light.direction, weights, object.animation.has_value()}, factors);
  }
  std::optional<Fluff> fluff;
  if (object.fluffy) fluff = prepare_fluff(object, mesh, place);
  if (object.fluffy && object.outline) thin_line_under_fluff(line, factors, object, mesh);
  line.factors = factors;
  return {std::move(object), std::move(imported), toon, std::move(shape), std::move(factors),
          std::move(line),   std::move(fluff)};
}

// Whether the mesh's file moves it: regions are of its pose at rest.
bool may_move(const mesh::ImportSummary& mesh) {
  return mesh.skins > 0 || mesh.morph_targets > 0 || !mesh.clips.empty();
}

// One object after the other, as baking takes all cores.
void use_regions(const Scene& scene, std::span<std::optional<PreparedObject>> all, const RegionOptions& options) {
  std::vector<PlacedBox> boxes;
  for (const auto& one : all) {
    mesh::Box box = mesh::bounding_box(one->imported.mesh.positions);
    if (one->fluff) box = with_fluff(box, *one->fluff, one->shape.world_from_object());
    boxes.push_back({box, one->shape.world_from_object()});
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ObjectScene& object = scene.objects[i];
    if (region_use(object) == RegionUse::None) continue;
    if (may_move(all[i]->imported.summary)) {
      if (options.tell) options.tell(object.name + ": moves (skins, morphs or clips), so it is drawn without regions");
      continue;
    }
    bool apart = true;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      if (k == i) continue;
      apart = apart && !may_move(all[k]->imported.summary) && are_apart(boxes[i], boxes[k]);
    }
    all[i]->shape.use_regions(region_knowledge(object, all[i]->imported.mesh, apart, options));
  }
}

// Objects of one file share its import, which takes a process.
std::vector<std::optional<PreparedObject>> prepare_all(const Scene& scene, const RegionOptions& regions, Paint paint) {
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
  in_parallel(prepared.size(),
              [&](std::size_t i) { prepared[i].emplace(prepare(imported[import_of[i]], scene, i, paint)); });
  use_regions(scene, prepared, regions);
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

std::vector<water::Solid> solids_of(const Scene& scene, std::span<const std::optional<PreparedObject>> all) {
  std::vector<water::Solid> solids;
  if (!scene.water) return solids;
  for (const std::optional<PreparedObject>& one : all) {
    solids.push_back(in_world(one->imported.mesh, one->shape.world_from_object()));
  }
  return solids;
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
    PreparedObject& prepared = *all[i];
    const ObjectScene& object = prepared.object;
    for (const std::string& warning : prepared.imported.summary.warnings) {
      notices.push_back(object.mesh.string() + ": " + warning);
    }
    passes::StyledObject one;
    one.object = std::make_unique<passes::DrawnObject>(std::move(prepared.shape), skinning(object));
    // The list of passes, in drawing order. A new pass adds its line here.
    if (object.holdout) {
      one.passes.push_back(std::make_unique<passes::HoldoutPass>(*one.object));
    } else {
      one.passes.push_back(std::make_unique<passes::ToonPass>(*one.object, prepared.imported.mesh, prepared.toon));
    }
    if (object.outline) add_outline(one, prepared.imported.mesh, *object.outline, prepared.line);
    if (prepared.fluff) add_fluff(one, *prepared.fluff, object, scene.light);
    styled.push_back(std::move(one));
  }
  return styled;
}

}  // namespace

Drawing make_drawing(const Scene& scene, const passes::PixelRect& picture, const RegionOptions& regions) {
  auto preparing = std::async(std::launch::async, prepare_all, std::cref(scene), std::cref(regions), Paint::Scene);
  Drawing drawing;
  drawing.context = gl::Context::headless();
  drawing.picture = picture;
  std::vector<std::optional<PreparedObject>> all = preparing.get();
  drawing.solids = solids_of(scene, all);
  drawing.renderer =
      std::make_unique<passes::LayerRenderer>(style(scene, std::move(all), drawing.notices), drawing.picture);
  return drawing;
}

struct PreparedObjects::All {
  std::vector<std::optional<PreparedObject>> objects;
};
PreparedObjects::PreparedObjects(std::unique_ptr<All> all) : all_(std::move(all)) {}
PreparedObjects::~PreparedObjects() = default;
PreparedObjects::PreparedObjects(PreparedObjects&&) noexcept = default;
PreparedObjects& PreparedObjects::operator=(PreparedObjects&&) noexcept = default;

PreparedObjects prepare_objects(const Scene& scene, Paint paint) {
  auto all = std::make_unique<PreparedObjects::All>();
  all->objects = prepare_all(scene, {}, paint);
  return PreparedObjects(std::move(all));
}

void redraw(Drawing& drawing, const Scene& scene, PreparedObjects objects) {
  std::vector<std::string> notices;  // said already when the run began
  std::vector<water::Solid> solids = solids_of(scene, objects.all_->objects);
  std::vector<passes::StyledObject> styled = style(scene, std::move(objects.all_->objects), notices);
  auto renderer = std::make_unique<passes::LayerRenderer>(std::move(styled), drawing.picture);
  renderer->take_scene_passes(*drawing.renderer);
  drawing.renderer = std::move(renderer);
  drawing.solids = std::move(solids);
}

}  // namespace rinkaku::pipeline

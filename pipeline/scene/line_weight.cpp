#include "pipeline/scene/line_weight.h"

#include <algorithm>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

constexpr double most = 20;

std::vector<LineWeightScene::OfMaterial> read_materials(const toml::Table& weight) {
  std::vector<LineWeightScene::OfMaterial> all;
  for (const toml::Table& table : weight.tables("material")) {
    LineWeightScene::OfMaterial one;
    one.name = table.required("name", table.text("name"));
    one.factor = table.required("factor", table.number("factor", {0, most}));
    if (std::any_of(all.begin(), all.end(), [&](const auto& other) { return other.name == one.name; })) {
      throw table.error_at("name", "is given twice", "leave one out");
    }
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

toml::Schema line_weight_schema() {
  return {{.path = "object.outline.weight", .keys = {"shade", "paint", "map", "material"}},
          {.path = "object.outline.weight.material", .keys = {"name", "factor"}}};
}

LineWeightScene read_line_weight(const toml::Table& outline, LineMethod method) {
  LineWeightScene scene;
  const auto weight = outline.table("weight");
  if (!weight) return scene;
  require_pushed_contour(outline, "weight", method);
  scene.shade = weight->number("shade", {0, most}).value_or(0);
  scene.paint = read_choice<int>(*weight, "paint", {{"red", 0}, {"green", 1}, {"blue", 2}, {"alpha", 3}});
  if (weight->has("map")) scene.map = existing_file(*weight, "map");
  scene.materials = read_materials(*weight);
  return scene;
}

}  // namespace rinkaku::pipeline

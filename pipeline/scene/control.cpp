#include "pipeline/scene/control.h"

#include <cstdint>
#include <string_view>
#include <variant>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

using toml::Limits;
using toml::Table;

constexpr const char* list_of_points = "a list of points [[x, y, z], ...] in metres, at most 10000";

double metres_of(const Table& table, const toml::Value& value) {
  const double* real = std::get_if<double>(&value.held);
  const std::int64_t* whole = std::get_if<std::int64_t>(&value.held);
  if (real == nullptr && whole == nullptr) throw table.wrong("points_m", list_of_points);
  const double metre = real != nullptr ? *real : static_cast<double>(*whole);
  if (!(metre >= metres.least && metre <= metres.most)) throw table.wrong("points_m", list_of_points);
  return metre;
}

std::vector<glm::dvec3> read_points(const Table& table) {
  constexpr std::size_t most = 10000;
  std::vector<glm::dvec3> points;
  const auto* list = std::get_if<toml::Array>(&table.find("points_m")->held);
  if (list == nullptr || list->empty() || list->size() > most) throw table.wrong("points_m", list_of_points);
  for (const toml::Value& each : *list) {
    const auto* point = std::get_if<toml::Array>(&each.held);
    if (point == nullptr || point->size() != 3) throw table.wrong("points_m", list_of_points);
    points.emplace_back(metres_of(table, (*point)[0]), metres_of(table, (*point)[1]), metres_of(table, (*point)[2]));
  }
  return points;
}

void read_features(const Table& control, outline::FeaturePointOptions& features) {
  const bool degrees = control.has("convex_deg") || control.has("concave_deg");
  for (const std::string_view key : {"convex", "concave"}) {
    if (degrees && control.has(key)) {
      throw control.error_at(key, "can't stand beside thresholds in degrees", "give both as _deg, or none");
    }
  }
  if (degrees) {
    features.by = outline::FeaturePointOptions::By::Degrees;
    features.convex = control.number("convex_deg", {180, 360}).value_or(360);
    features.concave = control.number("concave_deg", {0, 180}).value_or(0);
  } else {
    features.convex = control.number("convex", {0, 1000}).value_or(features.convex);
    features.concave = control.number("concave", {0, 1000}).value_or(features.concave);
  }
  features.comparison = static_cast<int>(control.integer("comparison", 0, 1000).value_or(features.comparison));
}

}  // namespace

toml::Schema control_schema() {
  return {{.path = "object.outline.control",
           .keys = {"points_m", "sphere", "along", "distance", "reach_m", "lengths", "convex", "concave", "convex_deg",
                    "concave_deg", "comparison"}}};
}

ControlScene read_control(const Table& outline) {
  ControlScene scene;
  const auto control = outline.table("control");
  if (!control) return scene;
  control->exclude("points_m", "sphere");
  control->exclude("points_m", "along");
  control->exclude("sphere", "along");
  control->exclude("points_m", "distance");
  if (control->has("points_m")) scene.points_m = read_points(*control);
  scene.on_sphere = static_cast<int>(control->integer("sphere", 1, 10000).value_or(0));
  scene.along = static_cast<int>(control->integer("along", 1, 10000).value_or(scene.along));
  scene.distance = control->number("distance", Limits::above(0, 100)).value_or(scene.distance);
  scene.reach_m = control->number("reach_m", Limits::above(0, 1e6));
  scene.lengths = control->flag("lengths").value_or(false);
  read_features(*control, scene.features);
  return scene;
}

}  // namespace rinkaku::pipeline

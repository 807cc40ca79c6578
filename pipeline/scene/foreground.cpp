#include "pipeline/scene/foreground.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "pipeline/scene/outline.h"
#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

using toml::Limits;
using toml::Table;

constexpr std::string_view all_methods = "\"chroma\", \"difference\", \"file\" or \"segmentation\"";

// "difference", or several: ["difference", "file"].
std::vector<std::string> read_methods(const Table& foreground) {
  const toml::Value* value = foreground.find("method");
  if (value == nullptr) throw foreground.missing("method");
  std::vector<std::string> names;
  if (const auto* array = std::get_if<toml::Array>(&value->held)) {
    for (const toml::Value& each : *array) {
      const auto* name = std::get_if<std::string>(&each.held);
      if (name == nullptr) throw foreground.wrong("method", "one method or an array of methods");
      if (std::find(names.begin(), names.end(), *name) != names.end()) {
        throw foreground.error_at("method", "names '" + *name + "' twice", "leave one out");
      }
      names.push_back(*name);
    }
    if (names.empty()) throw foreground.error_at("method", "names none", "give one, e.g. \"difference\"");
  } else {
    names.push_back(*foreground.text("method"));
  }
  return names;
}

matte::ChromaOptions read_chroma(const std::optional<Table>& table) {
  matte::ChromaOptions options;
  if (!table) return options;
  options.key = read_colour(*table, "key");
  options.clip_low = table->number("clip_low", {0, 1}).value_or(options.clip_low);
  options.clip_high = table->number("clip_high", {0, 1}).value_or(options.clip_high);
  if (options.clip_low + 0.01 > options.clip_high) {
    throw table->error("'clip_low' must be below 'clip_high'", "give e.g. clip_low = 0.1, clip_high = 0.9");
  }
  options.hue_deg = table->number("hue_deg", {5, 85}).value_or(options.hue_deg);
  options.despill = table->number("despill", {0, 1}).value_or(options.despill);
  return options;
}

DifferenceMatteScene read_difference(const std::optional<Table>& table) {
  DifferenceMatteScene scene;
  if (!table) return scene;
  if (table->has("clean")) scene.clean = existing_file(*table, "clean").string();
  matte::DifferenceOptions& options = scene.options;
  options.threshold = table->number("threshold", Limits::above(0, 100)).value_or(options.threshold);
  options.deepest_shadow = table->number("deepest_shadow", {0, 1}).value_or(options.deepest_shadow);
  if (table->has("memory_frames") && !scene.clean.empty()) {
    throw table->error_at("memory_frames", "has no meaning beside 'clean'", "leave it out");
  }
  options.memory_frames = static_cast<int>(table->integer("memory_frames", 2, 100000).value_or(options.memory_frames));
  return scene;
}

FileMatteScene read_file(const Table& foreground) {
  const Table file = foreground.required("file", foreground.table("file"));
  if (file.exactly_one({"video", "images"}) == "video") return {existing_file(file, "video").string()};
  return {image_pattern(file, "images", "%*?[", "mattes/%04d.png")};
}

SegmentationScene read_segmentation(const std::optional<Table>& table) {
  if (!table || !table->has("model")) return {};
  return {existing_file(*table, "model").string()};
}

ForegroundScene::Method read_method(const Table& foreground, const std::string& name) {
  if (name == "chroma") return read_chroma(foreground.table("chroma"));
  if (name == "difference") return read_difference(foreground.table("difference"));
  if (name == "file") return read_file(foreground);
  if (name == "segmentation") return read_segmentation(foreground.table("segmentation"));
  throw foreground.wrong("method", all_methods);
}

PixelRect read_within(const Table& foreground) {
  const auto* array = std::get_if<toml::Array>(&foreground.find("within_px")->held);
  std::array<int, 4> v{};
  bool good = array != nullptr && array->size() == 4;
  for (std::size_t i = 0; good && i < 4; ++i) {
    const auto* number = std::get_if<std::int64_t>(&(*array)[i].held);
    good = number != nullptr && *number >= (i < 2 ? 0 : 1) && *number <= 65536;
    if (good) v[i] = static_cast<int>(*number);
  }
  if (!good) throw foreground.wrong("within_px", "a rectangle [left, top, width, height] in whole pixels");
  return {v[0], v[1], v[2], v[3]};
}

std::optional<matte::ThingLineOptions> read_line(const Table& foreground) {
  matte::ThingLineOptions options;
  if (const auto outline = foreground.table_unless_flag("outline")) {
    options.width_px = outline->number("width_px", Limits::above(0, most_line_px)).value_or(options.width_px);
    options.colour = read_colour(*outline, "colour").value_or(options.colour);
  } else if (!foreground.has("outline") || !*foreground.flag("outline")) {
    return std::nullopt;
  }
  return options;
}

}  // namespace

toml::Schema foreground_schema() {
  return {{.path = "foreground",
           .keys = {"name", "method", "combine", "chroma", "difference", "file", "segmentation", "refine", "distance_m",
                    "on_ground", "within_px", "outline"},
           .repeated = true},
          {.path = "foreground.chroma", .keys = {"key", "clip_low", "clip_high", "hue_deg", "despill"}},
          {.path = "foreground.difference", .keys = {"clean", "threshold", "deepest_shadow", "memory_frames"}},
          {.path = "foreground.file", .keys = {"video", "images"}},
          {.path = "foreground.segmentation", .keys = {"model"}},
          {.path = "foreground.outline", .keys = {"width_px", "colour"}}};
}

ForegroundScene read_foreground(const Table& foreground) {
  using Combine = matte::ForegroundOptions::Combine;
  ForegroundScene scene;
  scene.name = foreground.text("name").value_or("foreground");
  const std::vector<std::string> methods = read_methods(foreground);
  for (const std::string& name : methods) scene.methods.push_back(read_method(foreground, name));
  for (const std::string_view table : {"chroma", "difference", "file", "segmentation"}) {
    if (foreground.has(table) && std::find(methods.begin(), methods.end(), table) == methods.end()) {
      throw foreground.error_at(table, "isn't among the methods", "leave it out, or add it to 'method'");
    }
  }
  if (foreground.has("combine") && methods.size() < 2) {
    throw foreground.error_at("combine", "needs several methods", "leave it out");
  }
  scene.options.combine =
      read_choice<Combine>(
          foreground, "combine",
          {{"maximum", Combine::Maximum}, {"minimum", Combine::Minimum}, {"confidence", Combine::Confidence}})
          .value_or(scene.options.combine);
  if (foreground.has("within_px")) scene.options.within = read_within(foreground);
  // A network's borders are as coarse as its pixels.
  const bool coarse = std::find(methods.begin(), methods.end(), "segmentation") != methods.end();
  scene.options.refine = foreground.flag("refine").value_or(coarse);
  scene.options.line = read_line(foreground);
  foreground.exclude("distance_m", "on_ground");
  scene.distance_m = foreground.number("distance_m", Limits::above(0, 1e6));
  scene.on_ground = foreground.flag("on_ground").value_or(false);
  return scene;
}

}  // namespace rinkaku::pipeline

#include "pipeline/scene.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <numeric>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/scene_schema.h"
#include "pipeline/toml/table.h"
#include "pipeline/track/dictionary.h"

namespace rinkaku::pipeline {
namespace {

namespace fs = std::filesystem;
using toml::Limits;
using toml::Table;

// Beyond these a value is a slip of the pen: a thousand kilometres, and a millionth or a million times a mesh's size.
constexpr Limits metres{-1e6, 1e6};
constexpr double smallest_scale = 1e-6, largest_scale = 1e6;

class SceneReader {
 public:
  SceneReader(const toml::Document& document, const SceneOptions& options) : document_(document), options_(options) {}

  Scene read() const;

 private:
  PlateScene read_plate(const Table& plate) const;
  TrackScene read_track(const Table& track) const;
  ObjectScene read_object(const Table& object) const;
  OutputScene read_output(const Table& output) const;
  fs::path existing_file(const Table& table, std::string_view key) const;
  std::string pattern(const Table& table, std::string_view key, std::string_view signs, const char* example) const;

  const toml::Document& document_;
  const SceneOptions& options_;
};

/// The path behind a key, which must name a file that can be read.
fs::path SceneReader::existing_file(const Table& table, std::string_view key) const {
  fs::path path = toml::resolved(table.required(key, table.text(key)), document_.file());
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw table.error_at(key, "names a file that doesn't exist: " + path.string());
  if (fs::is_directory(status)) throw table.error_at(key, "names a folder, not a file: " + path.string());
  if (fs::is_character_file(status) || fs::is_block_file(status)) {
    throw table.error_at(key, "names a device: " + path.string(), "give a recorded file");
  }
  if (fs::is_regular_file(status) && !std::ifstream(path)) {
    throw table.error_at(key, "names a file that can't be read: " + path.string(), "check its permissions");
  }
  return path;
}

std::string SceneReader::pattern(const Table& table, std::string_view key, std::string_view signs,
                                 const char* example) const {
  const std::string text = table.required(key, table.text(key));
  if (text.find_first_of(signs) == std::string::npos) {
    throw table.wrong(key, std::string("a pattern of image files such as \"") + example + "\"");
  }
  return toml::resolved(text, document_.file()).string();
}

Rational read_fps(const Table& plate) {
  if (plate.has("video"))
    throw plate.error_at("fps", "goes with 'images': a video has times of its own", "leave it out");
  const double fps = *plate.number("fps", {0.001, 1000});
  // 23.976 (or 23.98), 29.97 and their like stand for 24 and 30 times 1000/1001.
  const std::int64_t whole = std::llround(fps);
  const bool ntsc = whole > 0 && (whole % 12 == 0 || whole % 15 == 0);
  if (ntsc && std::abs(fps - static_cast<double>(whole) * 1000 / 1001) < 0.005) return {whole * 1000, 1001};
  const std::int64_t millionths = std::llround(fps * 1e6), divisor = std::gcd(millionths, std::int64_t{1'000'000});
  return {millionths / divisor, 1'000'000 / divisor};
}

PlateScene SceneReader::read_plate(const Table& plate) const {
  PlateScene scene;
  if (!options_.input.empty()) {
    plate.exclude("video", "images");
    scene.input = fs::absolute(options_.input).lexically_normal().string();
  } else if (plate.exactly_one({"video", "images"}) == "video") {
    scene.input = existing_file(plate, "video").string();
  } else {
    scene.input = pattern(plate, "images", "%*?[", "frames/%04d.png");
    const fs::path folder = fs::path(scene.input).parent_path();
    std::error_code error;
    const bool plain = folder.string().find_first_of("%*?[") == std::string::npos;
    if (plain && !fs::is_directory(folder, error)) {
      throw plate.error_at("images", "names a folder that doesn't exist: " + folder.string());
    }
  }
  if (plate.has("fps")) scene.fps = read_fps(plate);
  if (plate.has("camera")) scene.camera = existing_file(plate, "camera");
  return scene;
}

MarkerTrack read_marker(const Table& marker) {
  MarkerTrack scene;
  scene.dictionary = marker.required("dictionary", marker.text("dictionary"));
  if (scene.dictionary.starts_with("DICT_")) scene.dictionary.erase(0, 5);
  const int markers = track::dictionary_size(marker.where("dictionary"), scene.dictionary);
  scene.id = static_cast<int>(marker.required("id", marker.integer("id", 0, markers - 1)));
  scene.size_m = marker.required("size_m", marker.number("size_m", Limits::above(0, 100)));
  return scene;
}

LockedTrack read_locked(const Table& locked) {
  LockedTrack scene;
  scene.position_m = locked.required("position_m", locked.vector3("position_m", metres));
  scene.look_at_m = locked.required("look_at_m", locked.vector3("look_at_m", metres));
  scene.up = locked.vector3("up").value_or(scene.up);
  const glm::dvec3 view = scene.look_at_m - scene.position_m;
  if (glm::length(view) < 1e-6) throw locked.error_at("look_at_m", "must differ from 'position_m'");
  const double up_length = glm::length(scene.up);
  if (!(up_length > 0) || !std::isfinite(up_length)) {
    throw locked.error_at("up", "must be a direction of some length", "give one such as [0, 0, 1]");
  }
  if (glm::length(glm::cross(glm::normalize(view), scene.up / up_length)) < 1e-6) {
    throw locked.error("the camera looks along 'up' in locked of [track]",
                       "give 'up' another direction, e.g. [0, 1, 0]");
  }
  return scene;
}

TrackScene SceneReader::read_track(const Table& track) const {
  TrackScene scene;
  const std::string_view from = track.exactly_one({"marker", "board", "poses", "locked"});
  if (from == "marker") {
    scene.from = read_marker(track.required("marker", track.table("marker")));
  } else if (from == "board") {
    scene.from = BoardTrack{existing_file(track, "board")};
  } else if (from == "poses") {
    scene.from = PoseFileTrack{existing_file(track, "poses")};
  } else {
    scene.from = read_locked(track.required("locked", track.table("locked")));
    if (track.has("smoothing")) throw track.error_at("smoothing", "has no meaning beside 'locked'", "leave it out");
  }
  // Only markers get lost.
  for (const std::string_view key : {"hold_s", "fade_s"}) {
    if (track.has(key) && from != "marker" && from != "board") {
      throw track.error_at(key, "has no meaning beside '" + std::string(from) + "'", "leave it out");
    }
  }
  scene.smoothing.on = from == "marker" || from == "board";
  if (const auto smoothing = track.table_unless_flag("smoothing")) {
    scene.smoothing.on = true;
    scene.smoothing.min_cutoff_hz =
        smoothing->number("min_cutoff_hz", Limits::above(0, 1000)).value_or(scene.smoothing.min_cutoff_hz);
    scene.smoothing.beta = smoothing->number("beta", {0, 1e6}).value_or(scene.smoothing.beta);
  } else if (track.has("smoothing")) {
    scene.smoothing.on = track.flag("smoothing").value();
  }
  scene.hold_s = track.number("hold_s", {0, 3600}).value_or(scene.hold_s);
  scene.fade_s = track.number("fade_s", {0, 3600}).value_or(scene.fade_s);
  return scene;
}

/// "#rrggbb", or three numbers from 0 to 1.
std::optional<std::array<double, 3>> read_colour(const Table& table, std::string_view key) {
  if (!table.has(key)) return std::nullopt;
  if (std::holds_alternative<toml::Array>(table.find(key)->held)) {
    const glm::dvec3 rgb = *table.vector3(key, {0, 1});
    return std::array{rgb.r, rgb.g, rgb.b};
  }
  const auto* text = std::get_if<std::string>(&table.find(key)->held);
  const bool good = text && text->size() == 7 && text->front() == '#' &&
                    text->find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!good) throw table.wrong(key, "a colour, \"#rrggbb\" or [r, g, b] from 0 to 1");
  const unsigned long rgb = std::stoul(text->substr(1), nullptr, 16);
  return std::array{static_cast<double>(rgb >> 16 & 255) / 255, static_cast<double>(rgb >> 8 & 255) / 255,
                    static_cast<double>(rgb & 255) / 255};
}

/// Three factors, none of them 0; negative ones mirror.
glm::dvec3 read_scale(const Table& object) {
  const toml::Value& value = *object.find("scale");
  const bool three = std::holds_alternative<toml::Array>(value.held);
  const bool one = std::holds_alternative<double>(value.held) || std::holds_alternative<std::int64_t>(value.held);
  if (!one && !three) throw object.wrong("scale", "a number or three numbers [x, y, z]");
  const Limits limits{-largest_scale, largest_scale};
  const glm::dvec3 scale = three ? *object.vector3("scale", limits) : glm::dvec3(*object.number("scale", limits));
  for (int i = 0; i < 3; ++i) {
    if (std::abs(scale[i]) < smallest_scale) throw object.error_at("scale", "must not be 0 or nearly 0");
  }
  return scale;
}

std::optional<ToonScene> read_toon(const Table& object) {
  ToonScene scene;
  if (const auto toon = object.table_unless_flag("toon")) {
    scene.bands = static_cast<int>(toon->integer("bands", 2, 16).value_or(scene.bands));
    scene.shade_colour = read_colour(*toon, "shade_colour").value_or(scene.shade_colour);
  } else if (object.has("toon") && !*object.flag("toon")) {
    return std::nullopt;
  }
  return scene;
}

/// The value that a key's word stands for; empty if the key is absent.
template <class Value>
std::optional<Value> read_choice(const Table& table, std::string_view key,
                                 std::initializer_list<std::pair<std::string_view, Value>> choices) {
  const auto text = table.text(key);
  if (!text) return std::nullopt;
  std::string expected;
  std::size_t left = choices.size();
  for (const auto& [word, value] : choices) {
    if (*text == word) return value;
    expected += "\"" + std::string(word) + "\"" + (--left > 1 ? ", " : left == 1 ? " or " : "");
  }
  throw table.wrong(key, expected);
}

void read_width(const Table& outline, OutlineScene& scene) {
  outline.exclude("width_px", "width_m");
  scene.width_px = outline.number("width_px", Limits::above(0, 100)).value_or(scene.width_px);
  scene.width_m = outline.number("width_m", Limits::above(0, 1000));
  for (const std::string_view key : {"min_px", "max_px"}) {
    if (outline.has(key) && !scene.width_m) {
      throw outline.error_at(key, "goes with 'width_m'", "leave it out, or give 'width_m' in place of 'width_px'");
    }
  }
  scene.min_px = outline.number("min_px", {0, 100}).value_or(scene.min_px);
  scene.max_px = outline.number("max_px", Limits::above(0, 100)).value_or(std::max(scene.max_px, scene.min_px));
  if (scene.max_px < scene.min_px) throw outline.error_at("max_px", "must not be below 'min_px'");
}

void read_curvature_width(const Table& outline, OutlineScene& scene) {
  using O = OutlineScene;
  scene.method =
      read_choice<O::Method>(outline, "method", {{"uniform", O::Method::Uniform}, {"curvature", O::Method::Curvature}})
          .value_or(scene.method);
  for (const std::string_view key :
       {"curvature", "sign", "exaggeration", "saturation", "curve", "min_factor", "smoothing"}) {
    if (outline.has(key) && scene.method != O::Method::Curvature) {
      throw outline.error_at(key, "goes with method = \"curvature\"", "add that, or leave it out");
    }
  }
  scene.curvature = read_choice<O::Curvature>(outline, "curvature",
                                              {{"mean", O::Curvature::Mean},
                                               {"gauss", O::Curvature::Gauss},
                                               {"largest", O::Curvature::Largest},
                                               {"smallest", O::Curvature::Smallest}})
                        .value_or(scene.curvature);
  scene.sign = read_choice<O::Sign>(
                   outline, "sign",
                   {{"magnitude", O::Sign::Magnitude}, {"convex", O::Sign::Convex}, {"concave", O::Sign::Concave}})
                   .value_or(scene.sign);
  if (scene.method == O::Method::Curvature) scene.taper_px = 15;
  scene.exaggeration = outline.number("exaggeration", {0, 20}).value_or(scene.exaggeration);
  scene.saturation = outline.number("saturation", Limits::above(0, 1000)).value_or(scene.saturation);
  scene.curve = outline.number("curve", Limits::above(0, 10)).value_or(scene.curve);
  scene.min_factor = outline.number("min_factor", Limits::above(0, 1)).value_or(scene.min_factor);
  scene.smoothing = static_cast<int>(outline.integer("smoothing", 0, 100).value_or(scene.smoothing));
}

std::optional<OutlineScene> read_outline(const Table& object) {
  OutlineScene scene;
  if (const auto outline = object.table_unless_flag("outline")) {
    read_width(*outline, scene);
    read_curvature_width(*outline, scene);
    scene.taper_px = outline->number("taper_px", {0, 1000}).value_or(scene.taper_px);
    scene.colour = read_colour(*outline, "colour").value_or(scene.colour);
  } else if (!object.has("outline") || !*object.flag("outline")) {
    return std::nullopt;
  }
  return scene;
}

ObjectScene SceneReader::read_object(const Table& object) const {
  ObjectScene scene;
  scene.mesh = existing_file(object, "mesh");
  scene.name = object.text("name").value_or(scene.mesh.filename().string());
  scene.position_m = object.vector3("position_m", metres).value_or(scene.position_m);
  scene.rotation_deg = object.vector3("rotation_deg", {-1e6, 1e6}).value_or(scene.rotation_deg);
  object.exclude("height_m", "scale");
  scene.height_m = object.number("height_m", Limits::above(0, 1e6));
  if (object.has("scale")) scene.scale = read_scale(object);
  if (const auto up = object.text("up")) {
    if (*up != "x" && *up != "y" && *up != "z") throw object.wrong("up", "\"x\", \"y\" or \"z\"");
    scene.up = up->front();
  }
  // Who gives a scale means the mesh's own coordinates.
  const std::string anchor = object.text("anchor").value_or(object.has("scale") ? "origin" : "base");
  if (anchor != "base" && anchor != "origin") throw object.wrong("anchor", "\"base\" or \"origin\"");
  scene.anchor = anchor == "base" ? ObjectScene::Anchor::Base : ObjectScene::Anchor::Origin;
  scene.crease_deg = object.number("crease_deg", {0, 180}).value_or(scene.crease_deg);
  scene.colour = read_colour(object, "colour");
  scene.holdout = object.flag("holdout").value_or(false);
  if (scene.holdout) {
    for (const std::string_view key : {"colour", "toon", "outline"}) {
      if (object.has(key))
        throw object.error_at(key, "has no meaning for a holdout, which is not drawn", "leave it out");
    }
    return scene;
  }
  scene.toon = read_toon(object);
  scene.outline = read_outline(object);
  return scene;
}

OutputScene SceneReader::read_output(const Table& output) const {
  OutputScene scene;
  output.exclude("video", "images");
  if (const auto video = output.text("video")) {
    scene.path = *video == "-" ? *video : toml::resolved(*video, document_.file()).string();
  } else if (output.has("images")) {
    scene.path = pattern(output, "images", "%", "frames/%04d.png");
    for (const std::string_view key : {"codec", "bit_rate"}) {
      if (output.has(key)) throw output.error_at(key, "goes with 'video', not with 'images'", "leave it out");
    }
  }
  scene.codec = output.text("codec").value_or("");
  scene.bit_rate = output.integer("bit_rate", 1000, 10'000'000'000).value_or(0);
  const std::string content = output.text("content").value_or("composite");
  if (content != "composite" && content != "cg") throw output.wrong("content", "\"composite\" or \"cg\"");
  scene.content = content == "cg" ? OutputScene::Content::Cg : OutputScene::Content::Composite;
  return scene;
}

LightScene read_light(const Table& light) {
  LightScene scene;
  scene.direction = light.vector3("direction", metres).value_or(scene.direction);
  if (!(glm::length(scene.direction) > 1e-9)) {
    throw light.error_at("direction", "must not be [0, 0, 0]", "give the way towards the light");
  }
  return scene;
}

Scene SceneReader::read() const {
  const Table root = document_.root();
  const std::string file = document_.file().string();
  Scene scene;
  scene.file = fs::absolute(document_.file()).lexically_normal();
  if (document_.empty()) {
    throw input_error(file, "the scene is empty", "it needs at least [plate] with 'video' or 'images'");
  }
  if (!root.has("plate")) throw input_error(file, "[plate] is missing", "add it, with 'video' or 'images'");
  scene.plate = read_plate(*root.table("plate"));
  if (const auto track = root.table("track")) scene.track = read_track(*track);
  if (const auto light = root.table("light")) scene.light = read_light(*light);
  for (const Table& object : root.tables("object")) {
    if (!scene.track) {
      throw object.error("[[object]] needs a camera pose", "add [track] with one of marker, board, poses, locked");
    }
    if (scene.plate.camera.empty()) {
      throw object.error("[[object]] needs the camera's intrinsics", "add 'camera' to [plate], e.g. \"camera.yml\"");
    }
    scene.objects.push_back(read_object(object));
  }
  if (const auto output = root.table("output")) {
    scene.output = read_output(*output);
    if (!scene.output.path.empty() && scene.output.path == scene.plate.input) {
      throw output->error_at(output->has("video") ? "video" : "images", "is the filmed input itself",
                             "name another file");
    }
  }
  return scene;
}

}  // namespace

Scene read_scene(const fs::path& file, const SceneOptions& options) {
  const toml::Document document(file, scene_schema());
  return SceneReader(document, options).read();
}

}  // namespace rinkaku::pipeline

#include "apps/rinkaku/viewer/arrow_editor.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <tuple>

#include <glm/geometric.hpp>

#include "pipeline/track/camera_file.h"

namespace rinkaku::app {
namespace {

using pipeline::WaterArrows;

// Shorter than this it was a click.
constexpr double least_px = 4;

// To the millimetre, or the tenth of a pixel, without zeros at the end.
std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  std::string s = text;
  while (s.back() == '0') s.pop_back();
  if (s.back() == '.') s.pop_back();
  return s == "-0" ? "0" : s;
}
std::string point_text(const glm::dvec3& p) {
  return "[" + number(p.x, 3) + ", " + number(p.y, 3) + ", " + number(p.z, 3) + "]";
}
std::string pixel_text(glm::dvec2 p) { return "[" + number(p.x, 1) + ", " + number(p.y, 1) + "]"; }

toml::Path arrows_of(std::size_t surface) { return {{"water"}, {"surface", surface}, {"arrow"}}; }
toml::Path arrow_at(std::size_t surface, std::size_t in_file) {
  return {{"water"}, {"surface", surface}, {"arrow", in_file}};
}
toml::Path key_of(toml::Path path, const char* key) {
  path.push_back({key});
  return path;
}

std::vector<std::string> entries(std::int64_t frame, const std::string& from, const std::string& to) {
  std::vector<std::string> all;
  if (frame > 0) all.push_back("frame = " + std::to_string(frame));
  all.push_back("from_m = " + from);
  all.push_back("to_m = " + to);
  return all;
}

double distance_to_line(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 d = b - a;
  const double length2 = glm::dot(d, d);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : 0;
  return glm::distance(p, a + d * t);
}

}  // namespace

void ArrowEditor::look(const SceneFile& file, double frames_per_s, std::int64_t frame,
                       const std::optional<RigidTransform>& camera_from_world) {
  if (file.text() != text_ || frames_per_s != frames_per_s_) {
    text_.clear();  // until all went well
    arrows_.reset();
    shown_.clear();
    water_ = file.scene().water;
    grip_ = Grip::None;
    if (water_) arrows_.emplace(file.scene(), track::read_camera(file.scene().plate.camera), frames_per_s);
    text_ = file.text();
    frames_per_s_ = frames_per_s;
  }
  frame_ = frame;
  camera_from_world_ = camera_from_world;
  shown_.clear();
  if (arrows_ && camera_from_world_) shown_ = arrows_->shown(frame_, *camera_from_world_);
}

const ArrowEditor::Arrow* ArrowEditor::chosen() const {
  if (!selected_) return nullptr;
  const auto found = std::find_if(shown_.begin(), shown_.end(), [this](const Arrow& a) {
    return a.surface == selected_->surface && a.number == selected_->number;
  });
  return found == shown_.end() ? nullptr : &*found;
}

const pipeline::WaterArrowScene& ArrowEditor::in_scene(const Arrow& arrow) const {
  const auto& all = water_->surfaces[arrow.surface].arrows;
  const auto first = std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.frame == arrow.key_frame; });
  return *(first + static_cast<std::ptrdiff_t>(arrow.number));
}

std::pair<glm::dvec2, glm::dvec2> ArrowEditor::dragged() const {
  const Arrow* arrow = chosen();
  const glm::dvec2 by = now_px_ - pressed_px_;
  switch (arrow ? grip_ : Grip::New) {
    case Grip::From:
      return {arrow->from_px + by, arrow->to_px};
    case Grip::To:
      return {arrow->from_px, arrow->to_px + by};
    case Grip::Whole:
      return {arrow->from_px + by, arrow->to_px + by};
    default:
      return {pressed_px_, now_px_};
  }
}

std::optional<WaterArrows::Placed> ArrowEditor::placed() const {
  if (!arrows_ || !camera_from_world_) return std::nullopt;
  const auto [from, to] = dragged();
  const Arrow* arrow = grip_ == Grip::New ? nullptr : chosen();
  return arrows_->placed(*camera_from_world_, from, to,
                         arrow ? std::optional<std::size_t>(arrow->surface) : std::nullopt);
}

std::vector<ArrowEditor::Sketch> ArrowEditor::sketches() const {
  std::vector<Sketch> all;
  const Arrow* held = grip_ == Grip::None || grip_ == Grip::New ? nullptr : chosen();
  const bool moved = grip_ != Grip::None && glm::distance(pressed_px_, now_px_) >= least_px;
  for (const Arrow& arrow : shown_) {
    Sketch sketch{arrow.from_px, arrow.to_px, &arrow == chosen(), true};
    if (&arrow == held && moved) {
      std::tie(sketch.from_px, sketch.to_px) = dragged();
      sketch.fits = placed().has_value();
    }
    all.push_back(sketch);
  }
  if (grip_ == Grip::New && moved) all.push_back({pressed_px_, now_px_, true, placed().has_value()});
  return all;
}

std::optional<std::int64_t> ArrowEditor::key_frame() const {
  const Arrow* arrow = chosen();
  if (arrow) return arrow->key_frame;
  return shown_.empty() ? std::nullopt : std::optional(shown_.front().key_frame);
}

void ArrowEditor::press(glm::dvec2 at_px, double reach_px) {
  pressed_px_ = now_px_ = at_px;
  grip_ = Grip::New;
  selected_.reset();
  double nearest = reach_px;
  const auto take = [&](const Arrow& arrow, Grip grip, double distance) {
    if (distance > nearest) return;
    nearest = distance;
    grip_ = grip;
    selected_ = Chosen{arrow.surface, arrow.number};
  };
  // Ends are taken rather than the line between them.
  for (const Arrow& arrow : shown_) take(arrow, Grip::From, glm::distance(at_px, arrow.from_px));
  for (const Arrow& arrow : shown_) take(arrow, Grip::To, glm::distance(at_px, arrow.to_px));
  if (selected_) return;
  for (const Arrow& arrow : shown_) take(arrow, Grip::Whole, distance_to_line(at_px, arrow.from_px, arrow.to_px));
}

void ArrowEditor::drag(glm::dvec2 at_px) { now_px_ = at_px; }

std::optional<std::string> ArrowEditor::release() {
  const bool moved = glm::distance(pressed_px_, now_px_) >= least_px;
  const auto to = grip_ != Grip::None && moved ? placed() : std::nullopt;
  const Arrow* arrow = grip_ == Grip::New ? nullptr : chosen();
  const Grip grip = std::exchange(grip_, Grip::None);
  if (!to) return std::nullopt;
  if (grip == Grip::New) {
    const auto& all = water_->surfaces[to->surface].arrows;
    const auto of_key =
        std::count_if(all.begin(), all.end(), [&](const auto& a) { return a.frame == all.front().frame; });
    selected_ = Chosen{to->surface, static_cast<std::size_t>(of_key)};
    return with_new(*to);
  }
  return arrow ? with_moved(*arrow, *to) : std::nullopt;
}

std::string ArrowEditor::with_new(const WaterArrows::Placed& placed) const {
  std::set<std::int64_t> frames;
  for (const auto& arrow : water_->surfaces[placed.surface].arrows) frames.insert(arrow.frame);
  if (frames.empty()) frames.insert(0);
  std::string text = text_;
  for (const std::int64_t frame : frames) {
    text = toml::with_table(text, arrows_of(placed.surface),
                            entries(frame, point_text(placed.from_m), point_text(placed.to_m)));
  }
  return text;
}

std::optional<std::string> ArrowEditor::with_moved(const Arrow& arrow, const WaterArrows::Placed& placed) const {
  const pipeline::WaterArrowScene& scene = in_scene(arrow);
  const toml::Path path = arrow_at(arrow.surface, scene.in_file);
  if (!scene.on_screen) {
    const std::string text = toml::with_value(text_, key_of(path, "from_m"), point_text(placed.from_m));
    return toml::with_value(text, key_of(path, "to_m"), point_text(placed.to_m));
  }
  // It is written as its own frame's camera sees it.
  const auto from = arrows_->pixel_at(scene.frame, placed.from_m), to = arrows_->pixel_at(scene.frame, placed.to_m);
  if (!from || !to) return std::nullopt;
  const std::string text = toml::with_value(text_, key_of(path, "from_px"), pixel_text(*from));
  return toml::with_value(text, key_of(path, "to_px"), pixel_text(*to));
}

std::optional<std::string> ArrowEditor::without_selected() {
  if (!selected_ || !water_) return std::nullopt;
  const Chosen gone = *std::exchange(selected_, std::nullopt);
  if (gone.surface >= water_->surfaces.size()) return std::nullopt;
  // The arrow of that number of each key frame; from the file's end, so that those before keep their places.
  std::vector<std::size_t> places;
  std::size_t number = 0;
  const auto& all = water_->surfaces[gone.surface].arrows;
  for (std::size_t i = 0; i < all.size(); ++i) {
    number = i > 0 && all[i].frame == all[i - 1].frame ? number + 1 : 0;
    if (number == gone.number) places.push_back(all[i].in_file);
  }
  if (places.empty()) return std::nullopt;
  std::sort(places.rbegin(), places.rend());
  std::string text = text_;
  for (const std::size_t place : places) text = toml::without_table(text, arrow_at(gone.surface, place));
  return text;
}

std::optional<std::string> ArrowEditor::with_key_here() const {
  if (shown_.empty() || !camera_from_world_) return std::nullopt;
  const Arrow& like = chosen() ? *chosen() : shown_.front();
  const auto& all = water_->surfaces[like.surface].arrows;
  if (std::any_of(all.begin(), all.end(), [this](const auto& a) { return a.frame == frame_; })) return std::nullopt;
  std::string text = text_;
  std::size_t number = 0;
  for (const pipeline::WaterArrowScene& scene : all) {
    if (scene.frame != like.key_frame) continue;
    glm::dvec3 from = scene.from_m, to = scene.to_m;
    if (scene.on_screen) {
      const auto seen = std::find_if(shown_.begin(), shown_.end(),
                                     [&](const Arrow& a) { return a.surface == like.surface && a.number == number; });
      if (seen == shown_.end()) return std::nullopt;
      const auto placed = arrows_->placed(*camera_from_world_, seen->from_px, seen->to_px, like.surface);
      if (!placed) return std::nullopt;
      from = placed->from_m, to = placed->to_m;
    }
    ++number;
    text = toml::with_table(text, arrows_of(like.surface), entries(frame_, point_text(from), point_text(to)));
  }
  return text;
}

}  // namespace rinkaku::app

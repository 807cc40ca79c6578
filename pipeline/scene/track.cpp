#include "pipeline/scene/track.h"

#include <cmath>
#include <string_view>

#include <glm/geometric.hpp>

#include "pipeline/scene/values.h"
#include "pipeline/track/dictionary.h"

namespace rinkaku::pipeline {
namespace {

using toml::Limits;
using toml::Table;

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

}  // namespace

toml::Schema track_schema() {
  return {
      {.path = "track", .keys = {"marker", "board", "poses", "locked", "smoothing", "hold_s", "fade_s"}},
      {.path = "track.marker", .keys = {"dictionary", "id", "size_m"}},
      {.path = "track.locked", .keys = {"position_m", "look_at_m", "up"}},
      {.path = "track.smoothing", .keys = {"min_cutoff_hz", "beta"}},
  };
}

TrackScene read_track(const Table& track) {
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

}  // namespace rinkaku::pipeline

#include "pipeline/stages/water_set_up.h"

#include <memory>
#include <variant>

#include "pipeline/frame/error.h"
#include "pipeline/stages/small_picture.h"
#include "pipeline/track/locked.h"
#include "pipeline/track/pose_file.h"

namespace rinkaku::pipeline {
namespace {

glm::vec3 colour(const std::array<double, 3>& c) { return glm::vec3(c[0], c[1], c[2]); }

// A pixel of the recording in the pinhole picture, which water is drawn in.
glm::dvec2 without_lens(const std::string& where, const CameraModel& camera, glm::dvec2 pixel) {
  if (!camera.has_distortion()) return pixel;
  const auto n = undistort(camera, to_normalised(camera, pixel), max_undistorted_radius(camera));
  if (!n) throw input_error(where, "it lies where the lens shows nothing", "draw it inside the picture");
  return to_pixels(camera, *n);
}

}  // namespace

struct KnownPoses::File {
  track::PoseTable table;
};

KnownPoses::KnownPoses(const Scene& scene) {
  if (!scene.track) return;
  if (const auto* locked = std::get_if<LockedTrack>(&scene.track->from)) {
    still_ = track::camera_from_world(scene.file.string(), {locked->position_m, locked->look_at_m, locked->up});
  } else if (const auto* file = std::get_if<PoseFileTrack>(&scene.track->from)) {
    file_ = std::make_unique<File>(File{track::read_poses(file->poses)});
  }
}
KnownPoses::~KnownPoses() = default;

std::optional<RigidTransform> KnownPoses::at(std::int64_t frame, double frames_per_s) const {
  if (still_) return still_;
  if (!file_) return std::nullopt;
  const auto pose = file_->table.world_from_camera(frame, static_cast<double>(frame) / frames_per_s);
  if (!pose) return std::nullopt;
  return inverse(*pose);
}

water::Surface make_surface(const WaterSurfaceScene& scene, const KnownPoses& poses, double frames_per_s) {
  water::SurfaceOutline outline{scene.outline_m, scene.open, scene.obstacles_m};
  const auto pose = poses.at(0, frames_per_s);
  const glm::dvec3 eye = pose ? inverse(*pose).translation_m : glm::dvec3(0, -1e3, 0);
  return {scene.where, outline, eye};
}

std::vector<water::ArrowKey> make_arrows(const WaterSurfaceScene& scene, const water::Surface& surface,
                                         const CameraModel& camera, const KnownPoses& poses, double frames_per_s) {
  std::vector<water::ArrowKey> keys;
  for (const WaterArrowScene& arrow : scene.arrows) {
    if (keys.empty() || keys.back().frame != arrow.frame) keys.push_back({arrow.frame, {}});
    if (!arrow.on_screen) {
      keys.back().arrows.push_back(
          {surface.from_world(arrow.from_m), surface.direction_from_world(arrow.to_m - arrow.from_m)});
      continue;
    }
    const auto pose = poses.at(arrow.frame, frames_per_s);
    if (!pose) {
      throw input_error(arrow.where, "an arrow on the screen needs the camera's pose of its frame beforehand",
                        "give 'from_m' and 'to_m' in the world instead");
    }
    keys.back().arrows.push_back(water::arrow_from_screen(arrow.where, surface, camera, *pose,
                                                          without_lens(arrow.where, camera, arrow.from_px),
                                                          without_lens(arrow.where, camera, arrow.to_px)));
  }
  return keys;
}

water::PaintingOptions painting_options(const WaterScene& water, const WaterSurfaceScene& surface, bool camera_still,
                                        double frames_per_s) {
  water::PaintingOptions o;
  o.layers = water.layers;
  o.size.length_m = water.length_m.value_or(0);
  o.size.width = water.aspect;
  o.size.width_px = water.width_px.value_or(0);
  o.opacity = water.opacity;
  o.foreshortening = water.foreshortening;
  o.variety = water.variety;
  o.ripple = water.ripple;
  o.key_frames = water.key_frames;
  o.seconds_per_frame = 1 / frames_per_s;
  using Colours = water::PaintingOptions::Colours;
  switch (water.colours) {
    case WaterScene::Colours::Keys:
      o.colours = Colours::Keys;
      break;
    case WaterScene::Colours::Followed:
      o.colours = Colours::Followed;
      break;
    case WaterScene::Colours::Sampled:
      o.colours = Colours::Sampled;
      break;
    case WaterScene::Colours::ByCamera:
      o.colours = camera_still ? Colours::Keys : Colours::Followed;
      break;
  }
  o.mean = water.mean;
  o.flow.method = water.flow == WaterScene::Flow::Arrows ? water::FlowOptions::Method::Arrows
                                                         : water::FlowOptions::Method::DivergenceFree;
  o.flow.alpha_m = surface.alpha_m.value_or(water.alpha_m.value_or(0));
  o.flow.cells = water.cells;
  return o;
}

std::vector<glm::dvec2> brush_places(const WaterScene& water, const water::Surface& surface, const CameraModel& camera,
                                     const KnownPoses& poses, double frames_per_s) {
  std::vector<glm::dvec2> places;
  for (const WaterBrushScene& brush : water.brushes) {
    if (!brush.on_screen) {
      places.push_back(surface.from_world(brush.at_m));
      continue;
    }
    const auto pose = poses.at(0, frames_per_s);
    if (!pose) {
      throw input_error(brush.where, "a place on the screen needs the camera's pose of frame 0 beforehand",
                        "give 'at_m' in the world instead");
    }
    const auto seen = water::back_projected(surface, camera, *pose, without_lens(brush.where, camera, brush.at_px));
    if (!seen.found) {
      throw input_error(brush.where, "the brush's place lies at or above the water's horizon", "choose a lower one");
    }
    places.push_back(seen.at);
  }
  return places;
}

water::BrushSheet read_brushes(const WaterScene& water) {
  std::vector<water::Picture> pictures;
  for (const WaterBrushScene& brush : water.brushes) pictures.push_back(read_picture(brush.image, 512, true));
  return pictures.empty() ? water::BrushSheet{} : water::own_brushes(pictures);
}

water::MirrorOptions mirror_options(const WaterScene& water) {
  water::MirrorOptions o;
  o.plate = water.mirror_plate;
  o.surroundings_m = water.surroundings_m;
  o.reflection = water.reflection;
  o.water_colour = colour(water.colour);
  o.sky.zenith = colour(water.sky_zenith);
  o.sky.horizon = colour(water.sky_horizon);
  if (!water.panorama.empty()) o.sky.panorama = read_picture(water.panorama, 1024);
  return o;
}

}  // namespace rinkaku::pipeline

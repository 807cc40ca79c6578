#include "pipeline/trace_lines.h"

#include <algorithm>
#include <optional>

#include <glm/matrix.hpp>

#include "mesh/bounds.h"
#include "pipeline/frame/error.h"
#include "pipeline/objects/drawing.h"
#include "pipeline/objects/placement.h"
#include "pipeline/set_up.h"

namespace rinkaku::pipeline {
namespace {

const ObjectScene& object_named(const Scene& scene, const std::string& name) {
  if (scene.objects.empty()) throw input_error(scene.file.string(), "has no [[object]] to draw on");
  if (name.empty()) {
    if (scene.objects.size() == 1) return scene.objects.front();
    throw input_error(scene.file.string(), "has several objects", "say which was drawn on: --object NAME");
  }
  const auto found =
      std::find_if(scene.objects.begin(), scene.objects.end(), [&](const ObjectScene& o) { return o.name == name; });
  if (found != scene.objects.end()) return *found;
  std::string names;
  for (const ObjectScene& object : scene.objects) names += (names.empty() ? "" : ", ") + object.name;
  throw input_error(scene.file.string(), "has no object '" + name + "'", "its objects are: " + names);
}

RigidTransform pose_at(const Prepared& prepared, std::int64_t wanted) {
  const std::unique_ptr<source::Source> source = open_source(prepared);
  const std::unique_ptr<track::Tracker> tracker = make_tracker(prepared, source->description());
  std::int64_t number = 0;
  while (const std::optional<Frame> frame = source->next()) {
    const std::optional<TrackedPose> pose = tracker->track(*frame);
    if (number++ < wanted) continue;
    if (pose && pose->opacity > 0) return pose->camera_from_world;
    throw input_error(prepared.scene.plate.input, "the camera's pose is unknown in frame " + std::to_string(wanted),
                      "draw on another frame");
  }
  throw input_error(prepared.scene.plate.input,
                    "has " + std::to_string(number) + " frames, and none with the number " + std::to_string(wanted),
                    "frames count from 0");
}

}  // namespace

TracedLines trace_lines(const Prepared& prepared, const std::vector<std::vector<glm::dvec2>>& lines_px,
                        const TraceOptions& options) {
  const ObjectScene& object = object_named(prepared.scene, options.object);
  const CameraModel& camera = *prepared.camera;
  const RigidTransform camera_from_world = pose_at(prepared, options.frame);
  const mesh::Imported imported = load_mesh(object);
  const mesh::Mesh& mesh = imported.mesh;
  const glm::dmat4 object_from_camera =
      glm::inverse(to_matrix(camera_from_world) *
                   world_from_object(object, mesh::bounding_box(mesh.positions), imported.summary.up));
  const double largest = max_undistorted_radius(camera);
  const auto ray = [&](const glm::dvec2& px) -> std::optional<glm::dvec3> {
    const auto seen = undistort(camera, to_normalised(camera, px), largest);
    if (!seen) return std::nullopt;
    return glm::dvec3(object_from_camera * glm::dvec4(*seen, 1, 0));
  };
  TracedLines traced;
  traced.lines = outline::lay_onto(mesh, lines_px, glm::dvec3(object_from_camera[3]), ray);
  traced.triangles = mesh.triangles.size();
  if (traced.lines.empty()) {
    throw input_error("", "no line meets '" + object.name + "' in frame " + std::to_string(options.frame),
                      "draw on a frame that rinkaku rendered, in its pixels");
  }
  return traced;
}

}  // namespace rinkaku::pipeline

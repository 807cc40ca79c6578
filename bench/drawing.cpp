// What drawing a scene's CG costs, without decoding, compositing and encoding: CPU time a frame of all threads, the
// least of a few rounds. See docs/benchmarks.md.
//
//   rinkaku-bench-drawing [--frames N] [--rounds N] SCENE...
//
// Scenes give their poses as a file.

#include "pipeline/drawing.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"
#include "pipeline/passes/composite/lens_map.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/scene/scene.h"
#include "pipeline/track/camera_file.h"
#include "pipeline/track/pose_file.h"

namespace {

using namespace rinkaku;

double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

struct Shot {
  CameraModel camera{};
  std::vector<RigidTransform> camera_from_world{};
  std::optional<pipeline::Drawing> drawing{};
  passes::Layer layer{};
  double least_ms = 1e9;
  double pixels = 0;

  Shot(const std::string& scene_file, std::size_t frames) {
    const pipeline::Scene scene = pipeline::read_scene(scene_file);
    camera = track::read_camera(scene.plate.camera);
    const auto* from = scene.track ? std::get_if<pipeline::PoseFileTrack>(&scene.track->from) : nullptr;
    if (from == nullptr) throw input_error(scene_file, "has no poses from a file", "give [track] with 'poses'");
    const track::PoseTable poses = track::read_poses(from->poses);
    for (const track::FilePose& pose : poses.poses()) {
      if (camera_from_world.size() < frames) camera_from_world.push_back(inverse(pose.world_from_camera));
    }
    passes::PixelRect picture{0, 0, camera.width_px, camera.height_px};
    if (camera.has_distortion()) picture = passes::LensMap(camera).pinhole_rect();
    drawing.emplace(pipeline::make_drawing(scene, picture));
  }

  void run() {
    pixels = 0;
    const double start = cpu_ms();
    for (const RigidTransform& pose : camera_from_world) {
      drawing->renderer->draw({camera, pose}, layer);
      pixels += static_cast<double>(layer.rect.width_px) * layer.rect.height_px;
    }
    const auto frames = static_cast<double>(camera_from_world.size());
    least_ms = std::min(least_ms, (cpu_ms() - start) / frames);
    pixels /= frames;
  }
};

}  // namespace

int main(int argc, char** argv) {
  std::size_t frames = 200;
  int rounds = 5;
  std::vector<std::string> scenes;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--frames") == 0 && i + 1 < argc) {
      frames = static_cast<std::size_t>(std::max(1, std::atoi(argv[++i])));
    } else if (std::strcmp(argv[i], "--rounds") == 0 && i + 1 < argc) {
      rounds = std::max(1, std::atoi(argv[++i]));
    } else {
      scenes.emplace_back(argv[i]);
    }
  }
  if (scenes.empty()) {
    std::fprintf(stderr, "usage: %s [--frames N] [--rounds N] SCENE...\n", argv[0]);
    return 2;
  }
  try {
    for (const std::string& scene : scenes) {
      Shot shot(scene, frames);  // one at a time: each has an OpenGL context
      shot.run();                // the first warms up
      shot.least_ms = 1e9;
      for (int round = 0; round < rounds; ++round) shot.run();
      std::printf("%-40s %6.3f CPU ms a frame, %.0f pixels\n", scene.c_str(), shot.least_ms, shot.pixels);
      std::fflush(stdout);
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_status();
  }
  return 0;
}

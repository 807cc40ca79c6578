#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/scene/light.h"
#include "pipeline/scene/object.h"
#include "pipeline/scene/output.h"
#include "pipeline/scene/plate.h"
#include "pipeline/scene/track.h"

namespace rinkaku::pipeline {

/// The scene file as plain values: validated, defaults filled in, paths made absolute. Lengths in metres, angles in the
/// file's degrees; docs/scene.md describes every key. Each section's struct, schema and reader lie in a file of their
/// own beside this one.
struct Scene {
  std::filesystem::path file;
  PlateScene plate;
  std::optional<TrackScene> track;
  LightScene light;
  std::vector<ObjectScene> objects;
  OutputScene output;
};

/// What the call puts in the scene file's place.
struct SceneOptions {
  std::string input{};   ///< a video or image pattern instead of the plate's own, which then needn't exist; not checked
  std::string device{};  ///< a camera instead of the plate's own
  std::optional<std::string> text{};  ///< the scene as it shall be read, in place of what the file holds
};

/// Reads and validates a scene file (TOML). Throws Error (Input) naming file, line and column: unknown keys with the
/// nearest known one, wrong types, values out of range (NaN and infinity among them), missing files, keys that exclude
/// or need each other.
Scene read_scene(const std::filesystem::path& file, const SceneOptions& options = {});

}  // namespace rinkaku::pipeline

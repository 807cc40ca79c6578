#include "pipeline/scene/plate.h"

#include <string_view>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

namespace fs = std::filesystem;
using toml::Table;

constexpr const char* camera_keys[] = {"size_px", "format", "controls"};

}  // namespace

toml::Schema plate_schema() {
  return {{.path = "plate", .keys = {"video", "images", "device", "fps", "camera", "size_px", "format", "controls"}}};
}

PlateScene read_plate(const Table& plate, const OtherPlate& other) {
  PlateScene scene;
  const bool replaced = !other.input.empty() || !other.device.empty();
  const std::string_view kind = replaced && !plate.has("video") && !plate.has("images") && !plate.has("device")
                                    ? std::string_view()
                                    : plate.exactly_one({"video", "images", "device"});
  for (const char* key : camera_keys) {
    if (kind != "device" && plate.has(key)) throw plate.error_at(key, "goes with 'device'", "leave it out");
  }
  if (plate.has("fps") && kind == "video") {
    throw plate.error_at("fps", "goes with 'images' or 'device': a video has times of its own", "leave it out");
  }
  if (!other.device.empty() || (kind == "device" && other.input.empty())) {
    scene.device = read_camera_device(plate, other.device);
    scene.input = scene.device->device;
  } else if (!other.input.empty()) {
    scene.input = fs::absolute(other.input).lexically_normal().string();
  } else if (kind == "video") {
    scene.input = existing_file(plate, "video").string();
  } else {
    scene.input = image_pattern(plate, "images", "%*?[", "frames/%04d.png");
    const fs::path folder = fs::path(scene.input).parent_path();
    std::error_code error;
    const bool plain = folder.string().find_first_of("%*?[") == std::string::npos;
    if (plain && !fs::is_directory(folder, error)) {
      throw plate.error_at("images", "names a folder that doesn't exist: " + folder.string());
    }
  }
  if (plate.has("fps") && kind != "device") scene.fps = read_fps(plate);
  if (plate.has("camera")) scene.camera = existing_file(plate, "camera");
  return scene;
}

}  // namespace rinkaku::pipeline

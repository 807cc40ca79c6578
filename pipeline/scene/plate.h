#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/frame/picture_format.h"
#include "pipeline/scene/camera_device.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// [plate]: the filmed picture.
struct PlateScene {
  std::string input;                   ///< video file or image sequence pattern, absolute; or the camera
  std::optional<CameraDevice> device;  ///< then `input` is no file
  std::optional<Rational> fps;         ///< of an image sequence
  std::filesystem::path camera;        ///< camera.yml; empty if there is none (then nothing can be drawn)
};

toml::Schema plate_schema();

/// What the call gives in the plate's own place; at most one of them isn't empty.
struct OtherPlate {
  std::string input{};   ///< a video or a pattern of images
  std::string device{};  ///< a camera
};

/// Throws Error (Input).
PlateScene read_plate(const toml::Table& plate, const OtherPlate& other);

}  // namespace rinkaku::pipeline

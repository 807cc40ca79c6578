#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/frame/picture_format.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// `device` of [plate] and what goes with it: a camera in the recording's place.
struct CameraDevice {
  std::string device;  ///< "/dev/video0", or the camera's name
  int width_px = 0;    ///< 0: the calibrated size if there is a calibration, else up to the camera
  int height_px = 0;
  std::optional<Rational> fps;
  std::string format;  ///< four letters, "YUYV"; empty: any
  struct Control {
    std::string name;
    std::variant<std::int64_t, std::string> value;
    std::string where;
  };
  std::vector<Control> controls;  ///< in the file's order
};

/// Reads what stands in [plate]; `device` is in place of the file's own if it isn't empty. Throws Error (Input).
CameraDevice read_camera_device(const toml::Table& plate, const std::string& device);

}  // namespace rinkaku::pipeline

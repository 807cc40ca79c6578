#include "pipeline/scene/camera_device.h"

#include <cctype>
#include <cmath>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

constexpr double largest_side_px = 16384;

void read_size(const toml::Table& plate, CameraDevice& camera) {
  const toml::Value* size = plate.find("size_px");
  if (!size) return;
  const auto* sides = std::get_if<toml::Array>(&size->held);
  const auto side = [&](std::size_t i) -> std::int64_t {
    const auto* number = std::get_if<std::int64_t>(&(*sides)[i].held);
    return number ? *number : 0;
  };
  const auto good = [](std::int64_t px) { return px > 0 && px <= largest_side_px; };
  if (!sides || sides->size() != 2 || !good(side(0)) || !good(side(1))) {
    throw plate.wrong("size_px", "width and height in whole pixels, e.g. [1280, 720]");
  }
  camera.width_px = static_cast<int>(side(0));
  camera.height_px = static_cast<int>(side(1));
}

void read_controls(const toml::Table& plate, CameraDevice& camera) {
  const auto controls = plate.table("controls");
  if (!controls) return;
  for (const toml::Entry& entry : std::get<toml::Entries>(plate.find("controls")->held)) {
    CameraDevice::Control control{entry.key, std::int64_t{0}, controls->where(entry.key)};
    if (const auto* flag = std::get_if<bool>(&entry.value.held)) {
      control.value = std::int64_t{*flag};
    } else if (const auto* number = std::get_if<std::int64_t>(&entry.value.held)) {
      control.value = *number;
    } else if (const auto* text = std::get_if<std::string>(&entry.value.held)) {
      control.value = *text;
    } else {
      throw controls->wrong(entry.key, "a whole number, true, false, or a menu's entry as text");
    }
    camera.controls.push_back(std::move(control));
  }
}

}  // namespace

CameraDevice read_camera_device(const toml::Table& plate, const std::string& device) {
  CameraDevice camera;
  camera.device = device.empty() ? plate.required("device", plate.text("device")) : device;
  read_size(plate, camera);
  if (plate.has("fps")) camera.fps = read_fps(plate);
  if (const auto format = plate.text("format")) camera.format = *format;
  read_controls(plate, camera);
  return camera;
}

}  // namespace rinkaku::pipeline

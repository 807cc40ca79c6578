#include <cstdio>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/json_output.h"
#include "pipeline/frame/error.h"
#include "pipeline/source/v4l2/controls.h"
#include "pipeline/source/v4l2/device.h"
#include "pipeline/source/v4l2/modes.h"

namespace rinkaku::app {
namespace {

namespace v4l2 = source::v4l2;

struct Listed {
  v4l2::Device device;
  std::vector<v4l2::Mode> modes;
  std::vector<v4l2::Control> controls;
};

Listed look_at(const std::string& path) {
  v4l2::Device device = v4l2::open_device(path);
  std::vector<v4l2::Mode> modes = v4l2::modes_of(device);
  std::vector<v4l2::Control> controls = v4l2::controls_of(device);
  return {std::move(device), std::move(modes), std::move(controls)};
}

// Without names, everything that is a camera; what is none, or is not ours to open, is left out.
std::vector<Listed> look_at_all() {
  std::vector<Listed> found;
  for (const std::string& path : v4l2::device_paths()) {
    try {
      found.push_back(look_at(path));
    } catch (const Error&) {
    }
  }
  return found;
}

nlohmann::json to_json(const Listed& camera) {
  nlohmann::json modes = nlohmann::json::array(), controls = nlohmann::json::array();
  for (const v4l2::Mode& mode : camera.modes) {
    nlohmann::json rates = nlohmann::json::array();
    for (const Rational rate : mode.rates) rates.push_back(rate.value());
    modes.push_back({{"format", v4l2::name_of(mode.format)},
                     {"readable", v4l2::readable(mode.format)},
                     {"width", mode.width_px},
                     {"height", mode.height_px},
                     {"fps", rates}});
  }
  for (const v4l2::Control& control : camera.controls) {
    controls.push_back({{"name", control.name},
                        {"min", control.least},
                        {"max", control.most},
                        {"step", control.step},
                        {"default", control.preset},
                        {"value", control.value},
                        {"menu", control.menu},
                        {"idle", control.idle}});
  }
  const v4l2::Identity& identity = camera.device.identity;
  return {{"device", camera.device.path}, {"name", identity.card},     {"driver", camera.device.driver},
          {"bus", identity.bus},          {"serial", identity.serial}, {"modes", modes},
          {"controls", controls}};
}

void print(const Listed& camera) {
  const v4l2::Identity& identity = camera.device.identity;
  std::printf("%s: %s (%s, %s)\n", camera.device.path.c_str(), identity.card.c_str(), camera.device.driver.c_str(),
              identity.bus.c_str());
  for (const v4l2::Mode& mode : camera.modes) {
    std::string rates;
    for (const Rational rate : mode.rates) {
      char text[32];
      std::snprintf(text, sizeof text, "%s%.4g", rates.empty() ? "" : ", ", rate.value());
      rates += text;
    }
    std::printf("  %-4s %5dx%-5d %s%s%s\n", v4l2::name_of(mode.format).c_str(), mode.width_px, mode.height_px,
                rates.c_str(), rates.empty() ? "" : " /s", v4l2::readable(mode.format) ? "" : "  (not read)");
  }
  for (const v4l2::Control& control : camera.controls) {
    std::printf("  %s = %lld, %lld to %lld%s\n", control.name.c_str(), static_cast<long long>(control.value),
                static_cast<long long>(control.least), static_cast<long long>(control.most),
                control.idle ? " (governed by an automatic)" : "");
    for (std::size_t i = 0; i < control.menu.size(); ++i) {
      if (!control.menu[i].empty()) {
        std::printf("    %lld: %s\n", static_cast<long long>(control.least) + static_cast<long long>(i),
                    control.menu[i].c_str());
      }
    }
  }
}

}  // namespace

int devices(const DevicesCall& call) {
  std::vector<Listed> cameras;
  if (call.devices.empty()) cameras = look_at_all();
  for (const std::string& path : call.devices) cameras.push_back(look_at(path));
  if (call.json) {
    nlohmann::json all = nlohmann::json::array();
    for (const Listed& camera : cameras) all.push_back(to_json(camera));
    print_json({{"cameras", all}});
    return 0;
  }
  if (cameras.empty()) std::printf("No camera is there.\n");
  for (const Listed& camera : cameras) print(camera);
  return 0;
}

}  // namespace rinkaku::app

#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/source/v4l2/device.h"

namespace rinkaku::source::v4l2 {

/// A knob of a camera, such as exposure, focus or white balance.
struct Control {
  std::string name;  ///< as `v4l2-ctl` writes it: "white_balance_automatic"
  std::uint32_t id = 0;
  std::int64_t least = 0, most = 0, step = 1, preset = 0, value = 0;
  std::vector<std::string> menu;  ///< what the values stand for, from `least` on; empty if it is no menu
  bool idle = false;              ///< can't be set now, e.g. exposure while that is automatic
};

std::vector<Control> controls_of(const Device& device);

/// A number, or an entry of a menu; true and false are 1 and 0.
using ControlValue = std::variant<std::int64_t, std::string>;
struct ControlWish {
  std::string name;
  ControlValue value;
  std::string where;  ///< file, line and column, for messages
};

/// Sets controls in the given order, so that an automatic can be switched off before the value it governs is set.
/// Throws Error (Input) for a control that the camera doesn't have (with the nearest it has), a value it doesn't take,
/// and one that is idle.
void set_controls(const Device& device, const std::vector<ControlWish>& wishes);

}  // namespace rinkaku::source::v4l2

#include "pipeline/source/v4l2/controls.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

#include <linux/videodev2.h>

#include "pipeline/frame/error.h"

namespace rinkaku::source::v4l2 {
namespace {

// "White Balance, Automatic" becomes "white_balance_automatic".
std::string plain_name(const char* name) {
  std::string plain;
  for (; *name != '\0'; ++name) {
    const auto c = static_cast<unsigned char>(*name);
    if (std::isalnum(c)) {
      plain += static_cast<char>(std::tolower(c));
    } else if (!plain.empty() && plain.back() != '_') {
      plain += '_';
    }
  }
  while (plain.ends_with('_')) plain.pop_back();
  return plain;
}

bool is_number(__u32 type) {
  return type == V4L2_CTRL_TYPE_INTEGER || type == V4L2_CTRL_TYPE_BOOLEAN || type == V4L2_CTRL_TYPE_MENU ||
         type == V4L2_CTRL_TYPE_INTEGER_MENU || type == V4L2_CTRL_TYPE_BUTTON;
}

std::vector<std::string> menu_of(const Device& device, const v4l2_queryctrl& control) {
  std::vector<std::string> menu;
  if (control.type != V4L2_CTRL_TYPE_MENU) return menu;
  for (__s32 i = control.minimum; i <= control.maximum; ++i) {
    v4l2_querymenu entry{};
    entry.id = control.id;
    entry.index = static_cast<__u32>(i);
    const bool there = request(device.descriptor, VIDIOC_QUERYMENU, &entry) == 0;
    menu.emplace_back(there ? reinterpret_cast<const char*>(entry.name) : "");
  }
  return menu;
}

const Control& find(const std::vector<Control>& controls, const ControlWish& wish, const Device& device) {
  const auto found =
      std::find_if(controls.begin(), controls.end(), [&](const Control& c) { return c.name == wish.name; });
  if (found != controls.end()) return *found;
  std::string names;
  for (const Control& c : controls) names += (names.empty() ? "" : ", ") + c.name;
  throw input_error(wish.where, device.identity.card + " has no control '" + wish.name + "'",
                    names.empty() ? "it has none at all" : "it has " + names);
}

std::int64_t value_of(const Control& control, const ControlWish& wish) {
  std::string range = std::to_string(control.least) + " to " + std::to_string(control.most);
  if (const auto* number = std::get_if<std::int64_t>(&wish.value)) {
    if (*number >= control.least && *number <= control.most) return *number;
    throw input_error(wish.where, "the control '" + wish.name + "' can't be " + std::to_string(*number),
                      "give " + range);
  }
  const std::string& text = std::get<std::string>(wish.value);
  const auto entry = std::find(control.menu.begin(), control.menu.end(), text);
  if (entry != control.menu.end() && !text.empty()) return control.least + (entry - control.menu.begin());
  std::string entries;
  for (const std::string& each : control.menu) {
    if (!each.empty()) entries.append(entries.empty() ? "'" : ", '").append(each).append("'");
  }
  throw input_error(wish.where, "the control '" + wish.name + "' can't be '" + text + "'",
                    "give " + (entries.empty() ? range : entries));
}

}  // namespace

std::vector<Control> controls_of(const Device& device) {
  std::vector<Control> controls;
  v4l2_queryctrl at{};
  at.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  for (; request(device.descriptor, VIDIOC_QUERYCTRL, &at) == 0; at.id |= V4L2_CTRL_FLAG_NEXT_CTRL) {
    if (!is_number(at.type) || at.flags & (V4L2_CTRL_FLAG_DISABLED | V4L2_CTRL_FLAG_READ_ONLY)) continue;
    Control control;
    control.name = plain_name(reinterpret_cast<const char*>(at.name));
    control.id = at.id;
    control.least = at.minimum;
    control.most = at.maximum;
    control.step = at.step;
    control.preset = at.default_value;
    control.menu = menu_of(device, at);
    control.idle = (at.flags & (V4L2_CTRL_FLAG_INACTIVE | V4L2_CTRL_FLAG_GRABBED)) != 0;
    v4l2_control value{at.id, 0};
    if (!(at.flags & V4L2_CTRL_FLAG_WRITE_ONLY) && request(device.descriptor, VIDIOC_G_CTRL, &value) == 0) {
      control.value = value.value;
    }
    controls.push_back(std::move(control));
  }
  return controls;
}

void set_controls(const Device& device, const std::vector<ControlWish>& wishes) {
  for (const ControlWish& wish : wishes) {
    // Read anew each time: one control may wake another.
    const std::vector<Control> controls = controls_of(device);
    const Control& control = find(controls, wish, device);
    const std::int64_t value = value_of(control, wish);
    if (control.idle) {
      throw input_error(wish.where, "the control '" + wish.name + "' can't be set now",
                        "switch off the automatic that governs it, before it in the file");
    }
    v4l2_control set{control.id, static_cast<__s32>(value)};
    if (const int code = request(device.descriptor, VIDIOC_S_CTRL, &set); code != 0) {
      throw input_error(wish.where, "the control '" + wish.name + "' can't be set: " + std::strerror(code));
    }
  }
}

}  // namespace rinkaku::source::v4l2

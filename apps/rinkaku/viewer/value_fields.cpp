#include "apps/rinkaku/viewer/value_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <variant>

#include <imgui.h>

namespace rinkaku::app {
namespace {

using Setter = ValueFields::Setter;

// As TOML, and as short as a slider's steps allow.
std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  // A number that is to stay a float where one is expected reads the same as a whole one.
  return std::string(text).find('e') == std::string::npos ? text : std::to_string(value);
}

double number_of(const toml::Value* value, double preset) {
  if (!value) return preset;
  if (const auto* number = std::get_if<double>(&value->held)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value->held)) return static_cast<double>(*whole);
  return preset;
}

std::array<float, 3> vector_of(const toml::Value* value, const std::array<float, 3>& preset) {
  std::array<float, 3> numbers = preset;
  const auto* elements = value ? std::get_if<toml::Array>(&value->held) : nullptr;
  if (!elements || elements->size() != 3) return numbers;
  for (std::size_t i = 0; i < 3; ++i) {
    numbers[i] = static_cast<float>(number_of(&(*elements)[i], static_cast<double>(preset[i])));
  }
  return numbers;
}

std::array<float, 3> colour_of(const toml::Value& value) {
  const auto* text = std::get_if<std::string>(&value.held);
  if (!text || text->size() != 7) return vector_of(&value, {1, 1, 1});
  const unsigned long rgb = std::strtoul(text->c_str() + 1, nullptr, 16);
  return {static_cast<float>(rgb >> 16 & 255) / 255, static_cast<float>(rgb >> 8 & 255) / 255,
          static_cast<float>(rgb & 255) / 255};
}

std::string colour_text(const std::array<float, 3>& colour) {
  char text[16];
  const auto byte = [&](std::size_t i) {
    return static_cast<int>(std::lround(std::clamp(colour[i], 0.0f, 1.0f) * 255));
  };
  std::snprintf(text, sizeof text, "\"#%02x%02x%02x\"", byte(0), byte(1), byte(2));
  return text;
}

void number_field(const Tunable& t, const toml::Value* value, const toml::Path& path, const Setter& set) {
  const double now = number_of(value, t.preset);
  if (t.kind == Tunable::Kind::Whole) {
    int whole = static_cast<int>(now);
    if (ImGui::SliderInt(t.label, &whole, static_cast<int>(t.least), static_cast<int>(t.most), "%d",
                         ImGuiSliderFlags_AlwaysClamp)) {
      set(path, std::to_string(whole));
    }
    return;
  }
  auto number = static_cast<float>(now);
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp | (t.logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
  if (ImGui::SliderFloat(t.label, &number, static_cast<float>(t.least), static_cast<float>(t.most), "%.3g", flags)) {
    set(path, number_text(static_cast<double>(number)));
  }
}

void vector_field(const Tunable& t, const toml::Value* value, const toml::Path& path, const Setter& set) {
  std::array<float, 3> numbers = vector_of(value, t.preset_vector);
  const auto speed = static_cast<float>((t.most - t.least) / 1000);
  if (ImGui::DragFloat3(t.label, numbers.data(), speed, 0, 0, "%.3g")) {
    std::string text = "[";
    for (const float number : numbers) text += (text.size() > 1 ? ", " : "") + number_text(static_cast<double>(number));
    set(path, text + "]");
  }
}

void choice_field(const Tunable& t, const toml::Value* value, const toml::Path& path, const Setter& set) {
  const auto* text = value ? std::get_if<std::string>(&value->held) : nullptr;
  const std::string now = text ? *text : t.choices.front();
  if (!ImGui::BeginCombo(t.label, now.c_str())) return;
  for (const std::string& choice : t.choices) {
    if (ImGui::Selectable(choice.c_str(), choice == now) && choice != now) set(path, "\"" + choice + "\"");
  }
  ImGui::EndCombo();
}

void flag_field(const Tunable& t, const toml::Value* value, const toml::Path& path, const Setter& set) {
  const auto* flag = value ? std::get_if<bool>(&value->held) : nullptr;
  bool now = flag ? *flag : t.preset > 0;
  if (ImGui::Checkbox(t.label, &now)) set(path, now ? "true" : "false");
}

// Whether a key has this word, or it among several.
bool has_word(const toml::Value* value, const char* word) {
  if (!value) return false;
  if (const auto* text = std::get_if<std::string>(&value->held)) return *text == word;
  const auto* all = std::get_if<toml::Array>(&value->held);
  return all && std::any_of(all->begin(), all->end(), [word](const toml::Value& one) { return has_word(&one, word); });
}

// Whether the scene has the tunable's table: a slider must not switch on what the scene leaves off.
bool has_table(const SceneFile& file, const toml::Path& table) {
  const toml::Value* value = file.find(table);
  if (!value) {
    // Toon is on by default, water has all its tables, and a filmed thing those of its methods.
    if (table.front().key == "foreground" && table.size() == 2) {
      return has_word(file.find({table.front(), {"method"}}), table.back().key.c_str());
    }
    return table.size() <= 1 || table.back().key == "toon" || table.front().key == "water";
  }
  const auto* flag = std::get_if<bool>(&value->held);
  return !flag || *flag;
}

bool goes(const SceneFile& file, const Tunable& tunable, const toml::Path& table) {
  const auto beside = [&](const char* key) {
    toml::Path path = table;
    path.push_back({key});
    return file.find(path);
  };
  if (*tunable.with_key != '\0' && !has_word(beside(tunable.with_key), tunable.with_word)) return false;
  if (*tunable.without_key != '\0' && beside(tunable.without_key)) return false;
  return !tunable.only_given || beside(tunable.key);
}

bool same(const toml::Path& a, const toml::Path& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const toml::Step& one, const toml::Step& other) {
    return one.key == other.key && one.index == other.index;
  });
}

}  // namespace

void ValueFields::draw(const SceneFile& file, const Tunable& tunable, const toml::Path& above, const Setter& set) {
  toml::Path path = above;
  if (*tunable.table != '\0') path.push_back({tunable.table});
  if (!has_table(file, path) || !goes(file, tunable, path)) return;
  path.push_back({tunable.key});
  const toml::Value* value = file.find(path);
  const bool at_once = path.front().key == "object" || path.front().key == "light";
  bool changed = false;
  const Setter hold = [this, &changed](const toml::Path& where, const std::string& text) {
    held_ = Held{where, text};
    changed = true;
  };
  const Setter& change = at_once ? set : hold;
  ImGui::PushID(tunable.table);
  switch (tunable.kind) {
    case Tunable::Kind::Number:
    case Tunable::Kind::Whole:
      number_field(tunable, value, path, change);
      // Dragged back to what it was.
      if (held_ && same(held_->path, path) && !changed && ImGui::IsItemActive()) held_.reset();
      break;
    case Tunable::Kind::Flag:
      flag_field(tunable, value, path, change);
      break;
    case Tunable::Kind::Vector:
      vector_field(tunable, value, path, change);
      break;
    case Tunable::Kind::Colour:
      // A colour that the scene doesn't give comes from elsewhere, e.g. the mesh.
      if (value) {
        std::array<float, 3> colour = colour_of(*value);
        if (ImGui::ColorEdit3(tunable.label, colour.data(), ImGuiColorEditFlags_NoInputs))
          change(path, colour_text(colour));
      }
      break;
    case Tunable::Kind::Choice:
      choice_field(tunable, value, path, change);
      break;
  }
  ImGui::PopID();
}

void ValueFields::let_go(const Setter& set) {
  if (!held_ || ImGui::IsMouseDown(ImGuiMouseButton_Left) || ImGui::IsAnyItemActive()) return;
  const Held held = *std::exchange(held_, std::nullopt);
  set(held.path, held.text);
}

}  // namespace rinkaku::app

#include "mesh/import_worker/mtoon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <nlohmann/json.hpp>

#include "mesh/import_worker/materials.h"

namespace rinkaku::mesh {
namespace {

using Json = nlohmann::json;
using Unit = MaterialLine::Unit;

// The JSON of a binary glTF: a header of 12 bytes, then the chunk's length and kind.
Json json_of(std::span<const char> glb) {
  constexpr std::size_t before = 20;
  std::uint32_t length = 0;
  if (glb.size() < before || std::memcmp(glb.data(), "glTF", 4) != 0) return {};
  std::memcpy(&length, glb.data() + 12, 4);
  if (std::memcmp(glb.data() + 16, "JSON", 4) != 0 || length > glb.size() - before) return {};
  const char* text = glb.data() + before;
  return Json::parse(text, text + length, nullptr, false);
}

// A member, or nothing if there is none or this is no object.
const Json& member(const Json& of, const char* name) {
  static const Json none;
  const auto found = of.is_object() ? of.find(name) : of.end();
  return of.is_object() && found != of.end() ? *found : none;
}

const Json& element(const Json& of, std::size_t i) {
  static const Json none;
  return of.is_array() && i < of.size() ? of[i] : none;
}

float number(const Json& of, const char* name, float otherwise) {
  const Json& value = member(of, name);
  const float found = value.is_number() ? value.get<float>() : otherwise;
  return std::isfinite(found) ? found : otherwise;
}

glm::vec3 colour(const Json& components) {
  glm::vec3 found(0);
  for (int k = 0; k < 3; ++k) {
    const Json& value = element(components, static_cast<std::size_t>(k));
    if (value.is_number()) found[k] = value.get<float>();
    if (!(found[k] >= 0)) found[k] = 0;
    found[k] = std::min(found[k], 1.0f);
  }
  return found;
}

MaterialLine line_of(Unit unit, float width, const glm::vec3& colour) {
  if (!(width > 0)) unit = Unit::None;
  return {unit, unit == Unit::None ? 0.0f : width, colour};
}

// VRM 0.x: colours are sRGB.
std::optional<MaterialLine> line_0(const Json& properties) {
  const Json& shader = member(properties, "shader");
  if (!shader.is_string() || shader.get_ref<const std::string&>() != "VRM/MToon") return {};
  const Json& numbers = member(properties, "floatProperties");
  const float mode = number(numbers, "_OutlineWidthMode", 0), width = number(numbers, "_OutlineWidth", 0.5f);
  const glm::vec3 ink = colour(member(member(properties, "vectorProperties"), "_OutlineColor"));
  constexpr float metres = 0.01f, heights = 0.005f;
  if (mode == 1) return line_of(Unit::Metres, width * metres, ink);
  if (mode == 2) return line_of(Unit::PictureHeights, width * heights, ink);
  return line_of(Unit::None, 0, ink);
}

// VRM 1.0: colours are linear.
std::optional<MaterialLine> line_1(const Json& mtoon) {
  if (!mtoon.is_object()) return {};
  const Json& mode = member(mtoon, "outlineWidthMode");
  const std::string word = mode.is_string() ? mode.get<std::string>() : "none";
  glm::vec3 ink = colour(member(mtoon, "outlineColorFactor"));
  for (int k = 0; k < 3; ++k) ink[k] = srgb_from_linear(ink[k]);
  const Unit unit = word == "worldCoordinates"    ? Unit::Metres
                    : word == "screenCoordinates" ? Unit::PictureHeights
                                                  : Unit::None;
  return line_of(unit, number(mtoon, "outlineWidthFactor", 0), ink);
}

}  // namespace

MtoonLines::MtoonLines(std::span<const char> glb) {
  const Json file = json_of(glb);
  const Json& materials = member(file, "materials");
  const Json& vrm_0 = member(member(member(file, "extensions"), "VRM"), "materialProperties");
  for (std::size_t i = 0; materials.is_array() && i < materials.size(); ++i) {
    const Json& name = member(materials[i], "name");
    std::optional<MaterialLine> line = line_1(member(member(materials[i], "extensions"), "VRMC_materials_mtoon"));
    if (!line) line = line_0(element(vrm_0, i));
    materials_.push_back({name.is_string() ? name.get<std::string>() : "", line});
  }
}

std::optional<MaterialLine> MtoonLines::of(unsigned index, const std::string& name) const {
  if (index < materials_.size() && materials_[index].name == name) return materials_[index].line;
  const auto found =
      std::find_if(materials_.begin(), materials_.end(), [&](const Named& named) { return named.name == name; });
  return found != materials_.end() ? found->line : std::nullopt;
}

}  // namespace rinkaku::mesh

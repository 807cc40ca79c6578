#include "mesh/import_worker/mtoon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include <nlohmann/json.hpp>

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
  MaterialLine line;
  line.unit = unit;
  line.width = unit == Unit::None ? 0.0f : width;
  line.colour = colour;
  return line;
}

// A whole number from 0, or -1.
int index_of(const Json& value) {
  return value.is_number_unsigned() ? static_cast<int>(std::min(value.get<std::uint64_t>(), std::uint64_t{1} << 30))
                                    : -1;
}

void light(MaterialLine& line, float mix) { line.lit = std::clamp(mix, 0.0f, 1.0f); }

// VRM 0.x: colours are sRGB.
std::optional<MaterialLine> line_0(const Json& properties) {
  const Json& shader = member(properties, "shader");
  if (!shader.is_string() || shader.get_ref<const std::string&>() != "VRM/MToon") return {};
  const Json& numbers = member(properties, "floatProperties");
  const float mode = number(numbers, "_OutlineWidthMode", 0), width = number(numbers, "_OutlineWidth", 0.5f);
  const glm::vec3 ink = colour(member(member(properties, "vectorProperties"), "_OutlineColor"));
  constexpr float metres = 0.01f, heights = 0.005f;
  MaterialLine line = mode == 1   ? line_of(Unit::Metres, width * metres, ink)
                      : mode == 2 ? line_of(Unit::PictureHeights, width * heights, ink)
                                  : line_of(Unit::None, 0, ink);
  if (number(numbers, "_OutlineColorMode", 0) == 1) light(line, number(numbers, "_OutlineLightingMix", 1));
  line.width_texture = index_of(member(member(properties, "textureProperties"), "_OutlineWidthTexture"));
  return line;
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
  MaterialLine line = line_of(unit, number(mtoon, "outlineWidthFactor", 0), ink);
  light(line, number(mtoon, "outlineLightingMixFactor", 1));
  line.width_texture = index_of(member(member(mtoon, "outlineWidthMultiplyTexture"), "index"));
  line.width_channel = 1;
  return line;
}

// The bytes of a texture's picture that lies in the binary chunk, which follows the JSON; empty if it doesn't.
std::span<const char> picture_of(const Json& file, std::span<const char> glb, int texture) {
  std::uint32_t json_length = 0;
  std::memcpy(&json_length, glb.data() + 12, 4);
  const std::uint64_t start = 20 + std::uint64_t{json_length} + 8;
  if (start > glb.size()) return {};
  const std::span<const char> binary = glb.subspan(start);
  const auto at = [&](const char* list, const Json& index) -> const Json& {
    const int i = index_of(index);
    static const Json none;
    return i < 0 ? none : element(member(file, list), static_cast<std::size_t>(i));
  };
  const Json& image = at("images", member(at("textures", Json(static_cast<unsigned>(texture))), "source"));
  const Json& view = at("bufferViews", member(image, "bufferView"));
  if (!view.is_object() || index_of(member(view, "buffer")) != 0) return {};
  const auto offset = static_cast<std::size_t>(std::max(index_of(member(view, "byteOffset")), 0));
  const int length = index_of(member(view, "byteLength"));
  if (length <= 0 || offset > binary.size() || static_cast<std::size_t>(length) > binary.size() - offset) return {};
  return binary.subspan(offset, static_cast<std::size_t>(length));
}

// What a VRM 1.0 material says of its width texture's coordinates that isn't followed: a mesh keeps one set of them,
// that of the surface's colour. Empty if nothing.
std::string left_out(const Json& material) {
  const auto set_of = [](const Json& texture) { return std::max(index_of(member(texture, "texCoord")), 0); };
  const Json& texture =
      member(member(member(material, "extensions"), "VRMC_materials_mtoon"), "outlineWidthMultiplyTexture");
  const int set = set_of(texture);
  const int kept = set_of(member(member(material, "pbrMetallicRoughness"), "baseColorTexture"));
  const Json& transform = member(member(texture, "extensions"), "KHR_texture_transform");
  if (transform.is_object()) return "has a transform (KHR_texture_transform), which is left out";
  if (set == kept) return {};
  return "uses texture coordinates " + std::to_string(set) + ", which aren't read; drawn with coordinates " +
         std::to_string(kept);
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
    std::string warning;
    if (line && line->unit == Unit::None) line->width_texture = -1;
    if (line && line->width_texture >= 0) {
      const std::span<const char> picture = picture_of(file, glb, line->width_texture);
      if (!picture.empty()) pictures_.try_emplace(line->width_texture, picture.begin(), picture.end());
      warning = picture.empty() ? "is no picture within the file; drawn with the whole width" : left_out(materials[i]);
    }
    materials_.push_back({name.is_string() ? name.get<std::string>() : "", line, warning});
  }
}

void MtoonLines::read_line(unsigned index, Material& material, TextureReader& textures) const {
  const Named* const named = find(index, material.name);
  if (named == nullptr || !named->line) return;
  material.line = named->line;
  if (!named->warning.empty())
    textures.warnings.push_back("texture of outline widths of material '" + material.name + "' " + named->warning);
  const int number = std::exchange(material.line->width_texture, -1);
  const auto found = pictures_.find(number);
  if (found == pictures_.end()) return;
  material.line->width_texture =
      textures.number_of("of outline widths, number " + std::to_string(number), found->second);
}

const MtoonLines::Named* MtoonLines::find(unsigned index, const std::string& name) const {
  if (index < materials_.size() && materials_[index].name == name) return &materials_[index];
  const auto found =
      std::find_if(materials_.begin(), materials_.end(), [&](const Named& named) { return named.name == name; });
  return found != materials_.end() ? &*found : nullptr;
}

}  // namespace rinkaku::mesh

#include "mesh/import_worker/materials.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include <stb_image.h>

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include "mesh/import_message.h"
#include "mesh/import_worker/read_file.h"
#include "pipeline/frame/srgb.h"

namespace rinkaku::mesh {
namespace {

namespace fs = std::filesystem;

/// A picture larger than this is no texture, but a file that wants all memory.
constexpr long long kMostPixels = 1LL << 26;

constexpr aiTextureType kColourTextures[] = {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE};

aiTextureType colour_texture(const aiMaterial& material) {
  for (const aiTextureType type : kColourTextures) {
    if (material.GetTextureCount(type) > 0) return type;
  }
  return aiTextureType_NONE;
}

bool decode_bytes(const std::uint8_t* bytes, std::size_t size, Texture& out, std::string& why) {
  int width = 0;
  int height = 0;
  int channels = 0;
  const int length = static_cast<int>(std::min<std::size_t>(size, 0x7fffffff));
  if (stbi_info_from_memory(bytes, length, &width, &height, &channels) == 0) {
    why = "not a picture in a known format";
    return false;
  }
  if (static_cast<long long>(width) * height > kMostPixels) {
    why = "larger than 64 megapixels";
    return false;
  }
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes, length, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels || width <= 0 || height <= 0) {
    why = "its picture data are broken";
    return false;
  }
  out.width_px = width;
  out.height_px = height;
  out.rgba.assign(pixels.get(),
                  pixels.get() + std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return true;
}

bool decode_embedded(const aiTexture& texture, Texture& out, std::string& why) {
  if (texture.pcData == nullptr || texture.mWidth == 0) {
    why = "it holds no data";
    return false;
  }
  if (texture.mHeight == 0) {
    return decode_bytes(reinterpret_cast<const std::uint8_t*>(texture.pcData), texture.mWidth, out, why);
  }
  const long long pixels = static_cast<long long>(texture.mWidth) * texture.mHeight;
  if (pixels > kMostPixels) {
    why = "larger than 64 megapixels";
    return false;
  }
  out.width_px = static_cast<int>(texture.mWidth);
  out.height_px = static_cast<int>(texture.mHeight);
  out.rgba.reserve(static_cast<std::size_t>(pixels) * 4);
  for (long long i = 0; i < pixels; ++i) {
    const aiTexel& texel = texture.pcData[i];
    out.rgba.insert(out.rgba.end(), {texel.r, texel.g, texel.b, texel.a});
  }
  return true;
}

/// "%20" and the like as bytes: glTF's file names are URIs.
std::string uri_decoded(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    if (text[i] == '%' && i + 2 < text.size() && std::sscanf(text.substr(i + 1, 2).c_str(), "%2x", &value) == 1) {
      result.push_back(static_cast<char>(value));
      i += 2;
    } else {
      result.push_back(text[i]);
    }
  }
  return result;
}

/// Where a texture named in a file may lie: as named, decoded, or just beside the file.
fs::path find_texture(const fs::path& folder, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  std::error_code ignored;
  for (const std::string& spelling : {name, uri_decoded(name)}) {
    const fs::path path(spelling);
    for (const fs::path& candidate : {folder / path, folder / path.filename()}) {
      if (fs::is_regular_file(candidate, ignored)) return candidate;
    }
  }
  return {};
}

Material::Alpha alpha_mode(const aiMaterial& material, float opacity) {
  aiString mode;
  if (material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS) {
    if (std::strcmp(mode.C_Str(), "MASK") == 0) return Material::Alpha::Mask;
    if (std::strcmp(mode.C_Str(), "BLEND") == 0) return Material::Alpha::Blend;
    return Material::Alpha::Opaque;
  }
  return opacity < 1.0f ? Material::Alpha::Blend : Material::Alpha::Opaque;
}

float finite_or(float value, float otherwise) { return std::isfinite(value) ? value : otherwise; }

}  // namespace

float srgb_from_linear(float linear) {
  return rinkaku::srgb_from_linear(std::clamp(finite_or(linear, 0.0f), 0.0f, 1.0f));
}

unsigned uv_channel(const aiMaterial& material) {
  int channel = 0;
  const aiTextureType type = colour_texture(material);
  if (type != aiTextureType_NONE) material.Get(AI_MATKEY_UVWSRC(type, 0), channel);
  return channel > 0 && channel < AI_MAX_NUMBER_OF_TEXTURECOORDS ? static_cast<unsigned>(channel) : 0;
}

Material read_material(const aiMaterial& material, bool linear_factors, TextureReader& textures) {
  Material result;
  aiString name;
  if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) result.name = name.C_Str();

  aiColor4D colour(1, 1, 1, 1);
  const bool has_base = linear_factors && material.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS;
  if (!has_base && material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) != aiReturn_SUCCESS) colour = aiColor4D(1, 1, 1, 1);
  float opacity = 1.0f;
  if (!has_base && material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS) colour.a = opacity;
  opacity = std::clamp(finite_or(colour.a, 1.0f), 0.0f, 1.0f);
  const float rgb[3] = {colour.r, colour.g, colour.b};
  for (int k = 0; k < 3; ++k) {
    result.base_colour[k] = linear_factors ? srgb_from_linear(rgb[k]) : std::clamp(finite_or(rgb[k], 1.0f), 0.0f, 1.0f);
  }
  result.base_colour.a = opacity;

  int two_sided = 0;
  result.two_sided = material.Get(AI_MATKEY_TWOSIDED, two_sided) == aiReturn_SUCCESS && two_sided != 0;
  result.alpha = alpha_mode(material, opacity);
  float cutoff = 0.5f;
  if (material.Get(AI_MATKEY_GLTF_ALPHACUTOFF, cutoff) == aiReturn_SUCCESS)
    result.alpha_cutoff = finite_or(cutoff, 0.5f);

  const aiTextureType type = colour_texture(material);
  aiString path;
  if (type != aiTextureType_NONE && material.GetTexture(type, 0, &path) == aiReturn_SUCCESS) {
    result.texture = textures.number_of(path.C_Str());
  }
  // Exporters that put a texture in place of the colour leave the colour black, which would black the texture out.
  const bool black = result.base_colour.r == 0 && result.base_colour.g == 0 && result.base_colour.b == 0;
  if (result.texture >= 0 && black && !linear_factors) result.base_colour = glm::vec4(1, 1, 1, opacity);
  return result;
}

TextureReader::TextureReader(const aiScene* scene, fs::path folder) : scene_(scene), folder_(std::move(folder)) {}

int TextureReader::number_of(const std::string& name) {
  if (name.empty()) return -1;
  if (const auto known = by_name_.find(name); known != by_name_.end()) return known->second;
  Texture texture;
  std::string why;
  const bool decoded = decode(name, texture, why);
  return keep(name, decoded, std::move(texture), why);
}

int TextureReader::number_of(const std::string& name, std::span<const char> picture) {
  if (const auto known = by_name_.find(name); known != by_name_.end()) return known->second;
  Texture texture;
  std::string why;
  const bool decoded =
      decode_bytes(reinterpret_cast<const std::uint8_t*>(picture.data()), picture.size(), texture, why);
  return keep(name, decoded, std::move(texture), why);
}

int TextureReader::keep(const std::string& name, bool decoded, Texture&& texture, const std::string& why) {
  int index = -1;
  if (decoded) {
    index = static_cast<int>(textures.size());
    textures.push_back(std::move(texture));
  } else {
    warnings.push_back("texture " + name + ": " + why + "; drawn without it");
  }
  by_name_.emplace(name, index);
  return index;
}

bool TextureReader::decode(const std::string& name, Texture& out, std::string& why) const {
  const aiTexture* embedded = scene_ != nullptr ? scene_->GetEmbeddedTexture(name.c_str()) : nullptr;
  if (embedded != nullptr) return decode_embedded(*embedded, out, why);
  const fs::path path = find_texture(folder_, name);
  if (path.empty()) {
    why = "not found";
    return false;
  }
  try {
    const std::vector<char> bytes = read_bytes(path);
    return decode_bytes(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), out, why);
  } catch (const ImportFailure& failure) {
    why = failure.what;
    return false;
  }
}

}  // namespace rinkaku::mesh

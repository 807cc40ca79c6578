#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace rinkaku::mesh {

/// 8-bit RGBA, straight alpha, sRGB, rows from the top.
struct Texture {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgba;
};

/// The outline that a material's file asks for, as VRM's MToon has it.
struct MaterialLine {
  enum class Unit { None, Metres, PictureHeights } unit = Unit::None;  ///< None: without an outline
  float width = 0;
  glm::vec3 colour{0};  ///< sRGB-encoded
  float lit = 0;        ///< 0 to 1: how much of the surface's own colour multiplies it
  /// Index into Mesh::textures, -1 for none: one of its channels says, by texture coordinates, what the width is
  /// multiplied by.
  int width_texture = -1;
  int width_channel = 0;  ///< 0 red, 1 green
};

struct Material {
  std::string name;
  glm::vec4 base_colour{1, 1, 1, 1};  ///< sRGB-encoded, straight alpha; multiplies the texture
  int texture = -1;                   ///< index into Mesh::textures, -1 for none
  bool two_sided = false;
  enum class Alpha { Opaque, Mask, Blend } alpha = Alpha::Opaque;
  float alpha_cutoff = 0.5f;
  std::optional<MaterialLine> line{};  ///< if the file says anything about it
};

/// A run of triangles with one material.
struct Part {
  std::string name;  ///< of the node or group
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
  std::uint32_t material = 0;
};

/// A triangle mesh as it is drawn, in its own coordinates (units and up axis as in the file).
///
/// Vertices are split where normals (creases) or texture coordinates differ; `welded` tells which of them are one point
/// of the surface. Triangles are anticlockwise seen from outside.
struct Mesh {
  std::vector<glm::vec3> positions;   ///< per vertex
  std::vector<glm::vec3> normals;     ///< per vertex, unit length, for shading
  std::vector<glm::vec2> uvs;         ///< per vertex, or empty; (0, 0) is the texture's top left
  std::vector<glm::vec4> colours;     ///< per vertex, sRGB-encoded, straight alpha; or empty
  std::vector<std::uint32_t> welded;  ///< per vertex: its point, 0 .. point_count - 1
  std::uint32_t point_count = 0;
  std::vector<glm::uvec3> triangles;  ///< vertex indices
  std::vector<Part> parts;            ///< cover all triangles, in order
  std::vector<Material> materials;    ///< at least one
  std::vector<Texture> textures;
};

}  // namespace rinkaku::mesh

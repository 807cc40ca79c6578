#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/mesh.h"
#include "pipeline/gl/program.h"
#include "pipeline/gl/texture.h"
#include "pipeline/passes/offset_uniforms.h"
#include "pipeline/passes/pass.h"
#include "pipeline/passes/toon/coarse_colour.h"

namespace rinkaku::passes {

struct ToonOptions {
  int bands = 3;                                ///< 0: unlit, the flat colour of material and texture
  glm::vec3 shade_colour{0.62f, 0.60f, 0.78f};  ///< what the darkest band multiplies the colour by, sRGB-encoded
  glm::vec3 light{-0.4f, 0.5f, 0.8f};           ///< towards the light, in the world; any length
  /// Opaque parts are coloured at one this-th of the resolution (see CoarseColour); coverage is the same.
  int shading_scale = 1;
};

/// Draws a mesh as flat bands of light and shade (cel shading): the cosine to the light, raised to reach around the
/// whole shape, is quantised into `bands` levels with borders smoothed over one pixel. Works on sRGB-encoded values, as
/// painters mix them. Only the shader variants that the materials need are compiled.
class ToonPass : public ObjectPass {
 public:
  /// `object` must outlive the pass; materials and textures are copied from `mesh`.
  ToonPass(DrawnObject& object, const mesh::Mesh& mesh, const ToonOptions& options);

  const char* name() const override { return "toon"; }
  double reach_px(const View&) const override { return 1; }
  void draw_surface(const DrawCall& call) override;
  void draw_edges(const DrawCall& call) override;

 private:
  // One shader variant and where its uniforms are.
  struct Variant {
    unsigned features = 0;
    gl::Program program;
    OffsetUniforms offset;
    GLint base_colour = -1, alpha_cutoff = -1, world_from_normal = -1, offset_px = -1, flip_back_faces = -1;
    GLint edge_coverage = -1;
    CoarseColour::Uniforms coarse;
  };
  struct PartStyle {
    std::size_t surface = 0, even = 0, feather = 0, border = 0;  // indices of variants_
    // What colours the coarse picture, if it has one.
    std::size_t coarse_surface = 0, coarse_even = 0, coarse_band = 0;
    bool coarse = false;
    glm::vec4 base_colour{1};
    float alpha_cutoff = 0.5f;
    int texture = -1;
    bool translucent = false;
  };
  enum class Stage { Surface, Translucent, Feather, Border, CoarseSurface, CoarseBand };
  std::size_t variant(unsigned features);
  PartStyle part_style(const mesh::Material& material, unsigned common, bool has_borders);
  static bool belongs(const PartStyle& style, Stage stage);
  static std::size_t variant_of(const PartStyle& style, Stage stage, bool even);
  void draw_coarse(const DrawCall& call);
  void draw(const DrawCall& call, std::span<const Run> runs, Stage stage);

  DrawnObject& object_;
  ToonOptions options_;
  std::vector<Variant> variants_;
  std::vector<PartStyle> parts_;
  std::vector<gl::Texture> textures_;
  std::optional<CoarseColour> coarse_;
};

}  // namespace rinkaku::passes

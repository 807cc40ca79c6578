#include "pipeline/passes/toon/toon_pass.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "embedded/toon.frag.h"
#include "embedded/toon.vert.h"

namespace rinkaku::passes {
namespace {

enum Feature : unsigned {
  Lit = 1,
  Textured = 2,
  VertexColours = 4,
  Masked = 8,
  TwoSided = 16,
  Translucent = 32,
  Feather = 64,
  Fine = 128,  // lit by vertex: the mesh is fine enough
  Even = 256,  // lit by triangle: no band's border runs through
  Border = 512,
  Coarse = 1024,  // coloured already, at a lower resolution
};
constexpr std::string_view feature_names[] = {"LIT",       "TEXTURED",    "VERTEX_COLOURS", "MASKED",
                                              "TWO_SIDED", "TRANSLUCENT", "FEATHER",        "FINE",
                                              "EVEN",      "BORDER",      "COARSE"};

// Whether lighting the vertices and interpolating gives the same bands as lighting each pixel. Where the normals at a
// triangle's corners differ by an angle d, the two differ by d^2 / 8, in a triangle over which brightness changes by d:
// at 15 degrees a band's border is displaced by 3 % of a triangle.
// Of what moves, half of that is asked for at rest, as it bends.
bool is_fine(const mesh::Mesh& mesh, bool moves) {
  constexpr float cos_15_deg = 0.9659f, cos_7_deg = 0.9925f;
  const float least_cos = moves ? cos_7_deg : cos_15_deg;
  constexpr double most_coarse = 0.02;  // of all triangles
  std::size_t coarse = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 &a = mesh.normals[t.x], &b = mesh.normals[t.y], &c = mesh.normals[t.z];
    if (std::min({glm::dot(a, b), glm::dot(b, c), glm::dot(c, a)}) < least_cos) ++coarse;
  }
  return static_cast<double>(coarse) <= most_coarse * static_cast<double>(mesh.triangles.size());
}

}  // namespace

ToonPass::ToonPass(DrawnObject& object, const mesh::Mesh& mesh, const ToonOptions& options)
    : object_(object), options_(options) {
  options_.light = glm::normalize(options.light);
  // Not those that only say how wide a line is.
  textures_.resize(mesh.textures.size());
  for (const mesh::Material& material : mesh.materials) {
    if (material.texture < 0) continue;
    const auto number = static_cast<std::size_t>(material.texture);
    const mesh::Texture& texture = mesh.textures[number];
    if (textures_[number].name() == 0)
      textures_[number] = gl::Texture(texture.width_px, texture.height_px, texture.rgba);
  }
  unsigned common = 0;
  if (options.bands > 0) common |= Lit;
  if (!mesh.colours.empty()) common |= VertexColours;
  if (object.shape().two_sided()) common |= TwoSided;
  // Two-sided surfaces learn only in the fragment shader which side is seen.
  if ((common & Lit) != 0 && !object.shape().two_sided() && is_fine(mesh, object.shape().moves())) common |= Fine;
  const bool has_borders = !object.shape().border_vertices().empty() || object.shape().intersects_itself();
  for (const mesh::Part& part : mesh.parts) {
    parts_.push_back(part_style(mesh.materials[part.material], common, has_borders));
  }
  if (std::any_of(parts_.begin(), parts_.end(), [](const PartStyle& p) { return p.coarse; })) {
    coarse_.emplace(options.shading_scale);
  }
}

ToonPass::PartStyle ToonPass::part_style(const mesh::Material& material, unsigned common, bool has_borders) {
  unsigned features = common;
  if (material.texture >= 0) features |= Textured;
  if (material.alpha == mesh::Material::Alpha::Mask) features |= Masked;
  if (material.alpha == mesh::Material::Alpha::Blend) features |= Translucent;
  PartStyle style;
  style.surface = variant(features);
  // Even triangles come with levels of detail only. (Of two-sided ones it takes a pixel to know the side.)
  const bool by_triangle = object_.shape().has_levels() && (features & (Lit | TwoSided)) == Lit;
  style.even = by_triangle ? variant((features & ~Fine) | Even) : style.surface;
  style.feather = variant(features | Feather);
  // What a texture cuts out must be looked up in it anyway.
  style.coarse = options_.shading_scale > 1 && (features & (Masked | Translucent)) == 0;
  if (style.coarse) {
    style.coarse_surface = style.surface, style.coarse_even = style.even, style.coarse_band = style.feather;
    style.surface = style.even = variant(Coarse);
    style.feather = variant(Coarse | Feather);
    features = Coarse;
  }
  if (has_borders) style.border = variant(features | Feather | Border);
  style.base_colour = material.base_colour;
  style.alpha_cutoff = material.alpha_cutoff;
  style.texture = material.texture;
  style.translucent = material.alpha == mesh::Material::Alpha::Blend;
  return style;
}

std::size_t ToonPass::variant(unsigned features) {
  const auto known =
      std::find_if(variants_.begin(), variants_.end(), [features](const Variant& v) { return v.features == features; });
  if (known != variants_.end()) return static_cast<std::size_t>(known - variants_.begin());
  std::vector<std::string_view> defines;
  for (std::size_t bit = 0; bit < std::size(feature_names); ++bit) {
    if (features & (1u << bit)) defines.push_back(feature_names[bit]);
  }
  const std::string_view vertex[] = {screen_offset_glsl(), embedded::toon_vert};
  const bool coarse = (features & Coarse) != 0;
  const std::string_view fragment[] = {coarse ? CoarseColour::glsl() : std::string_view(), embedded::toon_frag};
  Variant v;
  v.features = features;
  v.program = gl::Program("toon", defines, vertex, fragment);
  v.offset = OffsetUniforms(v.program);
  v.base_colour = v.program.uniform("base_colour");
  v.alpha_cutoff = v.program.uniform("alpha_cutoff");
  v.world_from_normal = v.program.uniform("world_from_normal");
  v.offset_px = v.program.uniform("offset_px");
  v.edge_coverage = v.program.uniform("edge_coverage");
  v.flip_back_faces = v.program.uniform("flip_back_faces");
  if (coarse) v.coarse = CoarseColour::Uniforms(v.program);
  const GLuint name = v.program.name();
  glProgramUniform3fv(name, v.program.uniform("light"), 1, glm::value_ptr(options_.light));
  glProgramUniform3fv(name, v.program.uniform("shade"), 1, glm::value_ptr(options_.shade_colour));
  glProgramUniform1f(name, v.program.uniform("last_band"), static_cast<float>(std::max(options_.bands - 1, 1)));
  glProgramUniform1f(name, v.program.uniform("bands"), static_cast<float>(options_.bands));
  glProgramUniform1i(name, v.program.uniform("base_texture"), 0);
  variants_.push_back(std::move(v));
  return variants_.size() - 1;
}

bool ToonPass::belongs(const PartStyle& style, Stage stage) {
  if (stage == Stage::CoarseSurface || stage == Stage::CoarseBand) return style.coarse;
  return style.translucent == (stage == Stage::Translucent);
}

std::size_t ToonPass::variant_of(const PartStyle& style, Stage stage, bool even) {
  switch (stage) {
    case Stage::Border:
      return style.border;
    case Stage::Feather:
      return style.feather;
    case Stage::CoarseBand:
      return style.coarse_band;
    case Stage::CoarseSurface:
      return even ? style.coarse_even : style.coarse_surface;
    case Stage::Surface:
    case Stage::Translucent:
      break;
  }
  return even ? style.even : style.surface;
}

void ToonPass::draw(const DrawCall& call, std::span<const Run> runs, Stage stage) {
  const bool surface = stage == Stage::Surface || stage == Stage::Translucent || stage == Stage::CoarseSurface;
  const Variant* bound = nullptr;
  for (const Run& run : runs) {
    const PartStyle& style = parts_[run.part];
    if (!belongs(style, stage)) continue;
    // Colours of a lower resolution are looked up by the layer's own pixels.
    const Stage as = call.elsewhere && style.coarse && stage == Stage::Surface ? Stage::CoarseSurface : stage;
    const Variant& v = variants_[variant_of(style, as, run.even)];
    if (&v != bound) {
      glUseProgram(v.program.name());
      v.offset.set(call);
      glUniformMatrix3fv(v.world_from_normal, 1, GL_FALSE, glm::value_ptr(object_.shape().world_from_normal()));
      const float overlap_px = stage == Stage::Feather ? object_.shape().last_look().overlap_px : 0;
      if (stage == Stage::CoarseBand) {
        glUniform2f(v.offset_px, -coarse_->band_px(), coarse_->band_px());
      } else {
        glUniform2f(v.offset_px, -feather_px - overlap_px, feather_px);
      }
      if ((v.features & Coarse) != 0) coarse_->set(v.coarse, call);
      // A band is opaque but for its outermost eighth.
      glUniform1f(v.edge_coverage, stage == Stage::CoarseBand ? 8 : 1 + overlap_px);
      glUniform1i(v.flip_back_faces, surface ? 1 : 0);
      bound = &v;
    }
    glUniform4fv(v.base_colour, 1, glm::value_ptr(style.base_colour));
    glUniform1f(v.alpha_cutoff, style.alpha_cutoff);
    if (style.texture >= 0) glBindTextureUnit(0, textures_[style.texture].name());
    draw_run(run);
  }
}

void ToonPass::draw_coarse(const DrawCall& full) {
  const ObjectShape& shape = object_.shape();
  const DrawCall call = coarse_->begin(full, shape.last_look().bounds, shape.world_from_object());
  draw(call, object_.bind_front(), Stage::CoarseSurface);
  coarse_->begin_bands();
  glDisable(GL_CULL_FACE);
  draw(call, object_.bind_contour(), Stage::CoarseBand);
  coarse_->end();
}

void ToonPass::draw_surface(const DrawCall& call) {
  if (coarse_ && !call.elsewhere) draw_coarse(call);
  draw(call, object_.bind_front(), Stage::Surface);
}

void ToonPass::draw_edges(const DrawCall& call) {
  draw(call, object_.bind_borders(), Stage::Border);
  draw(call, object_.bind_intersections(), Stage::Border);
  draw(call, object_.bind_contour(), Stage::Feather);
  const bool any = std::any_of(parts_.begin(), parts_.end(), [](const PartStyle& p) { return p.translucent; });
  if (any) draw(call, object_.bind_front(), Stage::Translucent);
}

}  // namespace rinkaku::passes

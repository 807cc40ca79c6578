#pragma once

#include <optional>
#include <string_view>

#include <glm/mat4x4.hpp>

#include "pipeline/gl/program.h"
#include "pipeline/gl/texture_target.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::passes {

/// An object's colours at a whole fraction of the resolution, with their depth, to be looked up where the object is
/// drawn at the full one. Its texels lie on a grid that is fixed in the picture, so that colours don't crawl as the
/// object's rectangle moves.
///
/// In the lookup (coarse_colour.glsl) a pixel takes the colours of the four texels around it, bilinear in place and
/// weighted by how near their depth is to its own: Kopf et al., "Joint bilateral upsampling", SIGGRAPH 2007, with depth
/// for guide. So a part of the object doesn't take colour from another behind or before it, other objects and the
/// background are not in the target at all. Parts thinner than a texel may lie between the texels' middles: for these a
/// second picture holds bands along the contour. Needs a current GL context.
class CoarseColour {
 public:
  explicit CoarseColour(int scale);

  /// Binds and clears the target for surfaces; what is drawn with the returned call until end() goes there. `bounds`:
  /// the mesh in the pinhole picture. `call` must live until end().
  DrawCall begin(const DrawCall& call, const PixelRect& bounds, const glm::dmat4& world_from_object);
  /// What is drawn from here on is the bands, from band_px() inside the contour to as far outside.
  void begin_bands();
  float band_px() const { return 1.5f * static_cast<float>(scale_); }
  /// Has the target that was bound before bound again.
  void end();

  /// Where a program that was made with glsl() finds its colours.
  struct Uniforms {
    GLint coarse_from_pixel = -1, depth_tolerance = -1;
    Uniforms() = default;
    explicit Uniforms(const gl::Program& program);
  };
  /// For the program in use, drawing with `call`, the one that begin() was given.
  void set(const Uniforms& uniforms, const DrawCall& call) const;

  /// To go before a fragment shader: vec3 looked_up_colour(vec3 otherwise).
  static std::string_view glsl();

 private:
  int scale_;
  gl::TextureTarget surfaces_, bands_;
  PixelRect rect_;  // of the pinhole picture, in its pixels: a multiple of scale_ in place and size
  std::optional<gl::ElsewhereScope> elsewhere_;
};

}  // namespace rinkaku::passes

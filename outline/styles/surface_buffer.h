#pragma once

#include "pipeline/gl/program.h"
#include "pipeline/gl/texture_target.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::outline {

/// An object by itself, drawn into textures, for what finds lines in pictures or asks what the object hides. Covers the
/// object's own rectangle and no more.
class SurfaceBuffer {
 public:
  enum class Content {
    Normals,  ///< colour is the unit normal in the camera's frame, as 0.5 n + 0.5 and alpha 1; two texels a pixel
    Picture,  ///< colour is the object as one of its passes draws it; two texels a pixel
    Depth,    ///< no colour; one texel a pixel
  };
  explicit SurfaceBuffer(Content content);

  /// Draws the object as the last look sees it, in the pixels of `rect`, which lies within the call's. `body` draws the
  /// picture, and is read for nothing else. To be called within a gl::ElsewhereScope.
  void draw(passes::DrawnObject& object, const passes::DrawCall& call, const passes::PixelRect& rect,
            passes::ObjectPass* body);

  GLuint colour() const { return target_.colour(0); }
  GLuint depth() const { return target_.depth(); }  ///< near / Z; 0 where there is nothing

 private:
  int fineness_;
  gl::TextureTarget target_;
  gl::Program program_;  // for normals only
  GLint clip_from_object_ = -1, camera_from_normal_ = -1;
};

}  // namespace rinkaku::outline

#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "pipeline/gl/target.h"
#include "pipeline/passes/drawn_object.h"
#include "pipeline/passes/layer.h"
#include "pipeline/passes/pass.h"
#include "pipeline/passes/scene_pass.h"

namespace rinkaku::passes {

/// An object and the passes that draw it, in order.
struct StyledObject {
  std::unique_ptr<DrawnObject> object;
  std::vector<std::unique_ptr<ObjectPass>> passes;
};

/// Draws all CG objects of a frame, and the passes of the whole scene, into one layer, in the rectangle that they cover
/// and nowhere else.
///
/// Needs the GL context that was current at construction to be current.
class LayerRenderer {
 public:
  /// `picture`: the part of the pinhole picture that can be seen.
  LayerRenderer(std::vector<StyledObject> objects, const PixelRect& picture);

  void add(std::unique_ptr<ScenePass> pass) { scene_passes_.push_back(std::move(pass)); }
  /// Takes over the other's scene passes.
  void take_scene_passes(LayerRenderer& from) { std::swap(scene_passes_, from.scene_passes_); }
  /// Hands them out; without them it draws the objects alone.
  std::vector<std::unique_ptr<ScenePass>> hand_out_scene_passes() { return std::exchange(scene_passes_, {}); }

  /// Draws what `view` sees. Returns false, leaving `layer` empty, if no object is in the picture.
  bool draw(const View& view, Layer& layer) { return draw(view, {}, {&layer, 1}); }

  /// Draws what `view` sees in slices of depth: layers[0] what is nearer than cuts_m[0], layers[1] what lies from there
  /// to cuts_m[1], and so on, one layer more than cuts. Cuts are in metres along the camera's axis, not falling. A
  /// surface that passes through a cut is in both layers, each having the part on its side. An object costs once for
  /// each slice that it reaches into.
  /// Each layer is taken apart into `parts` of the same number, if there are any, which draws it once more.
  bool draw(const View& view, std::span<const double> cuts_m, std::span<Layer> layers,
            std::span<LayerParts> parts = {});
  /// Draws the objects alone, into another picture: what a mirror shows.
  bool draw_objects(const View& view, const PixelRect& picture, Layer& layer);

 private:
  struct Visible {
    StyledObject* styled;
    const Look* look;
    PixelRect rect;
    bool leaves_colour;
    bool uploaded;
  };
  struct Slice {
    double cut_m;   // where it begins
    double near_m;  // from where on surfaces that reach beyond it are drawn
    double far_m;
    // What only takes away also does so in all slices behind it.
    bool holds(const Visible& v) const {
      return v.look->nearest_m < far_m && (!v.leaves_colour || v.look->farthest_m > cut_m);
    }
  };
  void look_at_objects(const View& view, const PixelRect& picture);
  /// The rectangle of all that leaves colour in the slice.
  PixelRect covered(const Slice& slice) const;
  bool draw_slice(const View& view, const Slice& slice, const PixelRect& scene_rect, Layer& layer, LayerParts* parts);
  enum class Ink { All, Lines };
  void draw_all(const View& view, const Slice& slice, Ink ink, Layer& layer);
  static double empty_depth(const Slice& slice) { return slice.near_m / slice.far_m; }
  void begin(const PixelRect& rect, const Slice& slice);
  void draw_surfaces(const View& view, const PixelRect& rect, const Slice& slice, Ink ink);
  void look_behind(const View& view, const PixelRect& rect, const Slice& slice);
  void draw_edges(const View& whole_view, const PixelRect& rect, const Slice& slice, Ink ink);
  void read(Layer& layer);
  void read_depth(const Slice& slice, const PixelRect& rect, DepthLayer& depth);
  DrawCall call_for(const View& view, const StyledObject& styled, const PixelRect& rect, Ink ink) const;

  std::vector<StyledObject> objects_;
  PixelRect picture_;
  gl::Target target_;
  std::vector<Visible> visible_;
  std::vector<std::unique_ptr<ScenePass>> scene_passes_;
};

}  // namespace rinkaku::passes

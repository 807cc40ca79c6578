#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "apps/rinkaku/viewer/scene_file.h"
#include "pipeline/stages/water_arrows.h"

namespace rinkaku::app {

/// Draws, moves and takes away the flow arrows of a scene's water by hand: from what a mouse does on the picture to the
/// scene's new text. Knows no window. Pixels are the recording's.
class ArrowEditor {
 public:
  /// What is looked at: to be told before anything else is asked, and whenever it changes.
  /// Throws Error (Input) for a scene whose arrows can't be made; nothing can be edited until the next look.
  void look(const SceneFile& file, double frames_per_s, std::int64_t frame,
            const std::optional<RigidTransform>& camera_from_world);

  /// An arrow as it is to be drawn over the picture.
  struct Sketch {
    glm::dvec2 from_px{0}, to_px{0};
    bool selected = false;
    bool fits = true;  ///< false: let go here, nothing happens, as no water is seen
  };
  std::vector<Sketch> sketches() const;
  /// The frame of the key that the selected arrow, or else the first one, belongs to; empty without arrows.
  std::optional<std::int64_t> key_frame() const;
  bool selected() const { return selected_.has_value(); }

  /// The button goes down: takes hold of an end or the middle of an arrow within `reach_px`, or begins a new one.
  void press(glm::dvec2 at_px, double reach_px);
  void drag(glm::dvec2 at_px);
  /// The button goes up: the scene's text with what was drawn or moved; empty if nothing was.
  /// A new arrow goes into every key frame, as all need as many.
  std::optional<std::string> release();
  /// The text without the selected arrow, in any key frame.
  std::optional<std::string> without_selected();
  /// The text with a key frame of its own at the frame looked at, for the surface of the selected or first arrow: it
  /// has the arrows as they are shown, so that they may turn from there.
  std::optional<std::string> with_key_here() const;

 private:
  using Arrow = pipeline::WaterArrows::Shown;
  enum class Grip { None, New, From, To, Whole };
  struct Chosen {
    std::size_t surface = 0, number = 0;
  };
  const Arrow* chosen() const;
  const pipeline::WaterArrowScene& in_scene(const Arrow& arrow) const;
  std::pair<glm::dvec2, glm::dvec2> dragged() const;
  std::optional<pipeline::WaterArrows::Placed> placed() const;
  std::string with_new(const pipeline::WaterArrows::Placed& placed) const;
  std::optional<std::string> with_moved(const Arrow& arrow, const pipeline::WaterArrows::Placed& placed) const;

  std::string text_;
  double frames_per_s_ = 0;
  std::optional<pipeline::WaterScene> water_;
  std::optional<pipeline::WaterArrows> arrows_;
  std::int64_t frame_ = 0;
  std::optional<RigidTransform> camera_from_world_;
  std::vector<Arrow> shown_;
  std::optional<Chosen> selected_;
  Grip grip_ = Grip::None;
  glm::dvec2 pressed_px_{0}, now_px_{0};
};

}  // namespace rinkaku::app

#pragma once

#include <array>
#include <memory>
#include <optional>

#include "pipeline/matte/estimator.h"

namespace rinkaku::matte {

struct ChromaOptions {
  /// The screen's colour, sRGB from 0 to 1; empty: the commonest strong colour of the first frame, its borders counting
  /// more.
  std::optional<std::array<double, 3>> key{};
  /// Alpha below the first becomes 0, above the second 1: what the screen's unevenness and noise need.
  double clip_low = 0.12;
  double clip_high = 0.9;
  /// How far from the screen's hue a colour may be and still count as screen, in degrees to either side.
  double hue_deg = 35;
  /// How much of the screen's reflection on the thing is taken away, 0 to 1.
  double despill = 1;
};

/// What stands before a screen of one strong colour.
///
/// A pixel's chroma is split into its part along the screen's hue and that across; what of the former is left after the
/// latter's share says how much screen is in it (after Vlahos' colour difference, as Jack, "Video demystified", 1996,
/// puts it). The screen's colour is measured place by place in each frame, so its light may be uneven and may change.
/// Along the border, between colours that are then known, alpha is solved by KnownBackground. Own colours follow from
/// picture = alpha own + (1 - alpha) screen, less the screen's reflection. What lies well inside the thing is opaque,
/// even if its colour is a little like the screen's. About 20 ns a pixel, and
/// 60 ns one of the thing's rectangle.
class ChromaMatte : public MatteEstimator {
 public:
  explicit ChromaMatte(const ChromaOptions& options = {});
  ~ChromaMatte() override;

  const char* name() const override { return "chroma"; }
  bool knows_behind() const override { return true; }
  /// Throws Error (Input) if no key is given and the first frame has no strong colour.
  void estimate(const Frame& frame, Matte& matte) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rinkaku::matte

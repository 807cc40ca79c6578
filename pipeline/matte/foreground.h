#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/matte/estimator.h"
#include "pipeline/matte/own_colour.h"
#include "pipeline/matte/picture.h"
#include "pipeline/matte/refinement.h"
#include "pipeline/matte/thing_line.h"

namespace rinkaku::matte {

struct ForegroundOptions {
  /// How several mattes of one thing become one: the largest alpha, the smallest, or in each pixel the one that is the
  /// most decided.
  enum class Combine { Maximum, Minimum, Confidence } combine = Combine::Maximum;
  /// Nothing outside counts ("garbage matte").
  std::optional<PixelRect> within{};
  /// Borders are moved to the plate's own, and kept steady.
  bool refine = false;
  /// A line is drawn around the thing.
  std::optional<ThingLineOptions> line{};
};

/// A filmed thing: one or several ways to find its matte, and what makes one good matte of them.
class Foreground {
 public:
  Foreground(std::vector<std::unique_ptr<MatteEstimator>> estimators, const ForegroundOptions& options);
  Foreground(Foreground&&) noexcept = default;
  ~Foreground() = default;

  /// The matte of this frame, with own colours and line; distance_m is left as it is.
  void find(const Frame& frame, Matte& matte);

 private:
  void find_alpha(const Frame& frame, Matte& matte);
  void combine(const Matte& with, Matte& matte) const;

  std::vector<std::unique_ptr<MatteEstimator>> estimators_;
  ForegroundOptions options_;
  bool own_colours_known_;
  std::optional<Refinement> refinement_;
  PictureReader reader_;
  OwnColours own_colours_;
  std::optional<ThingLine> line_;
  Matte other_;
};

}  // namespace rinkaku::matte

#pragma once

#include <functional>
#include <optional>
#include <string>

#include "pipeline/matte/estimator.h"
#include "pipeline/matte/picture.h"

namespace rinkaku::matte {

/// Gives the next frame of a video of mattes, nothing after the last.
using NextFrame = std::function<std::optional<Frame>()>;

/// Mattes that are read from a video or from images, one for each frame of the plate, by the frames' numbers.
///
/// The alpha channel is taken where there is one, else the brightness (limited range stretched).
class FileMatte : public MatteEstimator {
 public:
  /// `where` is for messages: the file's name.
  FileMatte(std::string where, NextFrame next);

  const char* name() const override { return "file"; }
  /// Throws Error (Input) if the file ends before the plate or its pictures have another size.
  void estimate(const Frame& frame, Matte& matte) override;

 private:
  std::string where_;
  NextFrame next_;
  PictureReader reader_;
};

}  // namespace rinkaku::matte

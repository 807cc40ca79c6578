#pragma once

#include <optional>
#include <utility>

#include "pipeline/matte/crop_box.h"
#include "pipeline/matte/estimator.h"
#include "pipeline/matte/person_network.h"

namespace rinkaku::matte {

/// A person, or persons close to each other, before any background and with a camera that moves.
///
/// A network that sees some 256 pixels looks at a box that follows the person. While nobody is known it looks at the
/// whole picture and at parts of half its size: all ten of them in the first frame, later the whole and one part in
/// each frame. So a person is found from about a fifth of the picture's height on, at once or within nine frames.
/// Borders are as sharp as the network's pixels: refine them (Refinement).
class SegmentationMatte : public MatteEstimator {
 public:
  explicit SegmentationMatte(FindPersons find) : find_(std::move(find)) {}

  const char* name() const override { return "segmentation"; }
  /// One run of the network while somebody is followed, up to three while nobody is, eleven in the first frame.
  void estimate(const Frame& frame, Matte& matte) override;

  /// Where it will look first in the next frame; empty if nobody was found.
  const PixelRect& box() const { return box_.rect(); }

 private:
  std::optional<PixelRect> look(const Picture& picture, const PixelRect& part);
  void keep_pieces(int largest);
  std::optional<PixelRect> search(const Picture& picture);
  void write(const PixelRect& part, Matte& matte);

  FindPersons find_;
  PictureReader reader_;
  CropBox box_;
  bool is_first_ = true;
  int next_part_ = 0;
  cv::Mat likely_, inside_, labels_, stats_, centres_, kept_, levels_;
};

}  // namespace rinkaku::matte

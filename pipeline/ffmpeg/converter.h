#pragma once

#include "pipeline/ffmpeg/handles.h"
#include "pipeline/frame/frame.h"

namespace rinkaku::ffmpeg {

/// Converts pictures to one format and size with swscale; the scaler is kept between pictures that are alike.
/// Grey and luma samples keep their values whatever the range. One thread at a time.
class Converter {
 public:
  /// `to.colour` decides matrix and range of the result.
  explicit Converter(PictureFormat to) : to_(std::move(to)) {}

  const PictureFormat& to() const { return to_; }

  /// A picture of its own with planes, format and storage set.
  /// Throws Error (Input) if swscale can't convert such pictures.
  Frame convert(const AVFrame& from);

 private:
  void prepare(const AVFrame& from);

  PictureFormat to_;
  FramePool pool_;
  ScalerPtr scaler_;
  int width_ = 0, height_ = 0, format_ = -1;
  ColourTags colour_;
};

}  // namespace rinkaku::ffmpeg

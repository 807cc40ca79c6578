#pragma once

#include <filesystem>
#include <memory>

#include "pipeline/frame/frame.h"
#include "water/reference_picture.h"

namespace rinkaku::pipeline {

/// Makes small RGB pictures of frames, each pixel the mean of those it stands for. One thread at a time.
class SmallPictures {
 public:
  /// No side of the pictures is longer than `most_px`. `alpha`: four channels, straight alpha; else three.
  explicit SmallPictures(int most_px, bool alpha = false);
  ~SmallPictures();
  SmallPictures(SmallPictures&&) noexcept;

  /// Throws Error (Input) if such frames can't be converted.
  void make(const Frame& frame, water::Picture& picture);

 private:
  struct Converting;
  int most_px_;
  bool alpha_;
  std::unique_ptr<Converting> converting_;
};

/// An image file, made smaller if a side is longer than `most_px`. Throws Error (Input).
water::Picture read_picture(const std::filesystem::path& file, int most_px, bool alpha = false);

}  // namespace rinkaku::pipeline

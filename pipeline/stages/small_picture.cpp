#include "pipeline/stages/small_picture.h"

#include <algorithm>
#include <cstring>

#include "pipeline/ffmpeg/converter.h"
#include "pipeline/ffmpeg/formats.h"
#include "pipeline/ffmpeg/frames.h"
#include "pipeline/source/picture_file.h"

namespace rinkaku::pipeline {

struct SmallPictures::Converting {
  PictureFormat from;
  ffmpeg::Converter converter;
};

SmallPictures::SmallPictures(int most_px, bool alpha) : most_px_(most_px), alpha_(alpha) {}
SmallPictures::~SmallPictures() = default;
SmallPictures::SmallPictures(SmallPictures&&) noexcept = default;

void SmallPictures::make(const Frame& frame, water::Picture& picture) {
  const PictureFormat& from = frame.format;
  if (!converting_ || !(converting_->from == from)) {
    const double factor = std::min(1.0, static_cast<double>(most_px_) / std::max(from.width_px, from.height_px));
    PictureFormat to;
    to.width_px = std::max(1, static_cast<int>(std::lround(from.width_px * factor)));
    to.height_px = std::max(1, static_cast<int>(std::lround(from.height_px * factor)));
    to.pixels = ffmpeg::to_pixel_format(alpha_ ? AV_PIX_FMT_RGBA : AV_PIX_FMT_RGB24);
    to.colour = {1, 13, 0, ColourTags::Range::Full, 0};
    converting_ = std::make_unique<Converting>(Converting{from, ffmpeg::Converter(to)});
  }
  const Frame small = converting_->converter.convert(*ffmpeg::wrap(frame));
  picture.width_px = small.format.width_px, picture.height_px = small.format.height_px;
  picture.channels = alpha_ ? 4 : 3;
  const std::size_t row = static_cast<std::size_t>(picture.width_px) * picture.channels;
  picture.samples.resize(row * picture.height_px);
  for (int y = 0; y < picture.height_px; ++y) {
    std::memcpy(picture.samples.data() + y * row, small.planes[0].data + y * small.planes[0].stride_bytes, row);
  }
}

water::Picture read_picture(const std::filesystem::path& file, int most_px, bool alpha) {
  water::Picture picture;
  SmallPictures(most_px, alpha).make(source::read_picture(file.string()), picture);
  return picture;
}

}  // namespace rinkaku::pipeline

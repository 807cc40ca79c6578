#include "pipeline/source/picture_file.h"

#include <optional>
#include <utility>

#include "pipeline/ffmpeg/converter.h"
#include "pipeline/ffmpeg/formats.h"
#include "pipeline/ffmpeg/frames.h"
#include "pipeline/frame/error.h"
#include "pipeline/source/source.h"

namespace rinkaku::source {

Frame read_picture(const std::string& path) {
  OpenOptions options;
  options.threads = 1;  // there is one picture
  const auto source = open(path, options);
  std::optional<Frame> frame = source->next();
  if (!frame) throw input_error(path, "it can't be read as a picture", "give a PNG, JPEG, TIFF or WebP file");
  if (!source->damage().empty()) {
    throw input_error("", source->damage(), "give a picture that is whole");
  }
  return std::move(*frame);
}

Frame to_rgba(const Frame& frame) {
  PictureFormat rgba = frame.format;
  rgba.pixels = ffmpeg::to_pixel_format(AV_PIX_FMT_RGBA);
  rgba.colour.matrix = 0;
  rgba.colour.range = ColourTags::Range::Full;
  return ffmpeg::Converter(rgba).convert(*ffmpeg::wrap(frame));
}

}  // namespace rinkaku::source

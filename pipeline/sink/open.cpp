#include "pipeline/ffmpeg/number_pattern.h"
#include "pipeline/frame/error.h"
#include "pipeline/sink/image_sink.h"
#include "pipeline/sink/sink.h"
#include "pipeline/sink/video_sink.h"
#include "pipeline/sink/y4m_sink.h"

namespace rinkaku::sink {

std::unique_ptr<Sink> open(const Options& options, const Incoming& incoming) {
  const bool y4m = options.container == "y4m" || (options.container.empty() && options.path.ends_with(".y4m"));
  if (y4m && options.codec.empty()) return std::make_unique<Y4mSink>(options, incoming);
  const AVCodec* image = options.container.empty() ? image_encoder(options.path) : nullptr;
  if (!image) return std::make_unique<VideoSink>(options, incoming);
  if (!options.codec.empty() && options.codec != image->name && options.codec != avcodec_get_name(image->id)) {
    throw input_error(options.path, "its ending asks for " + std::string(image->name) + " and not " + options.codec,
                      "leave the codec out or choose another ending");
  }
  return std::make_unique<ImageSink>(options, incoming, *image);
}

}  // namespace rinkaku::sink

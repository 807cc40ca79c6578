#include "pipeline/sink/y4m_sink.h"

#include <algorithm>

#include "pipeline/ffmpeg/formats.h"
#include "pipeline/ffmpeg/frames.h"
#include "pipeline/frame/error.h"
#include "pipeline/sink/output_url.h"

namespace rinkaku::sink {
namespace {

// Deeper than 8 bits is an extension that FFmpeg, x264 and others share.
constexpr AVPixelFormat formats[] = {AV_PIX_FMT_YUV420P,     AV_PIX_FMT_YUV422P,     AV_PIX_FMT_YUV444P,
                                     AV_PIX_FMT_YUV411P,     AV_PIX_FMT_GRAY8,       AV_PIX_FMT_YUV420P10LE,
                                     AV_PIX_FMT_YUV422P10LE, AV_PIX_FMT_YUV444P10LE, AV_PIX_FMT_YUV420P12LE,
                                     AV_PIX_FMT_YUV422P12LE, AV_PIX_FMT_YUV444P12LE, AV_PIX_FMT_YUV420P16LE,
                                     AV_PIX_FMT_YUV422P16LE, AV_PIX_FMT_YUV444P16LE, AV_PIX_FMT_GRAY10LE,
                                     AV_PIX_FMT_GRAY12LE,    AV_PIX_FMT_GRAY16LE,    AV_PIX_FMT_NONE};

// The C tag: subsampling and depth, and for 4:2:0 where chroma lies.
std::string colour_space(const PictureFormat& format) {
  const int depth = format.pixels.component[0].depth_bits;
  const std::string bits = depth == 8 ? "" : std::to_string(depth);
  if (format.pixels.model == ColourModel::Grey) return "mono" + bits;
  const std::string& name = format.pixels.name;
  std::string sampling = name.substr(3, 3);  // of "yuv420p"
  if (depth > 8) return sampling + "p" + bits + " XYSCSS=" + sampling + "P" + bits;
  if (sampling != "420") return sampling;
  const int location = format.colour.chroma_location;
  if (location == AVCHROMA_LOC_LEFT) return "420mpeg2 XYSCSS=420MPEG2";
  if (location == AVCHROMA_LOC_TOPLEFT) return "420paldv XYSCSS=420PALDV";
  return "420jpeg XYSCSS=420JPEG";
}

}  // namespace

Y4mSink::Y4mSink(const Options& options, const Incoming& incoming)
    : path_(options.path),
      file_(options.path, options.overwrite, incoming.copy_streams_from),
      format_(choose_format("y4m", formats, incoming.format)),
      rate_(incoming.frame_rate.num > 0 ? ffmpeg::to_av(incoming.frame_rate) : AVRational{25, 1}),
      notice_(format_.notice) {
  if (incoming.variable_frame_rate) {
    notice_ += (notice_.empty() ? "" : "; ") + std::string("y4m carries no times: frames are shown at an even rate");
  }
  if (!(format_.picture == incoming.format)) converter_.emplace(format_.picture);
  if (const int code = avio_open(&io_, output_url(file_).c_str(), AVIO_FLAG_WRITE); code < 0)
    throw_write_error(path_, code, true);
}

Y4mSink::~Y4mSink() {
  if (io_) avio_closep(&io_);
}

void Y4mSink::check(int code) const {
  if (code < 0) throw_write_error(path_, code);
}

void Y4mSink::write_header(const Frame& first) {
  const PictureFormat& format = format_.picture;
  std::string line = "YUV4MPEG2 W" + std::to_string(format.width_px) + " H" + std::to_string(format.height_px);
  line += " F" + std::to_string(rate_.num) + ":" + std::to_string(rate_.den);
  line += first.interlaced ? (first.top_field_first ? " It" : " Ib") : " Ip";
  line += " A" + std::to_string(format.sample_aspect.num) + ":" +
          std::to_string(format.sample_aspect.num == 0 ? 0 : format.sample_aspect.den);
  line += " C" + colour_space(format);
  if (format.colour.range == ColourTags::Range::Full) line += " XCOLORRANGE=FULL";
  if (format.colour.range == ColourTags::Range::Limited) line += " XCOLORRANGE=LIMITED";
  line += "\n";
  avio_write(io_, reinterpret_cast<const unsigned char*>(line.data()), static_cast<int>(line.size()));
}

void Y4mSink::write(const Frame& frame) {
  if (!started_) write_header(frame);
  started_ = true;
  const Frame& shown = converter_ ? converter_->convert(*ffmpeg::wrap(frame)) : frame;
  constexpr unsigned char mark[] = {'F', 'R', 'A', 'M', 'E', '\n'};
  avio_write(io_, mark, sizeof mark);
  for (int p = 0; p < shown.format.pixels.planes; ++p) {
    const Plane& plane = shown.planes[static_cast<std::size_t>(p)];
    for (int y = 0; y < plane.rows; ++y) avio_write(io_, plane.data + y * plane.stride_bytes, plane.row_bytes);
  }
  check(io_->error);
}

void Y4mSink::finish() {
  if (!io_) return;
  if (!started_) throw runtime_failure(path_, "no frame came, so nothing is written");
  avio_flush(io_);
  check(io_->error);
  check(avio_closep(&io_));
  file_.commit();
}

}  // namespace rinkaku::sink

#include "pipeline/source/v4l2/unpack.h"

#include <cstring>
#include <optional>

#include <linux/videodev2.h>

#include <libyuv.h>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include "pipeline/ffmpeg/formats.h"
#include "pipeline/ffmpeg/frames.h"
#include "pipeline/ffmpeg/handles.h"
#include "pipeline/ffmpeg/log.h"
#include "pipeline/frame/error.h"

namespace rinkaku::source::v4l2 {
namespace {

PictureFormat unpacked_format(const Agreed& agreed) {
  PictureFormat format;
  format.width_px = agreed.width_px;
  format.height_px = agreed.height_px;
  format.colour = agreed.colour;
  if (!compressed(agreed.format)) {
    format.pixels = ffmpeg::to_pixel_format(av_get_pix_fmt(unpacked_name(agreed.format).c_str()));
  }
  return format;
}

// Bytes of a row as the driver lays it out; some leave the stride 0.
int stride_of(const Agreed& agreed) {
  if (agreed.stride_bytes > 0) return agreed.stride_bytes;
  const bool packed = agreed.format == V4L2_PIX_FMT_YUYV || agreed.format == V4L2_PIX_FMT_UYVY;
  return packed ? (agreed.width_px + 1) / 2 * 4 : agreed.width_px;
}

std::size_t least_bytes(const Agreed& agreed) {
  const auto stride = static_cast<std::size_t>(stride_of(agreed)), rows = static_cast<std::size_t>(agreed.height_px);
  switch (agreed.format) {
    case V4L2_PIX_FMT_NV12:
      return stride * rows + stride * ((rows + 1) / 2);
    case V4L2_PIX_FMT_YUV420:
      return stride * rows + 2 * ((stride + 1) / 2) * ((rows + 1) / 2);
    default:
      return stride * rows;
  }
}

}  // namespace

// FFmpeg's decoder, on the calling thread: frame threads would add frames of latency.
class Unpacker::Jpeg {
 public:
  Jpeg() : packet_(av_packet_alloc()) {
    const AVCodec* codec = avcodec_find_decoder(AV_CODEC_ID_MJPEG);
    if (codec) decoder_.reset(avcodec_alloc_context3(codec));
    if (!decoder_ || !packet_) throw runtime_failure("MJPEG", "FFmpeg has no decoder for it");
    decoder_->thread_count = 1;
    listener_.emplace(decoder_.get());
    if (avcodec_open2(decoder_.get(), codec, nullptr) < 0) throw runtime_failure("MJPEG", "no decoder can be opened");
  }

  std::optional<Frame> decode(std::span<const std::uint8_t> bytes, const ColourTags& told) {
    padded_.resize(bytes.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    std::memcpy(padded_.data(), bytes.data(), bytes.size());
    std::memset(padded_.data() + bytes.size(), 0, AV_INPUT_BUFFER_PADDING_SIZE);
    packet_->data = padded_.data();
    packet_->size = static_cast<int>(bytes.size());
    if (avcodec_send_packet(decoder_.get(), packet_.get()) < 0) return std::nullopt;
    ffmpeg::FramePtr picture(av_frame_alloc());
    if (!picture || avcodec_receive_frame(decoder_.get(), picture.get()) < 0) return std::nullopt;
    if (picture->decode_error_flags || picture->flags & AV_FRAME_FLAG_CORRUPT) return std::nullopt;
    const auto pixels = static_cast<AVPixelFormat>(picture->format);
    if (!ffmpeg::addressable(ffmpeg::without_j(pixels))) return std::nullopt;
    PictureFormat format;
    format.width_px = picture->width;
    format.height_px = picture->height;
    format.pixels = ffmpeg::to_pixel_format(pixels);
    // JFIF leaves only the primaries and the transfer open, which the driver knows.
    format.colour = ffmpeg::colour_of(*picture);
    if (format.colour.primaries == 2) format.colour.primaries = told.primaries;
    if (format.colour.transfer == 2) format.colour.transfer = told.transfer;
    return ffmpeg::wrap(std::move(picture), format);
  }

 private:
  ffmpeg::CodecPtr decoder_;
  std::optional<ffmpeg::LogListener> listener_;
  ffmpeg::PacketPtr packet_;
  std::vector<std::uint8_t> padded_;
};

Unpacker::Unpacker(const Agreed& agreed) : agreed_(agreed), format_(unpacked_format(agreed)) {
  if (compressed(agreed.format)) jpeg_ = std::make_unique<Jpeg>();
}
Unpacker::~Unpacker() = default;
Unpacker::Unpacker(Unpacker&&) noexcept = default;
Unpacker& Unpacker::operator=(Unpacker&&) noexcept = default;

std::optional<Frame> Unpacker::frame(std::span<const std::uint8_t> bytes) {
  if (jpeg_) return jpeg_->decode(bytes, agreed_.colour);
  if (bytes.size() < least_bytes(agreed_)) return std::nullopt;
  Frame frame = pool_.allocate(format_);
  const auto data = [&](std::size_t plane) { return frame.planes[plane].data; };
  const auto stride = [&](std::size_t plane) { return static_cast<int>(frame.planes[plane].stride_bytes); };
  const std::uint8_t* from = bytes.data();
  const int from_stride = stride_of(agreed_), width = agreed_.width_px, height = agreed_.height_px;
  const std::uint8_t* second = from + static_cast<std::ptrdiff_t>(from_stride) * height;
  switch (agreed_.format) {
    case V4L2_PIX_FMT_YUYV:
      libyuv::YUY2ToI422(from, from_stride, data(0), stride(0), data(1), stride(1), data(2), stride(2), width, height);
      break;
    case V4L2_PIX_FMT_UYVY:
      libyuv::UYVYToI422(from, from_stride, data(0), stride(0), data(1), stride(1), data(2), stride(2), width, height);
      break;
    case V4L2_PIX_FMT_NV12:
      libyuv::NV12ToI420(from, from_stride, second, from_stride, data(0), stride(0), data(1), stride(1), data(2),
                         stride(2), width, height);
      break;
    case V4L2_PIX_FMT_YUV420: {
      const int half_stride = (from_stride + 1) / 2, half_height = (height + 1) / 2;
      const std::uint8_t* third = second + static_cast<std::ptrdiff_t>(half_stride) * half_height;
      libyuv::I420Copy(from, from_stride, second, half_stride, third, half_stride, data(0), stride(0), data(1),
                       stride(1), data(2), stride(2), width, height);
      break;
    }
    default:
      libyuv::CopyPlane(from, from_stride, data(0), stride(0), width, height);
  }
  return frame;
}

}  // namespace rinkaku::source::v4l2

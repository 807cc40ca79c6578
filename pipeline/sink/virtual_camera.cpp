#include "pipeline/sink/virtual_camera.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <vector>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <libyuv.h>

#include "pipeline/ffmpeg/converter.h"
#include "pipeline/ffmpeg/formats.h"
#include "pipeline/ffmpeg/frames.h"
#include "pipeline/frame/error.h"

namespace rinkaku::sink {
namespace {

constexpr const char* remedy = "load v4l2loopback (Debian: v4l2loopback-dkms, then modprobe v4l2loopback)";

// What goes to the device is packed from this.
PictureFormat planar_format(const PictureFormat& coming) {
  PictureFormat format = coming;
  format.pixels = ffmpeg::to_pixel_format(AV_PIX_FMT_YUV422P);
  format.colour.range = ColourTags::Range::Limited;
  if (coming.pixels.model == ColourModel::Rgb) {
    format.colour.matrix = ffmpeg::assumed_matrix(coming.width_px, coming.height_px);
  }
  return format;
}

bool packs_as_it_is(const PictureFormat& format) {
  const bool planar = format.pixels.name == "yuv422p" || format.pixels.name == "yuv420p";
  return planar && format.colour.range != ColourTags::Range::Full;
}

void describe_colour(const PictureFormat& format, v4l2_pix_format& to) {
  const int matrix =
      format.colour.matrix == 2 ? ffmpeg::assumed_matrix(format.width_px, format.height_px) : format.colour.matrix;
  to.colorspace = format.colour.primaries == 6 ? V4L2_COLORSPACE_SMPTE170M : V4L2_COLORSPACE_REC709;
  to.ycbcr_enc = matrix == 1 ? V4L2_YCBCR_ENC_709 : matrix == 9 ? V4L2_YCBCR_ENC_BT2020 : V4L2_YCBCR_ENC_601;
  to.quantization = V4L2_QUANTIZATION_LIM_RANGE;
}

class VirtualCamera final : public Sink {
 public:
  VirtualCamera(const std::string& device, const Incoming& incoming);
  ~VirtualCamera() override { ::close(descriptor_); }
  VirtualCamera(const VirtualCamera&) = delete;
  VirtualCamera& operator=(const VirtualCamera&) = delete;

  void write(const Frame& frame) override;
  void finish() override {}

 private:
  void agree(const Incoming& incoming);
  void pack(const Frame& frame);

  std::string device_;
  int descriptor_ = -1;
  int stride_bytes_ = 0;
  std::vector<std::uint8_t> packed_;
  std::optional<ffmpeg::Converter> converter_;
};

VirtualCamera::VirtualCamera(const std::string& device, const Incoming& incoming) : device_(device) {
  descriptor_ = ::open(device.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw input_error(device, std::string("can't be opened as a virtual camera: ") + std::strerror(errno), remedy);
  }
  try {
    agree(incoming);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
  if (!packs_as_it_is(incoming.format)) converter_.emplace(planar_format(incoming.format));
}

void VirtualCamera::agree(const Incoming& incoming) {
  v4l2_capability told{};
  const bool asked = ::ioctl(descriptor_, VIDIOC_QUERYCAP, &told) == 0;
  const __u32 can = told.capabilities & V4L2_CAP_DEVICE_CAPS ? told.device_caps : told.capabilities;
  if (!asked || !(can & V4L2_CAP_VIDEO_OUTPUT)) {
    throw input_error(device_, "is no video output that could be a virtual camera", remedy);
  }
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  format.fmt.pix.width = static_cast<__u32>(incoming.format.width_px);
  format.fmt.pix.height = static_cast<__u32>(incoming.format.height_px);
  format.fmt.pix.pixelformat = V4L2_PIX_FMT_YUYV;
  format.fmt.pix.field = V4L2_FIELD_NONE;
  format.fmt.pix.bytesperline = static_cast<__u32>((incoming.format.width_px + 1) / 2 * 4);
  format.fmt.pix.sizeimage = format.fmt.pix.bytesperline * format.fmt.pix.height;
  describe_colour(incoming.format, format.fmt.pix);
  const v4l2_pix_format wanted = format.fmt.pix;
  const bool taken = ::ioctl(descriptor_, VIDIOC_S_FMT, &format) == 0;
  const v4l2_pix_format& got = format.fmt.pix;
  if (!taken || got.pixelformat != wanted.pixelformat || got.width != wanted.width || got.height != wanted.height) {
    throw input_error(device_,
                      "doesn't take pictures of " + std::to_string(wanted.width) + "x" + std::to_string(wanted.height),
                      "end the programs that read it, or choose another size or device");
  }
  stride_bytes_ = static_cast<int>(std::max(got.bytesperline, wanted.bytesperline));
  packed_.resize(static_cast<std::size_t>(stride_bytes_) * got.height);
}

void VirtualCamera::pack(const Frame& frame) {
  const auto data = [&](std::size_t plane) { return frame.planes[plane].data; };
  const auto stride = [&](std::size_t plane) { return static_cast<int>(frame.planes[plane].stride_bytes); };
  const auto by = frame.format.pixels.name == "yuv420p" ? libyuv::I420ToYUY2 : libyuv::I422ToYUY2;
  by(data(0), stride(0), data(1), stride(1), data(2), stride(2), packed_.data(), stride_bytes_, frame.format.width_px,
     frame.format.height_px);
}

void VirtualCamera::write(const Frame& frame) {
  if (converter_) {
    const ffmpeg::FramePtr wrapped = ffmpeg::wrap(frame);
    pack(converter_->convert(*wrapped));
  } else {
    pack(frame);
  }
  ssize_t written = -1;
  do {
    written = ::write(descriptor_, packed_.data(), packed_.size());
  } while (written < 0 && errno == EINTR);
  if (written < 0) {
    throw runtime_failure(device_, std::string("the virtual camera takes no picture: ") + std::strerror(errno), remedy);
  }
}

}  // namespace

std::unique_ptr<Sink> open_virtual_camera(const std::string& device, const Incoming& incoming) {
  return std::make_unique<VirtualCamera>(device, incoming);
}

}  // namespace rinkaku::sink

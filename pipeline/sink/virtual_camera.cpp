#include "pipeline/sink/virtual_camera.h"

#include <cerrno>
#include <cstring>
#include <span>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "pipeline/frame/error.h"
#include "pipeline/sink/pipewire_camera.h"
#include "pipeline/sink/yuyv_packer.h"

namespace rinkaku::sink {
namespace {

constexpr const char* remedy = "load v4l2loopback (Debian: v4l2loopback-dkms, then modprobe v4l2loopback)";

void describe_colour(const PictureFormat& format, v4l2_pix_format& to) {
  const int matrix = format.colour.matrix;
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
  void agree();

  std::string device_;
  YuyvPacker packer_;
  int descriptor_ = -1;
};

VirtualCamera::VirtualCamera(const std::string& device, const Incoming& incoming)
    : device_(device), packer_(incoming.format) {
  descriptor_ = ::open(device.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw input_error(device, std::string("can't be opened as a virtual camera: ") + std::strerror(errno), remedy);
  }
  try {
    agree();
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

void VirtualCamera::agree() {
  v4l2_capability told{};
  const bool asked = ::ioctl(descriptor_, VIDIOC_QUERYCAP, &told) == 0;
  const __u32 can = told.capabilities & V4L2_CAP_DEVICE_CAPS ? told.device_caps : told.capabilities;
  if (!asked || !(can & V4L2_CAP_VIDEO_OUTPUT)) {
    throw input_error(device_, "is no video output that could be a virtual camera", remedy);
  }
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  format.fmt.pix.width = static_cast<__u32>(packer_.format().width_px);
  format.fmt.pix.height = static_cast<__u32>(packer_.format().height_px);
  format.fmt.pix.pixelformat = V4L2_PIX_FMT_YUYV;
  format.fmt.pix.field = V4L2_FIELD_NONE;
  format.fmt.pix.bytesperline = static_cast<__u32>(packer_.stride_bytes());
  format.fmt.pix.sizeimage = format.fmt.pix.bytesperline * format.fmt.pix.height;
  describe_colour(packer_.format(), format.fmt.pix);
  const v4l2_pix_format wanted = format.fmt.pix;
  const bool taken = ::ioctl(descriptor_, VIDIOC_S_FMT, &format) == 0;
  const v4l2_pix_format& got = format.fmt.pix;
  if (!taken || got.pixelformat != wanted.pixelformat || got.width != wanted.width || got.height != wanted.height) {
    throw input_error(device_,
                      "doesn't take pictures of " + std::to_string(wanted.width) + "x" + std::to_string(wanted.height),
                      "end the programs that read it, or choose another size or device");
  }
}

void VirtualCamera::write(const Frame& frame) {
  const std::span<const std::uint8_t> packed = packer_.pack(frame);
  ssize_t written = -1;
  do {
    written = ::write(descriptor_, packed.data(), packed.size());
  } while (written < 0 && errno == EINTR);
  if (written < 0) {
    throw runtime_failure(device_, std::string("the virtual camera takes no picture: ") + std::strerror(errno), remedy);
  }
}

}  // namespace

std::unique_ptr<Sink> open_virtual_camera(const std::string& device, const Incoming& incoming) {
  if (device == "pipewire") return open_pipewire_camera(incoming);
  return std::make_unique<VirtualCamera>(device, incoming);
}

}  // namespace rinkaku::sink

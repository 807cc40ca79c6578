#include "pipeline/source/v4l2/pixel_layout.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <linux/videodev2.h>

namespace rinkaku::source::v4l2 {
namespace {

struct Known {
  FourCc code;
  const char* ffmpeg_name;
  const char* unpacked;
};

constexpr std::array<Known, 6> known{{{V4L2_PIX_FMT_YUYV, "yuyv422", "yuv422p"},
                                      {V4L2_PIX_FMT_UYVY, "uyvy422", "yuv422p"},
                                      {V4L2_PIX_FMT_NV12, "nv12", "yuv420p"},
                                      {V4L2_PIX_FMT_YUV420, "yuv420p", "yuv420p"},
                                      {V4L2_PIX_FMT_GREY, "gray", "gray"},
                                      {V4L2_PIX_FMT_MJPEG, "mjpeg", ""}}};

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

// Code points of ITU-T H.273.
int primaries_of(__u32 space) {
  switch (space) {
    case V4L2_COLORSPACE_SMPTE170M:
      return 6;
    case V4L2_COLORSPACE_SMPTE240M:
      return 7;
    case V4L2_COLORSPACE_REC709:
    case V4L2_COLORSPACE_SRGB:
    case V4L2_COLORSPACE_JPEG:
      return 1;
    case V4L2_COLORSPACE_BT2020:
      return 9;
    case V4L2_COLORSPACE_470_SYSTEM_M:
      return 4;
    case V4L2_COLORSPACE_470_SYSTEM_BG:
      return 5;
    case V4L2_COLORSPACE_DCI_P3:
      return 11;
    default:
      return 2;
  }
}

int transfer_of(__u32 transfer) {
  switch (transfer) {
    case V4L2_XFER_FUNC_709:
      return 1;
    case V4L2_XFER_FUNC_SRGB:
      return 13;
    case V4L2_XFER_FUNC_SMPTE240M:
      return 7;
    case V4L2_XFER_FUNC_NONE:
      return 8;
    case V4L2_XFER_FUNC_SMPTE2084:
      return 16;
    default:
      return 2;
  }
}

int matrix_of(__u32 encoding) {
  switch (encoding) {
    case V4L2_YCBCR_ENC_601:
    case V4L2_YCBCR_ENC_XV601:
      return 6;
    case V4L2_YCBCR_ENC_709:
    case V4L2_YCBCR_ENC_XV709:
      return 1;
    case V4L2_YCBCR_ENC_BT2020:
      return 9;
    case V4L2_YCBCR_ENC_BT2020_CONST_LUM:
      return 10;
    case V4L2_YCBCR_ENC_SMPTE240M:
      return 7;
    default:
      return 2;
  }
}

}  // namespace

std::string name_of(FourCc code) {
  std::string name;
  for (int shift = 0; shift < 32; shift += 8) {
    const char letter = static_cast<char>(code >> shift & 0x7f);
    if (letter > ' ') name += letter;
  }
  return name;
}

const std::vector<FourCc>& readable_formats() {
  static const std::vector<FourCc> codes = [] {
    std::vector<FourCc> all;
    for (const Known& each : known) all.push_back(each.code);
    return all;
  }();
  return codes;
}

bool readable(FourCc code) {
  const std::vector<FourCc>& codes = readable_formats();
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

bool compressed(FourCc code) { return code == V4L2_PIX_FMT_MJPEG; }

FourCc format_named(const std::string& name) {
  for (const Known& each : known) {
    if (upper(name) == name_of(each.code) || upper(name) == upper(each.ffmpeg_name)) return each.code;
  }
  return 0;
}

std::string unpacked_name(FourCc code) {
  const auto* found = std::find_if(known.begin(), known.end(), [code](const Known& k) { return k.code == code; });
  return found == known.end() ? "" : found->unpacked;
}

ColourTags colour_of(const v4l2_pix_format& format) {
  ColourTags tags;
  const __u32 space = format.colorspace;
  if (space == V4L2_COLORSPACE_DEFAULT) return tags;
  __u32 encoding = format.ycbcr_enc, transfer = format.xfer_func, range = format.quantization;
  if (encoding == V4L2_YCBCR_ENC_DEFAULT) encoding = V4L2_MAP_YCBCR_ENC_DEFAULT(space);
  if (transfer == V4L2_XFER_FUNC_DEFAULT) transfer = V4L2_MAP_XFER_FUNC_DEFAULT(space);
  if (range == V4L2_QUANTIZATION_DEFAULT) range = V4L2_MAP_QUANTIZATION_DEFAULT(false, space, encoding);
  tags.primaries = primaries_of(space);
  tags.transfer = transfer_of(transfer);
  tags.matrix = matrix_of(encoding);
  tags.range = range == V4L2_QUANTIZATION_FULL_RANGE ? ColourTags::Range::Full : ColourTags::Range::Limited;
  tags.chroma_location = format.pixelformat == V4L2_PIX_FMT_GREY ? 0 : 1;  // to the left, as MPEG-2 has it
  return tags;
}

}  // namespace rinkaku::source::v4l2

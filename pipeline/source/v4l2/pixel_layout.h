#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/frame/picture_format.h"

struct v4l2_pix_format;

namespace rinkaku::source::v4l2 {

/// A camera's format by its four letters, as drivers and `v4l2-ctl` write it: "YUYV", "NV12", "MJPG".
using FourCc = std::uint32_t;
std::string name_of(FourCc code);

/// The formats that are read, the ones that cost least first: YUYV, UYVY, NV12, YU12, GREY, MJPG.
const std::vector<FourCc>& readable_formats();
bool readable(FourCc code);
bool compressed(FourCc code);

/// A format by its name, upper or lower case, also as FFmpeg calls it ("yuyv422", "mjpeg", "yuv420p"); 0 if none of
/// ours.
FourCc format_named(const std::string& name);

/// FFmpeg's name of the planar layout that a driver's pictures are unpacked to, sample for sample: packed 4:2:2 becomes
/// yuv422p, NV12 becomes yuv420p. Precondition: readable and not compressed.
std::string unpacked_name(FourCc code);

/// The driver's colour space, matrix, transfer and range; what it leaves open is what V4L2 says for the colour space.
ColourTags colour_of(const v4l2_pix_format& format);

}  // namespace rinkaku::source::v4l2

#include "pipeline/ffmpeg/version.h"

extern "C" {
#include <libavutil/avutil.h>
}

namespace rinkaku::ffmpeg {

std::string version() { return av_version_info(); }

}  // namespace rinkaku::ffmpeg

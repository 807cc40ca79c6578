#include "pipeline/sink/output_url.h"

#include "pipeline/ffmpeg/handles.h"
#include "pipeline/ffmpeg/log.h"
#include "pipeline/frame/error.h"

namespace rinkaku::sink {

std::string output_url(const files::PendingFile& file) {
  return file.open_path() == "-" ? "pipe:1" : "file:" + file.open_path();
}

void throw_write_error(const std::string& path, int code, bool opening) {
  const std::string name = path == "-" ? "standard output" : path;
  const std::string text = "can't be written: " + ffmpeg::error_text(code);
  if (code == AVERROR(ENOSPC) || code == AVERROR(EFBIG) || code == AVERROR(EDQUOT)) {
    throw runtime_failure(name, text, "free some space or choose another place");
  }
  if (opening) throw input_error(name, text, "choose another output or change the permissions");
  throw runtime_failure(name, text);
}

}  // namespace rinkaku::sink

#include "pipeline/sink/pending_file.h"

#include <filesystem>
#include <system_error>

#include <unistd.h>

#include "pipeline/ffmpeg/handles.h"
#include "pipeline/ffmpeg/log.h"
#include "pipeline/frame/error.h"

namespace rinkaku::sink {
namespace {

namespace fs = std::filesystem;

void check_folder(const std::string& path, const fs::path& folder) {
  std::error_code error;
  const auto status = fs::status(folder, error);
  if (!fs::exists(status)) {
    throw input_error(path, "the folder " + folder.string() + " does not exist", "create it or choose another");
  }
  if (!fs::is_directory(status)) {
    throw input_error(path, folder.string() + " is no folder", "choose another output");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw input_error(path, "the folder " + folder.string() + " can't be written",
                      "choose another or change its permissions");
  }
}

}  // namespace

PendingFile::PendingFile(const std::string& path, bool overwrite, const std::string& input) : final_(path) {
  if (path == "-") {
    url_ = "pipe:1";
    return;
  }
  if (path.empty()) throw input_error("", "the name of the output is empty", "give a file name");
  std::error_code error;
  const auto status = fs::status(path, error);
  if (fs::is_directory(status)) throw input_error(path, "is a folder", "give a file name");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    url_ = "file:" + path;  // a device or pipe is never replaced
    return;
  }
  if (fs::exists(status)) {
    if (!input.empty() && fs::equivalent(path, input, error)) {
      throw input_error(path, "is the input itself", "choose another output");
    }
    if (!overwrite)
      throw input_error(path, "exists already", "give --force to write over it, or choose another output");
    // Behind a link, the file is replaced and not the link.
    final_ = fs::canonical(path, error).string();
    if (error) final_ = path;
  }
  const fs::path target(final_);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  check_folder(path, folder);
  std::string name(".");
  name.append(target.filename().string()).append(".").append(std::to_string(::getpid())).append(".part");
  temporary_ = (folder / name).string();
  url_ = "file:" + temporary_;
}

PendingFile::~PendingFile() {
  if (temporary_.empty()) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void PendingFile::commit() {
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(temporary_, final_, error);
  if (error) throw runtime_failure(final_, "can't be put in place: " + error.message());
  temporary_.clear();
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

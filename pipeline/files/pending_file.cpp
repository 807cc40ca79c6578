#include "pipeline/files/pending_file.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include <unistd.h>

#include "pipeline/frame/error.h"

namespace rinkaku::files {
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

PendingFile::PendingFile(const std::string& path, bool overwrite, const std::string& input, Appears appears)
    : final_(path) {
  if (path == "-") return;
  if (path.empty()) throw input_error("", "the name of the output is empty", "give a file name");
  std::error_code error;
  const auto status = fs::status(path, error);
  if (fs::is_directory(status)) throw input_error(path, "is a folder", "give a file name");
  if (fs::exists(status) && !fs::is_regular_file(status)) return;  // a device or pipe is never replaced
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
  if (appears == Appears::AtOnce) return;
  std::string name(".");
  name.append(target.filename().string()).append(".").append(std::to_string(::getpid())).append(".part");
  temporary_ = (folder / name).string();
}

PendingFile::~PendingFile() {
  if (temporary_.empty()) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void PendingFile::must_not_be(const std::string& other) const {
  std::error_code error;
  const auto place = [&error](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path, error), error); };
  if (final_ != "-" && place(final_) == place(other)) {
    throw input_error(final_, "is named twice, as two files of this call", "give two names");
  }
}

void PendingFile::commit() {
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(temporary_, final_, error);
  if (error) throw runtime_failure(final_, "can't be put in place: " + error.message());
  temporary_.clear();
}

void PendingFile::write(std::string_view bytes) {
  const bool to_stdout = final_ == "-";
  const auto close = [](std::FILE* file) { return file == stdout ? 0 : std::fclose(file); };
  std::unique_ptr<std::FILE, decltype(close)> file(to_stdout ? stdout : std::fopen(open_path().c_str(), "wb"), close);
  const std::string name = to_stdout ? "standard output" : final_;
  if (!file) {
    throw input_error(name, "can't be written: " + std::generic_category().message(errno),
                      "choose another output or change the permissions");
  }
  bool whole = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  whole = std::fflush(file.get()) == 0 && whole;
  const int code = errno;
  whole = close(file.release()) == 0 && whole;
  if (!whole) {
    throw runtime_failure(name, "can't be written: " + std::generic_category().message(code),
                          "free some space or choose another place");
  }
  commit();
}

void PendingFile::write(std::span<const std::uint8_t> bytes) {
  write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void write_file(const std::string& path, std::string_view bytes) { PendingFile(path, true).write(bytes); }

}  // namespace rinkaku::files

#include "apps/rinkaku/whole_file.h"

#include <fstream>

#include <unistd.h>

#include "pipeline/frame/error.h"

namespace rinkaku::app {

WholeFile::WholeFile(std::filesystem::path path, bool overwrite) : path_(std::move(path)) {
  if (std::filesystem::is_directory(path_)) throw input_error(path_.string(), "is a folder", "give a file name");
  if (std::filesystem::exists(path_) && !overwrite) {
    throw input_error(path_.string(), "it exists already", "give another name, or --force to write over it");
  }
  std::filesystem::path folder = path_.parent_path();
  if (folder.empty()) folder = ".";
  if (!std::filesystem::is_directory(folder) || access(folder.c_str(), W_OK) != 0) {
    throw input_error(path_.string(), "its folder does not exist or can't be written to", "make the folder first");
  }
}

void WholeFile::must_not_be(const std::filesystem::path& other) const {
  std::error_code error;
  const auto place = [&error](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  if (place(path_) == place(other)) throw input_error(path_.string(), "is to hold two outputs", "give two names");
}

void WholeFile::write(std::string_view text) const {
  std::string hidden = ".";
  hidden.append(path_.filename().string()).append(".").append(std::to_string(getpid()));
  const std::filesystem::path unfinished = path_.parent_path() / hidden;
  std::error_code error, ignored;
  {
    std::ofstream out(unfinished, std::ios::binary);
    out << text;
    out.flush();
    if (!out) {
      std::filesystem::remove(unfinished, ignored);
      throw runtime_failure(path_.string(), "it could not be written", "check that the disk is not full");
    }
  }
  std::filesystem::rename(unfinished, path_, error);
  if (error) {
    std::filesystem::remove(unfinished, ignored);
    throw runtime_failure(path_.string(), "it can't be put in place: " + error.message());
  }
}

}  // namespace rinkaku::app

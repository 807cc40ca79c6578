#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <sys/wait.h>

#include <nlohmann/json.hpp>

#include "tests/pipeline/shot_folder.h"

namespace rinkaku::test {

struct CliResult {
  int status = -1;  ///< exit status, or 128 + the signal that ended it
  std::string out, err;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs a shell line in `folder`, in which $RINKAKU is the program. What it prints goes through files elsewhere.
inline CliResult run_shell(const std::filesystem::path& folder, const std::string& line) {
  const std::filesystem::path prints = folder.string() + "_prints";
  std::filesystem::create_directories(prints);
  const std::string command = "cd '" + folder.string() + "' && RINKAKU='" RINKAKU_BINARY "' && { " + line + "; } >'" +
                              prints.string() + "/out' 2>'" + prints.string() + "/err' </dev/null";
  const int status = std::system(command.c_str());
  CliResult result{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(prints / "out"),
                   text_of(prints / "err")};
  std::filesystem::remove_all(prints);
  return result;
}

inline CliResult run_rinkaku(const ShotFolder& folder, const std::string& arguments) {
  return run_shell(folder.path(), "\"$RINKAKU\" " + arguments);
}

/// Every file below a folder with its contents: equal before and after if nothing was touched.
inline std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    files[entry.path().lexically_relative(folder).string()] =
        entry.is_regular_file() ? text_of(entry.path()) : std::string();
  }
  return files;
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// One object on one line and nothing else; null, failing the test, otherwise.
inline nlohmann::json json_of(const std::string& out) {
  EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 1) << out;
  const nlohmann::json value = nlohmann::json::parse(out, nullptr, false);
  EXPECT_TRUE(value.is_object()) << out;
  return value;
}

/// A board that print_board() and the detector take.
inline const std::string board_toml =
    "dictionary = \"4X4_50\"\ngrid = { columns = 2, rows = 2, size_m = 0.04, gap_m = 0.01 }\n";

}  // namespace rinkaku::test

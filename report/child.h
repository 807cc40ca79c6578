#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rinkaku::report {

/// What running another program took.
struct ChildRun {
  int status = -1;  ///< exit status; 128 + the signal that ended it; 127 if there is no such program
  double wall_ms = 0;
  double cpu_ms = 0;    ///< of all its threads
  double peak_mib = 0;  ///< the most memory it had resident, as seen every 5 ms; 0 if it ended before that
};

/// Runs a program to its end, with nothing to read. What it prints goes to `prints` (over what is there), or nowhere.
/// `command`: its name, looked for in PATH, and its arguments. Throws Error (Runtime) if no process can be started.
ChildRun run_child(const std::vector<std::string>& command, const std::filesystem::path& prints = {});

/// Whether a program of this name is in PATH.
bool in_path(const std::string& program);

}  // namespace rinkaku::report

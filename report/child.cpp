#include "report/child.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pipeline/frame/error.h"

namespace rinkaku::report {
namespace {

double milliseconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_usec) / 1e3;
}

// The most memory that a process has had resident since it became the program it is; 0 if it is gone.
double peak_mib_of(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("VmHWM:")) return std::strtod(line.c_str() + 6, nullptr) / 1024;
  }
  return 0;
}

// Waits for a process to end, and looks at it every few milliseconds: what wait4() tells of memory includes that of
// this process at the start, which both shared for a moment.
double peak_until_end(pid_t process) {
  // By number: the C library of Debian 12 declares pidfd_open() for C alone.
  const int handle = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  pollfd ends{handle, POLLIN, 0};
  double peak_mib = 0;
  constexpr int look_every_ms = 5;
  while (handle >= 0 && poll(&ends, 1, look_every_ms) <= 0) peak_mib = std::max(peak_mib, peak_mib_of(process));
  if (handle >= 0) close(handle);
  return peak_mib;
}

class FileActions {
 public:
  explicit FileActions(const std::string& prints) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, prints.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

ChildRun run_child(const std::vector<std::string>& command, const std::filesystem::path& prints) {
  std::vector<std::string> words = command;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const FileActions actions(prints.empty() ? "/dev/null" : prints.string());
  pid_t child = 0;
  const auto start = std::chrono::steady_clock::now();
  const int failed = posix_spawnp(&child, argv[0], actions.get(), nullptr, argv.data(), environ);
  ChildRun run;
  if (failed == ENOENT) return run.status = 127, run;
  if (failed != 0)
    throw runtime_failure(command[0], "can't be started (" + std::generic_category().message(failed) + ")");
  const double peak_mib = peak_until_end(child);
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.wall_ms = took.count();
  run.cpu_ms = milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
  run.peak_mib = peak_mib;
  return run;
}

bool in_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace rinkaku::report

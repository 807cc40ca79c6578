#include "mesh/worker_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pipeline/frame/error.h"

namespace rinkaku::mesh {
namespace {

using Clock = std::chrono::steady_clock;

class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  void reset(int fd) {
    close();
    fd_ = fd;
  }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

 private:
  int fd_;
};

/// A started process; killed and collected at the latest when this ends.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child() {
    if (pid_ > 0) kill();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// True once it has ended; then `status` holds.
  bool ended() {
    if (pid_ <= 0) return true;
    const pid_t got = ::waitpid(pid_, &status, WNOHANG);
    if (got == 0 || (got < 0 && errno == EINTR)) return false;
    // Where the program ignores SIGCHLD the system collects the child itself, and its status is not known.
    if (got < 0) status = 0;
    pid_ = -1;
    return true;
  }
  void kill() {
    ::kill(pid_, SIGKILL);
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
  }
  int status = 0;

 private:
  pid_t pid_;
};

/// The two ends of spawning: what the child's descriptors and signals are to be.
class SpawnPlan {
 public:
  SpawnPlan() {
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawnattr_init(&attributes);
  }
  ~SpawnPlan() {
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

pid_t spawn(const std::filesystem::path& program, const std::vector<std::string>& arguments, int answer_fd) {
  SpawnPlan plan;
  ::posix_spawn_file_actions_adddup2(&plan.actions, answer_fd, STDOUT_FILENO);
  ::posix_spawn_file_actions_addopen(&plan.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
#ifndef RINKAKU_SANITIZED  // a sanitizer's report should be seen
  ::posix_spawn_file_actions_addopen(&plan.actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
#endif
  ::posix_spawn_file_actions_addclosefrom_np(&plan.actions, STDERR_FILENO + 1);

  sigset_t none;
  sigemptyset(&none);
  sigset_t all;
  sigfillset(&all);
  ::posix_spawnattr_setsigmask(&plan.attributes, &none);
  ::posix_spawnattr_setsigdefault(&plan.attributes, &all);
  ::posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  pid_t pid = -1;
  const int failed = ::posix_spawn(&pid, program.c_str(), &plan.actions, &plan.attributes, argv.data(), environ);
  if (failed != 0) {
    throw runtime_failure(program.string(), std::string("could not be started: ") + std::strerror(failed),
                          "install rinkaku again, or set RINKAKU_IMPORT to the worker");
  }
  return pid;
}

int milliseconds_left(Clock::time_point deadline) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<long long>(left, 0, 60'000));
}

}  // namespace

WorkerResult run_worker(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                        const WorkerLimits& limits) {
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.time_s));
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw runtime_failure("", std::string("no pipe for reading a mesh: ") + std::strerror(errno), "close some files");
  }
  const Descriptor in(ends[0]);
  Descriptor out(ends[1]);
  // If a closed standard output left number 1 to the pipe itself, dup2 onto itself would be undone at exec.
  if (out.get() <= STDERR_FILENO) out.reset(::fcntl(out.get(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
  Child child(spawn(program, arguments, out.get()));
  out.close();

  WorkerResult result;
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  std::size_t size = 0;
  while (true) {
    pollfd waiting{in.get(), POLLIN, 0};
    const int ready = ::poll(&waiting, 1, milliseconds_left(deadline));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) {
      if (Clock::now() < deadline) continue;
      child.kill();
      result.end = WorkerResult::End::OutOfTime;
      return result;
    }
    if (size + kChunk > result.answer.size()) result.answer.resize(std::max(size + kChunk, size * 2));
    const ssize_t got = ::read(in.get(), result.answer.data() + size, result.answer.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    size += static_cast<std::size_t>(got);
    if (size > limits.answer_bytes) {
      child.kill();
      result.end = WorkerResult::End::TooMuch;
      return result;
    }
  }
  result.answer.resize(size);

  while (!child.ended()) {
    if (Clock::now() >= deadline) {
      child.kill();
      result.end = WorkerResult::End::OutOfTime;
      return result;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  result.end = WIFSIGNALED(child.status) ? WorkerResult::End::Killed : WorkerResult::End::Exited;
  result.code = WIFSIGNALED(child.status) ? WTERMSIG(child.status) : WEXITSTATUS(child.status);
  return result;
}

}  // namespace rinkaku::mesh

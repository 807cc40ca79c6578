#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rinkaku::mesh {

struct WorkerLimits {
  double time_s = 5;
  std::uint64_t answer_bytes = std::uint64_t{1} << 30;  ///< a worker that writes more is stopped
};

/// How a worker process ended, and what it wrote until then.
struct WorkerResult {
  enum class End { Exited, Killed, OutOfTime, TooMuch } end = End::Exited;
  int code = 0;  ///< exit status, or the number of the signal that killed it
  std::vector<std::uint8_t> answer;
};

/// Runs a program with the given arguments and collects its standard output. Its standard input and standard error are
/// empty; it inherits no other open file and no blocked or ignored signal, and is killed at the limits.
/// Any thread, several at once; leaks no descriptor into other processes. Throws Error (Runtime) if it can't be
/// started.
WorkerResult run_worker(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                        const WorkerLimits& limits);

}  // namespace rinkaku::mesh

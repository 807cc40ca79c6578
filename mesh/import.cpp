#include "mesh/import.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <system_error>

#include <signal.h>

#include "mesh/import_message.h"
#include "mesh/worker_process.h"
#include "pipeline/frame/error.h"

namespace rinkaku::mesh {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;
/// The time limit is of the processor, which the worker sets itself; on a busy machine it may take longer by the clock.
constexpr double kClockToCpu = 4.0;
constexpr const char* kFormats = "use a glTF, GLB, VRM, OBJ, PLY, OFF, STL or FBX file";
constexpr const char* kExportAgain = "open it in a 3D program and export it again, as GLB for instance";

fs::path find_worker() {
  if (const char* set = std::getenv("RINKAKU_IMPORT"); set != nullptr && *set != '\0') return set;
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path beside = program.parent_path();
  for (const fs::path& candidate : {beside / "rinkaku-import", beside.parent_path() / "libexec/rinkaku/rinkaku-import",
                                    fs::path(RINKAKU_IMPORT_BUILT)}) {
    if (fs::is_regular_file(candidate, ignored)) return candidate;
  }
  throw runtime_failure("rinkaku-import", "the mesh reader was not found beside " + program.string(),
                        "install rinkaku again, or set RINKAKU_IMPORT to it");
}

/// The size of a file that can be opened, or an Error that says why not.
std::uint64_t checked_size(const fs::path& file) {
  std::error_code failed;
  const fs::file_status status = fs::status(file, failed);
  if (status.type() == fs::file_type::not_found) throw input_error(file.string(), "no such file", "check the path");
  if (fs::is_directory(status)) throw input_error(file.string(), "is a folder, not a mesh file", kFormats);
  if (!fs::is_regular_file(status)) throw input_error(file.string(), "is not an ordinary file", kFormats);
  const std::uint64_t size = fs::file_size(file, failed);
  if (failed) throw input_error(file.string(), failed.message(), "check the path");
  if (size == 0) throw input_error(file.string(), "the file is empty", kExportAgain);
  std::FILE* opened = std::fopen(file.c_str(), "rbe");
  if (opened == nullptr) throw input_error(file.string(), "can't be opened for reading", "check its permissions");
  std::fclose(opened);
  return size;
}

std::string megabytes(std::uint64_t bytes) { return std::to_string((bytes + kMiB - 1) / kMiB) + " MiB"; }

std::string seconds(double s) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", s);
  return text;
}

std::string crash_reason(int signal) {
  switch (signal) {
    case SIGKILL:
      return "its reader was killed";
    case SIGXCPU:
      return "it takes too long to read";
    case SIGINT:
      return "reading it was interrupted";
    default:
      return "its reader crashed with signal " + std::to_string(signal) + ", the file may be broken";
  }
}

Error unreadable(const fs::path& file, const std::string& reason, const std::string& remedy) {
  return input_error(file.string(), "could not be read as a mesh (" + reason + ")", remedy);
}

}  // namespace

Imported import(const fs::path& file, const ImportOptions& options) {
  const std::uint64_t size = checked_size(file);
  const double time_s = options.time_limit_s > 0 ? options.time_limit_s : 5.0 + static_cast<double>(size) / 10e6;
  const std::uint64_t memory = options.memory_limit_bytes > 0 ? options.memory_limit_bytes : 1024 * kMiB + 64 * size;
  const double crease_deg = std::isfinite(options.crease_deg) ? options.crease_deg : 60.0;

  const std::vector<std::string> arguments{fs::absolute(file).string(),
                                           std::to_string(crease_deg),
                                           std::to_string(static_cast<int>(options.normals)),
                                           std::to_string(memory),
                                           std::to_string(static_cast<long long>(std::ceil(time_s))),
                                           options.rig ? "1" : "0"};
  const fs::path worker = find_worker();
  WorkerResult result = run_worker(worker, arguments, {time_s * kClockToCpu, memory});
  switch (result.end) {
    case WorkerResult::End::OutOfTime:
      throw unreadable(file, "its reader took longer than " + seconds(time_s * kClockToCpu), kExportAgain);
    case WorkerResult::End::TooMuch:
      throw unreadable(file, "it grows beyond " + megabytes(memory) + " when read", "reduce its triangles or textures");
    case WorkerResult::End::Killed:
      throw unreadable(file, crash_reason(result.code), kExportAgain);
    case WorkerResult::End::Exited:
      break;
  }
  std::optional<ImportMessage> message = decode(result.answer);
  if (message && message->imported) return std::move(*message->imported);
  if (message && message->failure) throw unreadable(file, message->failure->what, message->failure->remedy);
  if (result.code == 127 && result.answer.empty()) {
    throw runtime_failure(worker.string(), "the mesh reader could not be started", "install rinkaku again");
  }
  throw unreadable(file, "its reader gave up with status " + std::to_string(result.code), kExportAgain);
}

}  // namespace rinkaku::mesh

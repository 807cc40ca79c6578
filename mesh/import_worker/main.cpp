// rinkaku-import: reads one mesh file for the program that started it and answers on its standard output, in
// import_message.h's form. It limits itself first, so that no file, however broken, takes more than it may.
//
// Arguments: FILE CREASE_DEG NORMALS MEMORY_BYTES CPU_SECONDS RIG. Not for people to call.

#include <cerrno>
#include <cstdlib>
#include <new>
#include <span>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "mesh/assemble.h"
#include "mesh/import_message.h"
#include "mesh/import_worker/read_file.h"

namespace rinkaku::mesh {
namespace {

void limit(__rlimit_resource what, rlim_t to, rlim_t at_most) {
  const rlimit value{to, at_most};
  ::setrlimit(what, &value);
}

void limit_self(std::uint64_t memory_bytes, std::uint64_t cpu_seconds) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_CPU, cpu_seconds, cpu_seconds + 1);
#ifndef RINKAKU_SANITIZED  // a sanitizer maps terabytes for its own use
  limit(RLIMIT_AS, memory_bytes, memory_bytes);
#else
  static_cast<void>(memory_bytes);
#endif
}

/// Where the answer goes; whatever a library prints to standard output from now on goes nowhere.
int take_standard_output() {
  const int answer = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
  return answer;
}

bool write_all(int fd, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

Imported read(const char* file, double crease_deg, ImportOptions::Normals normals, bool rig) {
  ReadScene scene = read_file(file, normals, rig);
  if (scene.soup.triangles.empty()) {
    throw ImportFailure{"it has no faces", "export a mesh with triangles, not only points or lines"};
  }
  Assembled assembled = assemble(std::move(scene.soup), crease_deg);
  if (assembled.mesh.triangles.empty()) {
    throw ImportFailure{"none of its faces is whole: their corners are missing, not finite or at one place",
                        "export it again"};
  }
  scene.summary.dropped_non_finite += assembled.dropped.non_finite;
  scene.summary.dropped_bad_index += assembled.dropped.bad_index;
  scene.summary.dropped_collapsed += assembled.dropped.collapsed;
  scene.summary.unused_vertices += assembled.dropped.unused_vertices;
  return {std::move(assembled.mesh), std::move(scene.summary), std::move(assembled.rig)};
}

std::vector<std::uint8_t> answer(char** arguments) {
  try {
    return encode(read(arguments[1], std::strtod(arguments[2], nullptr),
                       static_cast<ImportOptions::Normals>(std::atoi(arguments[3])), std::atoi(arguments[6]) != 0));
  } catch (const ImportFailure& failure) {
    return encode(failure);
  } catch (const std::bad_alloc&) {
    return encode(ImportFailure{"it needs more memory than a file of its size should", "reduce it or export it again"});
  } catch (const std::exception& error) {
    return encode(ImportFailure{error.what(), "export it again"});
  }
}

}  // namespace
}  // namespace rinkaku::mesh

int main(int count, char** arguments) {
  using namespace rinkaku::mesh;
  if (count != 7) return 2;
  limit_self(std::strtoull(arguments[4], nullptr, 10), std::strtoull(arguments[5], nullptr, 10));
  const int out = take_standard_output();
  const bool written = write_all(out, answer(arguments));
  // No destructors: what the reader allocated goes with the process.
  ::_exit(written ? 0 : 1);
}

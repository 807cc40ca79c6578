#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mesh/import.h"
#include "mesh/worker_process.h"
#include "pipeline/frame/error.h"
#include "tests/support/test_data.h"

namespace rinkaku::mesh {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

std::string refusal(const fs::path& file, const ImportOptions& options = {}) {
  try {
    import(file, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::Input) << error.what();
    return error.what();
  }
  return "was not refused";
}

/// A shell in the worker's place, as long as this lives.
class InsteadOfTheWorker {
 public:
  InsteadOfTheWorker(const TemporaryFolder& folder, const std::string& script) {
    const fs::path file = folder / "worker.sh";
    write(file, "#!/bin/sh\n" + script + "\n");
    fs::permissions(file, fs::perms::owner_all);
    ::setenv("RINKAKU_IMPORT", file.c_str(), 1);
  }
  ~InsteadOfTheWorker() { ::unsetenv("RINKAKU_IMPORT"); }
};

std::ptrdiff_t open_descriptors() {
  return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

TEST(ImportErrors, SayWhatIsWrongWithTheFile) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder / "none.obj").find("no such file; check the path"), std::string::npos);
  EXPECT_NE(refusal(folder.path()).find("is a folder"), std::string::npos);
  EXPECT_NE(refusal("/dev/null").find("not an ordinary file"), std::string::npos);
  write(folder / "empty.obj", "");
  EXPECT_NE(refusal(folder / "empty.obj").find("the file is empty"), std::string::npos);
  write(folder / "mesh.docx", kTriangle);
  EXPECT_NE(refusal(folder / "mesh.docx").find("unknown ending .docx"), std::string::npos);
  write(folder / "mesh", kTriangle);
  EXPECT_NE(refusal(folder / "mesh").find("its name has no ending"), std::string::npos);
  write(folder / "words.glb", "these are words");
  EXPECT_NE(refusal(folder / "words.glb").find("not what its ending says"), std::string::npos);
  write(folder / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  EXPECT_NE(refusal(folder / "points.obj").find("no faces"), std::string::npos);
  write(folder / "flat.obj", "v 0 0 0\nv 1 0 0\nv 0 0 0\nf 1 2 3\n");
  EXPECT_NE(refusal(folder / "flat.obj").find("none of its faces is whole"), std::string::npos);
  write(folder / "nan.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "nan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_NE(refusal(folder / "nan.ply").find("none of its faces is whole"), std::string::npos);
}

TEST(ImportErrors, UnreadableFileIsNamed) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TemporaryFolder folder;
  write(folder / "secret.obj", kTriangle);
  fs::permissions(folder / "secret.obj", fs::perms::none);
  EXPECT_NE(refusal(folder / "secret.obj").find("can't be opened"), std::string::npos);
}

TEST(ImportLimits, CrashingWorkerIsAnErrorOfTheFile) {
  const TemporaryFolder folder;
  write(folder / "a.obj", kTriangle);
  const InsteadOfTheWorker crashing(folder, "kill -SEGV $$");
  EXPECT_NE(refusal(folder / "a.obj").find("crashed with signal 11"), std::string::npos);
}

TEST(ImportLimits, HangingWorkerIsKilledInTime) {
  const TemporaryFolder folder;
  write(folder / "a.obj", kTriangle);
  const InsteadOfTheWorker hanging(folder, "exec sleep 100");
  ImportOptions options;
  options.time_limit_s = 0.3;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NE(refusal(folder / "a.obj", options).find("took longer than 1.2 s"), std::string::npos);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(took.count(), 4.0);
}

TEST(ImportLimits, BusyWorkerIsStoppedByItsOwnLimit) {
  const TemporaryFolder folder;
  write(folder / "a.obj", kTriangle);
  const InsteadOfTheWorker busy(folder, "ulimit -t $5; while :; do :; done");
  ImportOptions options;
  options.time_limit_s = 1;
  EXPECT_NE(refusal(folder / "a.obj", options).find("could not be read as a mesh (its reader"), std::string::npos);
}

TEST(ImportLimits, TalkativeWorkerIsStopped) {
  const TemporaryFolder folder;
  write(folder / "a.obj", kTriangle);
  const InsteadOfTheWorker talking(folder, "exec cat /dev/zero");
  ImportOptions options;
  options.memory_limit_bytes = 10 << 20;
  EXPECT_NE(refusal(folder / "a.obj", options).find("grows beyond 10 MiB"), std::string::npos);
}

TEST(ImportLimits, RubbishFromTheWorkerIsRefused) {
  const TemporaryFolder folder;
  write(folder / "a.obj", kTriangle);
  const InsteadOfTheWorker babbling(folder, "echo RKM1 and so on");
  EXPECT_NE(refusal(folder / "a.obj").find("could not be read as a mesh"), std::string::npos);
}

TEST(ImportLimits, MissingWorkerIsNotTheFilesFault) {
  const TemporaryFolder folder;
  write(folder / "a.obj", kTriangle);
  ::setenv("RINKAKU_IMPORT", "/nowhere/rinkaku-import", 1);
  try {
    import(folder / "a.obj");
    ADD_FAILURE() << "should have thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::Runtime) << error.what();
  }
  ::unsetenv("RINKAKU_IMPORT");
}

TEST(ImportLimits, MemoryLimitHolds) {
#ifdef RINKAKU_SANITIZED
  GTEST_SKIP() << "a sanitizer needs address space without a limit";
#endif
  const TemporaryFolder folder;
  std::ostringstream many;
  constexpr int kPoints = 200000;
  for (int i = 0; i < kPoints; ++i) many << "v " << i << " 0 " << i % 7 << "\n";
  for (int i = 3; i <= kPoints; ++i) many << "f " << i - 2 << " " << i - 1 << " " << i << "\n";
  write(folder / "many.obj", many.str());
  ImportOptions options;
  options.memory_limit_bytes = 80 << 20;
  EXPECT_NE(refusal(folder / "many.obj", options).find("could not be read as a mesh"), std::string::npos);
  EXPECT_GT(import(folder / "many.obj").mesh.triangles.size(), 100000u) << "and without the limit it loads";
}

TEST(ImportLimits, NoDescriptorIsLeftOpenAndNoneInherited) {
  const TemporaryFolder folder;
  write(folder / "a.obj", kTriangle);
  import(folder / "a.obj");
  const auto before = open_descriptors();
  for (int i = 0; i < 5; ++i) import(folder / "a.obj");
  EXPECT_EQ(open_descriptors(), before);

  const int null = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int careless = ::fcntl(null, F_DUPFD, 50);  // not closed on exec
  ::close(null);
  const WorkerResult listed = run_worker("/bin/sh", {"-c", "for f in /proc/$$/fd/*; do echo ${f##*/}; done"}, {});
  ::close(careless);
  const std::string open(listed.answer.begin(), listed.answer.end());
  std::istringstream numbers(open);
  for (int fd = 0; numbers >> fd;) EXPECT_NE(fd, careless) << open;
}

TEST(ImportLimits, SeveralThreadsMayImportAtOnce) {
  const TemporaryFolder folder;
  write(folder / "a.obj", kTriangle);
  std::vector<std::thread> threads;
  std::atomic<int> good = 0;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 5; ++k) good += import(folder / "a.obj").mesh.triangles.size() == 1 ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, 40);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "no worker is left behind";
}

TEST(ImportLimits, IgnoredChildSignalsDoNotMatter) {
  const TemporaryFolder folder;
  write(folder / "a.obj", kTriangle);
  const auto before = ::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(import(folder / "a.obj").mesh.triangles.size(), 1u);
  ::signal(SIGCHLD, before);
}

}  // namespace
}  // namespace rinkaku::mesh

#include <fstream>

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/pipeline/sink/sink_tools.h"

namespace rinkaku {
namespace {

namespace fs = std::filesystem;

const PictureFormat format = test::picture("yuv420p", 64, 48);

std::string refusal(const sink::Options& options, const std::string& copy_from = {}) {
  sink::Incoming coming = test::incoming(format);
  coming.copy_streams_from = copy_from;
  return test::error_of(Error::Kind::Input, [&] { sink::open(options, coming); });
}

bool contains(const std::string& line, const char* part) { return line.find(part) != std::string::npos; }

TEST(OutputFile, AppearsOnlyWhenWhole) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "a.mp4";
  auto sink = sink::open({.path = path}, test::incoming(format));
  for (const Frame& frame : test::noise_frames(format, 5)) sink->write(frame);
  EXPECT_FALSE(fs::exists(path));
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    EXPECT_TRUE(entry.path().filename().string().starts_with(".a.mp4.")) << entry.path();
  }
  sink->finish();
  EXPECT_TRUE(fs::exists(path));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputFile, UnfinishedLeavesNothing) {
  const test::TemporaryFolder folder;
  {
    auto sink = sink::open({.path = folder / "a.mp4"}, test::incoming(format));
    for (const Frame& frame : test::noise_frames(format, 5)) sink->write(frame);
  }
  EXPECT_TRUE(test::is_empty(folder.path()));
}

TEST(OutputFile, WithoutFramesIsAnErrorAndLeavesNothing) {
  const test::TemporaryFolder folder;
  test::error_of(Error::Kind::Runtime,
                 [&] { test::write_all({.path = folder / "a.mp4"}, test::incoming(format), {}); });
  EXPECT_TRUE(test::is_empty(folder.path()));
}

TEST(OutputFile, ExistingIsWrittenOverOnlyIfAskedFor) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a.mp4", link = folder / "link.mp4";
  std::ofstream(path) << "precious";
  fs::create_symlink(path, link);
  EXPECT_TRUE(contains(refusal({.path = path}), "exists already; give --force"));
  EXPECT_EQ(fs::file_size(path), 8u);
  test::write_all({.path = link, .overwrite = true}, test::incoming(format), test::noise_frames(format, 2));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_GT(fs::file_size(path), 8u);
}

TEST(OutputFile, IsNeverTheInput) {
  const test::TemporaryFolder folder;
  const std::string input = folder / "in.mp4", link = folder / "link.mp4";
  test::write_all({.path = input}, test::incoming(format), test::noise_frames(format, 2));
  fs::create_hard_link(input, link);
  for (const std::string& output : {input, link, (folder / "./in.mp4").string()}) {
    EXPECT_TRUE(contains(refusal({.path = output, .overwrite = true}, input), "is the input itself")) << output;
  }
}

TEST(OutputFile, BadNamesAreOneLine) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_TRUE(contains(refusal({.path = folder / "no/a.mp4"}), "does not exist; create it"));
  EXPECT_TRUE(contains(refusal({.path = folder / "file/a.mp4"}), "file"));
  EXPECT_TRUE(contains(refusal({.path = folder.path().string()}), "ending"));
  EXPECT_TRUE(contains(refusal({.path = folder / "a.unknown"}), "its ending tells no"));
  EXPECT_TRUE(contains(refusal({.path = folder / "a.wav"}), "holds no video"));
  EXPECT_TRUE(contains(refusal({.path = folder / "a.mp4", .codec = "nonsense"}), "no encoder \"nonsense\""));
  EXPECT_TRUE(contains(refusal({.path = folder / "a.mp4", .codec = "ffv1"}), "does not take ffv1"));
  EXPECT_TRUE(contains(refusal({.path = folder / "a.mkv", .codec = "aac"}), "no encoder"));
  EXPECT_TRUE(contains(refusal({.path = folder / "a%03d.png", .codec = "ffv1"}), "asks for png"));
  EXPECT_TRUE(contains(refusal({.path = "-"}), "give y4m or raw"));
  EXPECT_FALSE(refusal({.path = ""}).empty());
  EXPECT_TRUE(contains(refusal({.path = "/proc/a.mp4"}), "can't be written"));
  fs::remove(folder / "file");
  EXPECT_TRUE(test::is_empty(folder.path()));
}

// In a process of its own that gives up being root, who may write everywhere.
TEST(OutputFile, UnwritableFolderIsRefused) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked",
                  fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    constexpr uid_t nobody = 65534;
    if (::geteuid() == 0 && ::setuid(nobody) != 0) ::_exit(10);
    ::_exit(contains(refusal({.path = folder / "locked/a.mp4"}), "can't be written; choose another") ? 0 : 11);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(OutputFile, FullDeviceIsAnErrorAtRunTime) {
  for (const char* container : {"matroska", "mp4"}) {
    const std::string line = test::error_of(Error::Kind::Runtime, [&] {
      test::write_all({.path = "/dev/full", .codec = "mpeg4", .container = container}, test::incoming(format),
                      test::noise_frames(format, 200));
    });
    EXPECT_TRUE(contains(line, "No space left on device")) << line;
  }
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

// In a process of its own, whose files may not grow past 100 kB.
TEST(OutputFile, FullDiskLeavesNothing) {
  const test::TemporaryFolder folder;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int status = 0;
    for (const char* file : {"a.mkv", "a.mp4", "a%03d.png"}) {
      const bool image = std::string(file).ends_with("png");
      const PictureFormat big = test::picture(image ? "rgba" : "yuv420p", 256, 256);
      try {
        test::write_all({.path = folder / file, .codec = image ? "" : "ffv1", .container = image ? "" : "matroska"},
                        test::incoming(big), test::noise_frames(big, 20));
        status = 10;
      } catch (const Error& error) {
        if (error.kind() != Error::Kind::Runtime || !contains(error.what(), "File too large")) status = 11;
      }
      if (!test::is_empty(folder.path())) status = 12;
    }
    ::_exit(status);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

// Standard output goes to a file as long as this lives.
class Redirected {
 public:
  explicit Redirected(const std::string& path) : before_(::dup(STDOUT_FILENO)) {
    std::fflush(stdout);
    const int file = ::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::close(file);
  }
  ~Redirected() {
    ::dup2(before_, STDOUT_FILENO);
    ::close(before_);
  }
  Redirected(const Redirected&) = delete;
  Redirected& operator=(const Redirected&) = delete;

 private:
  int before_;
};

class StandardOutput : public testing::TestWithParam<const char*> {};

TEST_P(StandardOutput, CarriesTheFramesAndNothingElse) {
  const std::string container = GetParam();
  const test::TemporaryFolder folder;
  for (const char* pixels : {"yuv420p", "yuv422p", "yuv444p", "yuv420p10le", "gray"}) {
    const PictureFormat odd = test::picture(pixels, 35, 29);
    const auto frames = test::noise_frames(odd, 4);
    const std::string captured = folder / "captured";
    std::string notice;
    {
      const Redirected redirected(captured);
      notice = test::write_all({.path = "-", .container = container}, test::incoming(odd), frames);
    }
    EXPECT_EQ(notice, "") << pixels;
    std::string expected;
    for (const Frame& frame : frames) expected += test::samples(frame);
    const std::string reader = container == "raw" ? "cat " : "ffmpeg -v error -f yuv4mpegpipe -i ";
    const std::string got = test::shell(reader + captured + (container == "raw" ? "" : " -f rawvideo -"));
    EXPECT_TRUE(got == expected) << pixels << ": " << got.size() << " bytes for " << expected.size();
  }
}
TEST(Y4m, TellsRateAspectRangeAndFields) {
  const test::TemporaryFolder folder;
  PictureFormat tagged = test::picture("yuv420p", 64, 48, {1, 1, 1, ColourTags::Range::Full, 1});
  tagged.sample_aspect = {16, 11};
  auto frames = test::noise_frames(tagged, 2);
  for (Frame& frame : frames) frame.interlaced = frame.top_field_first = true;
  const std::string path = folder / "a.y4m";
  test::write_all({.path = path}, test::incoming(tagged, {30000, 1001}), frames);
  auto source = source::open(path);
  EXPECT_EQ(source->description().frame_rate, (Rational{30000, 1001}));
  EXPECT_EQ(source->description().format.sample_aspect, (Rational{16, 11}));
  EXPECT_EQ(source->description().format.colour.range, ColourTags::Range::Full);
  const auto back = test::all_frames(*source);
  ASSERT_EQ(back.size(), 2u);
  EXPECT_TRUE(back[0].interlaced && back[0].top_field_first);
  EXPECT_TRUE(test::samples(back[1]) == test::samples(frames[1]));
}

INSTANTIATE_TEST_SUITE_P(Containers, StandardOutput, testing::Values("y4m", "raw"));

}  // namespace
}  // namespace rinkaku

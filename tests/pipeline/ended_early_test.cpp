// Interrupts, failures on each thread, damaged input: the run ends, at once and cleanly.
#include <csignal>
#include <set>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

namespace fs = std::filesystem;
using test::ShotFolder;

const PictureFormat small = test::picture("yuv420p", 64, 48, test::bt709_limited);

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    names.insert(entry.path().lexically_relative(folder).string());
  }
  return names;
}

// Runs a render that must fail, and checks that it leaves no file behind.
std::string failed(const ShotFolder& folder, Error::Kind kind, const std::string& scene, const RenderOptions& options,
                   const Progress& progress = {}) {
  folder.write("scene.toml", scene);
  const auto before = files_in(folder.path());
  const std::string line = test::error_of(kind, [&] { folder.render(scene, options, progress); });
  EXPECT_EQ(files_in(folder.path()), before);
  return line;
}

TEST(EndedEarly, InterruptLeavesAWholeShorterVideo) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 200);
  std::atomic<bool> stop{false};
  const RenderReport report = folder.render(test::drawn_scene, {.output = "out.mkv", .codec = "ffv1"}, stop,
                                            [&stop](std::int64_t done, std::int64_t total) {
                                              EXPECT_EQ(total, 200);
                                              if (done == 5) stop = true;
                                            });
  EXPECT_TRUE(report.interrupted);
  EXPECT_GE(report.frames, 5);
  EXPECT_LT(report.frames, 40);  // what was in the queues, 4 in each of 3, and at most that in hand
  const auto out = source::open(folder.file("out.mkv"));
  EXPECT_EQ(test::all_frames(*out).size(), static_cast<std::size_t>(report.frames));
  EXPECT_EQ(out->damage(), "");
}

TEST(EndedEarly, InterruptBeforeTheFirstFrameIsAnErrorAndLeavesNothing) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 5);
  const std::atomic<bool> stop{true};
  folder.write("scene.toml", test::drawn_scene);
  const auto before = files_in(folder.path());
  test::error_of(Error::Kind::Runtime,
                 [&] { folder.render(test::drawn_scene, {.output = "out.mkv", .codec = "ffv1"}, stop, {}); });
  EXPECT_EQ(files_in(folder.path()), before);
}

TEST(EndedEarly, MarkerNeverSeenIsAnErrorAndLeavesNothing) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 6);
  const std::string track = "[track]\nmarker = { dictionary = \"4X4_50\", id = 7, size_m = 0.1 }\n";
  const std::string line = failed(folder, Error::Kind::Input, test::plate + track + test::cube,
                                  {.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")});
  EXPECT_TRUE(contains(line, "in.mkv: marker 7 of 4X4_50 was not seen in any of 6 frames")) << line;
}

TEST(EndedEarly, PoseFileOfAnotherVideoIsAnErrorAndLeavesNothing) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 6);
  folder.write("poses.csv", "frame,tx,ty,tz,qx,qy,qz,qw\n100,0,0,0,0,0,0,1\n");
  const std::string line = failed(folder, Error::Kind::Input, test::plate + test::poses + test::cube,
                                  {.output = "out.mkv", .codec = "ffv1"});
  EXPECT_TRUE(contains(line, "poses.csv has no pose in any of 6 frames")) << line;
}

TEST(EndedEarly, FramesPastTheVideoAreAnErrorAndLeaveNothing) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 6);
  const std::string line = failed(folder, Error::Kind::Input, test::plate,
                                  {.output = "out.mkv", .codec = "ffv1", .first_frame = 6, .end_frame = 9});
  EXPECT_TRUE(contains(line, "in.mkv: it has 6 frames, none from 6 on")) << line;
}

// A device that is always full, behind a link so that the name tells the container.
TEST(EndedEarly, EncodeThreadsFailureEndsTheRun) {
  const ShotFolder folder(256, 256);
  folder.noise_clip("in.mkv", test::picture("yuv420p", 256, 256, test::bt709_limited), 60);
  fs::create_symlink("/dev/full", folder / "out.mkv");
  std::int64_t drawn = 0;
  const std::string line =
      failed(folder, Error::Kind::Runtime, test::drawn_scene, {.output = "out.mkv", .codec = "ffv1"},
             [&drawn](std::int64_t done, std::int64_t) { drawn = done; });
  EXPECT_TRUE(contains(line, "No space left on device")) << line;
  EXPECT_LT(drawn, 60);  // the threads before it stopped too
}

// One of the layer's files can't be put in place.
TEST(EndedEarly, DrawThreadsFailureEndsTheRun) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 60);
  fs::create_directories(folder / "layers/cg_000003.png");
  const std::string line =
      failed(folder, Error::Kind::Input, test::drawn_scene,
             {.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers"), .overwrite = true});
  EXPECT_TRUE(contains(line, "cg_000003.png")) << line;
}

TEST(EndedEarly, WhatTheCallersProgressThrowsComesBack) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 60);
  const std::string line = failed(folder, Error::Kind::Runtime, test::drawn_scene,
                                  {.output = "out.mkv", .codec = "ffv1"}, [](std::int64_t done, std::int64_t) {
                                    if (done == 3) throw runtime_failure("the window", "was closed");
                                  });
  EXPECT_EQ(line, "the window: was closed");
}

// In a process of its own, whose files may not grow past 40 kB.
TEST(EndedEarly, FullDiskLeavesNothing) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 60);
  const std::string scene = test::plate;
  folder.write("scene.toml", scene);
  const auto before = files_in(folder.path());
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{40000, 40000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int status = 10;
    try {
      folder.render(scene, {.output = "out.mkv", .codec = "ffv1"});
    } catch (const Error& error) {
      status = error.kind() == Error::Kind::Runtime && contains(error.what(), "File too large") ? 0 : 11;
    }
    ::_exit(status);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(files_in(folder.path()), before);
}

TEST(EndedEarly, TruncatedVideoIsRenderedAsFarAsItGoesAndSaid) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 30);
  const auto whole = folder.frames("in.mkv");
  fs::resize_file(folder / "in.mkv", fs::file_size(folder / "in.mkv") / 2);
  const RenderReport report = folder.render(test::plate, {.output = "out.mkv", .codec = "ffv1"});
  const auto out = folder.frames("out.mkv");
  EXPECT_EQ(report.frames, static_cast<std::int64_t>(out.size()));
  ASSERT_GE(out.size(), 12u);  // half of 30, less the packet that is cut and what the container needs
  ASSERT_LT(out.size(), 30u);
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_TRUE(test::samples(out[i]) == test::samples(whole[i])) << i;
  ASSERT_FALSE(report.notices.empty());
  EXPECT_TRUE(contains(report.notices.back(), "in.mkv")) << report.notices.back();
}

TEST(EndedEarly, CorruptBytesAreSaidAndTheRestIsRendered) {
  const ShotFolder folder;
  test::ffmpeg("-f lavfi -i testsrc2=s=64x48:r=25 -frames:v 100 -pix_fmt yuv420p -c:v mpeg4 -g 10 '" +
               folder.file("in.mkv") + "'");
  {
    std::fstream file(folder / "in.mkv", std::ios::in | std::ios::out | std::ios::binary);
    for (int i = 0; i < 20; ++i) {
      file.seekp(static_cast<std::streamoff>(fs::file_size(folder / "in.mkv") / 3) + 700 * i);
      file.write("\xff\x00\xff\x13\x37\xff\x00\x80", 8);
    }
  }
  const RenderReport report = folder.render(test::drawn_scene, {.output = "out.mkv", .codec = "ffv1"});
  EXPECT_GE(report.frames, 50);
  EXPECT_EQ(report.frames, static_cast<std::int64_t>(folder.frames("out.mkv").size()));
  EXPECT_FALSE(report.notices.empty());
}

}  // namespace
}  // namespace rinkaku::pipeline

// What becomes of files when runs are killed, and when two runs want the same ones.
#include <algorithm>
#include <chrono>

#include "tests/apps/cli_tools.h"

namespace rinkaku {
namespace {

constexpr int frames = 40;

class HardUse : public testing::Test {
 protected:
  void SetUp() override {
    folder_.noise_clip("in.mkv", test::picture("yuv420p", 64, 48, test::bt709_limited), frames);
    folder_.write("scene.toml", test::drawn_scene + "outline = true\n");
    folder_.write("regions.toml", test::drawn_scene + "outline = true\nregions = true\n");
  }
  std::size_t frames_of(const std::string& name) const { return folder_.frames(name).size(); }

  test::ShotFolder folder_;
};

// At every stage of a run, from its first instruction to its last.
TEST_F(HardUse, KilledAtAnyMomentTheOldOutputStaysAndTheNextRunWorks) {
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(test::run_rinkaku(folder_, "render scene.toml -o all.mkv --codec ffv1").status, 0);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(test::run_rinkaku(folder_, "render scene.toml -o out.mkv --codec ffv1 --frames :5").status, 0);
  const std::string old = test::text_of(folder_.path() / "out.mkv");
  int killed = 0;
  for (const double part : {0.02, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85}) {
    const std::string after_s = std::to_string(part * whole.count());
    const test::CliResult got = test::run_shell(
        folder_.path(), std::string("\"$RINKAKU\" render scene.toml -o out.mkv --codec ffv1 --force & job=$!; sleep ") +
                            after_s + "; kill -9 $job; wait $job");
    const std::string now = test::text_of(folder_.path() / "out.mkv");
    if (now == old) {
      ++killed;
    } else {
      ASSERT_EQ(frames_of("out.mkv"), frames) << "whole or not at all, " << after_s << " s: " << got.err;
    }
    // Nothing but the hidden part of an output is left over.
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      EXPECT_TRUE(name.starts_with(".out.mkv.") || !name.starts_with(".")) << name;
    }
  }
  EXPECT_GE(killed, 3) << "the first of them come long before its end";
  EXPECT_EQ(test::run_rinkaku(folder_, "render scene.toml -o out.mkv --codec ffv1 --force").status, 0);
  EXPECT_EQ(frames_of("out.mkv"), frames);
}

TEST_F(HardUse, TwoRunsWithOneOutputLeaveOneOfThemWhole) {
  const test::CliResult got =
      test::run_shell(folder_.path(),
                      "\"$RINKAKU\" render scene.toml -o out.mkv --codec ffv1 --force & one=$!; "
                      "\"$RINKAKU\" render scene.toml -o out.mkv --codec ffv1 --force & two=$!; "
                      "wait $one; a=$?; wait $two; b=$?; [ $a -eq 0 ] && [ $b -eq 0 ]");
  EXPECT_EQ(got.status, 0) << got.err;
  EXPECT_EQ(frames_of("out.mkv"), frames);
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
  }
}

// Both find the cache empty and bake; both draw the same as one that finds it full.
TEST_F(HardUse, TwoRunsThatBakeTheSameRegionsAgree) {
  const test::CliResult got = test::run_shell(folder_.path(),
                                              "export XDG_CACHE_HOME=$PWD/cache; "
                                              "\"$RINKAKU\" render regions.toml -o one.mkv --codec ffv1 & one=$!; "
                                              "\"$RINKAKU\" render regions.toml -o two.mkv --codec ffv1 & two=$!; "
                                              "wait $one; a=$?; wait $two; b=$?; [ $a -eq 0 ] && [ $b -eq 0 ] && "
                                              "\"$RINKAKU\" render regions.toml -o three.mkv --codec ffv1");
  ASSERT_EQ(got.status, 0) << got.err;
  const auto hash = [this](const std::string& name) {
    return test::shell("ffmpeg -nostdin -v error -i '" + folder_.file(name) + "' -f framemd5 -");
  };
  EXPECT_EQ(hash("one.mkv"), hash("two.mkv"));
  EXPECT_EQ(hash("one.mkv"), hash("three.mkv"));
  int kept = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path() / "cache")) {
    kept += entry.path().extension() == ".rgn" ? 1 : 0;
  }
  EXPECT_EQ(kept, 1);
}

}  // namespace
}  // namespace rinkaku

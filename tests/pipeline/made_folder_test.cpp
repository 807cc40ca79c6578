#include "pipeline/stages/made_folder.h"

#include <fstream>

#include "tests/pipeline/source/media_tools.h"
#include "tests/support/test_data.h"

namespace rinkaku::pipeline {
namespace {

namespace fs = std::filesystem;

TEST(MadeFolder, IsTakenAwayIfNothingCameIntoIt) {
  const test::TemporaryFolder folder;
  {
    const MadeFolder made(folder / "a/b/c");
    EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  }
  EXPECT_FALSE(fs::exists(folder / "a"));
  EXPECT_TRUE(fs::exists(folder.path()));
}

TEST(MadeFolder, StaysWithWhatCameIntoIt) {
  const test::TemporaryFolder folder;
  {
    const MadeFolder made(folder / "a/b/");
    std::ofstream(folder / "a/b/file") << "x";
  }
  EXPECT_TRUE(fs::exists(folder / "a/b/file"));
}

TEST(MadeFolder, LeavesAloneWhatWasThereBefore) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "a");
  { const MadeFolder made(folder / "a"); }
  EXPECT_TRUE(fs::is_directory(folder / "a"));
}

TEST(MadeFolder, RefusesTheNameOfAFile) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  for (const char* name : {"file", "file/below"}) {
    const std::string line = test::error_of(Error::Kind::Input, [&] { const MadeFolder made(folder / name); });
    EXPECT_EQ(line.rfind((folder / name).string() + ": this folder can't be made", 0), 0u) << line;
  }
}

}  // namespace
}  // namespace rinkaku::pipeline

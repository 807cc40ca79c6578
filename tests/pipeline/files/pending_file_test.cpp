#include "pipeline/files/pending_file.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "pipeline/files/read_file.h"
#include "pipeline/frame/error.h"
#include "tests/support/test_data.h"

namespace rinkaku::files {
namespace {

std::size_t files_in(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator entries(folder);
  return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

template <class Call>
std::string refusal(Error::Kind kind, const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "not refused";
}

TEST(PendingFile, AppearsUnderItsNameOnlyWhenWhole) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a";
  PendingFile file(path.string(), false);
  EXPECT_EQ(files_in(folder.path()), 0u) << "naming an output makes nothing";
  std::ofstream(file.open_path()) << "half";
  EXPECT_FALSE(std::filesystem::exists(path));
  file.commit();
  EXPECT_EQ(read_file(path, 100), "half");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(PendingFile, LeavesNothingBehindWhenItNeverBecomesWhole) {
  const test::TemporaryFolder folder;
  {
    const PendingFile file((folder / "a").string(), false);
    std::ofstream(file.open_path()) << "half";
    EXPECT_EQ(files_in(folder.path()), 1u);
  }
  EXPECT_EQ(files_in(folder.path()), 0u);
}

TEST(PendingFile, OldContentStaysUntilTheNewIsWhole) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "a").string();
  write_file(path, "old");
  EXPECT_NE(refusal(Error::Kind::Input, [&] { PendingFile(path, false); }).find("exists already"), std::string::npos);
  PendingFile file(path, true);
  std::ofstream(file.open_path()) << "new";
  EXPECT_EQ(read_file(path, 100), "old");
  file.commit();
  EXPECT_EQ(read_file(path, 100), "new");
}

TEST(PendingFile, FolderThatIsMissingOrTakesNoFilesIsNamed) {
  const test::TemporaryFolder folder;
  const std::string absent = (folder / "absent/a").string();
  EXPECT_NE(refusal(Error::Kind::Input, [&] { PendingFile(absent, false); }).find("does not exist"), std::string::npos);
  // Nobody can make files there, whatever its permissions say.
  const std::string text = refusal(Error::Kind::Input, [] { PendingFile("/proc/a", false).write("text"); });
  EXPECT_EQ(text.rfind("/proc/a: can't be written: ", 0), 0u) << text;
}

TEST(PendingFile, FullDeviceIsAFailureOfTheRun) {
  const std::string text = refusal(Error::Kind::Runtime, [] { PendingFile("/dev/full", true).write("text"); });
  EXPECT_NE(text.find("No space left"), std::string::npos) << text;
}

TEST(PendingFile, TwoNamesOfOneFileAreNoticed) {
  const test::TemporaryFolder folder;
  const PendingFile file((folder / "a").string(), false);
  const std::string other = (folder / "." / "a").string();
  EXPECT_NE(refusal(Error::Kind::Input, [&] { file.must_not_be(other); }).find("named twice"), std::string::npos);
  EXPECT_EQ(refusal(Error::Kind::Input, [&] { file.must_not_be((folder / "b").string()); }), "not refused");
}

TEST(PendingFile, BehindALinkTheFileIsReplacedAndNotTheLink) {
  const test::TemporaryFolder folder;
  write_file((folder / "real").string(), "old");
  std::filesystem::create_symlink("real", folder / "link");
  write_file((folder / "link").string(), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "real", 100), "new");
}

}  // namespace
}  // namespace rinkaku::files

#pragma once

#include <filesystem>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

namespace rinkaku::test {

/// A file of the real test data by other people, e.g. "meshes/closed/oded_spot_23k.obj".
inline std::filesystem::path data(const std::string& relative) {
  return std::filesystem::path(RINKAKU_TEST_DATA) / relative;
}

/// An empty folder of this test's own, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("rinkaku_") + info->test_suite_name() + "_" + info->name();
    for (char& c : name) {
      if (c == '/') c = '_';
    }
    path_ = std::filesystem::temp_directory_path() / (name + "_" + std::to_string(::getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace rinkaku::test

/// Skips the test, saying so, where the real test data are absent.
#define RINKAKU_NEEDS_DATA()                       \
  if (!std::filesystem::exists(RINKAKU_TEST_DATA)) \
  GTEST_SKIP() << "real test data are absent: " << RINKAKU_TEST_DATA << " (set RINKAKU_TEST_DATA)"

// A short, repeatable run of what the fuzzer does for hours: damaged files, with the sums switched off.
#include <random>

#include <gtest/gtest.h>

#include "silhouette/bake.h"
#include "tests/silhouette/surfaces.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace rinkaku::silhouette {
namespace {

std::vector<std::uint8_t> sound_file(const Surface& surface, bool depth) {
  BakeOptions options;
  options.space = RegionLayout{1, 2, 1.5};
  options.reduce.depth_distance = depth ? 0.01 : 0;
  return bake(surface, options)->file;
}

TEST(MutatedFiles, NeitherCrashNorGiveIndicesOutOfRange) {
  const std::vector<std::vector<std::uint8_t>> files{
      sound_file(test::surface_of(test::sphere(2)), true),
      sound_file(test::surface_of(test::cut_open(test::sphere(2), {0, 0, 1}, 0.2f)), false)};
  std::mt19937 random(7);
  const auto below = [&](std::size_t limit) {
    return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
  };
  for (int i = 0; i < 30000; ++i) {
    std::vector<std::uint8_t> bytes = files[below(files.size())];
    const std::size_t changes = 1 + below(4);
    for (std::size_t c = 0; c < changes; ++c) {
      // Mostly where the head and the table are, behind the lists.
      const std::size_t at = below(3) == 0 ? below(bytes.size()) : bytes.size() - 1 - below(bytes.size() / 4);
      const std::size_t width = std::size_t{1} << below(4);
      const std::uint8_t values[] = {0, 1, 0x7f, 0x80, 0xff, static_cast<std::uint8_t>(below(256))};
      const std::uint8_t value = values[below(6)];
      for (std::size_t k = at; k < std::min(at + width, bytes.size()); ++k) bytes[k] = value;
    }
    if (below(20) == 0) bytes.resize(below(bytes.size()));
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());  // aborts if it is wrong
  }
}

TEST(MutatedFiles, SoundFilesPass) {
  const auto bytes = sound_file(test::surface_of(test::sphere(2)), true);
  EXPECT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
}

}  // namespace
}  // namespace rinkaku::silhouette

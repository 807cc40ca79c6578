// Five million triangles: read by the limited reader, and drawn.
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "mesh/import.h"
#include "tests/outline/lined.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::test {
namespace {

static_assert(std::endian::native == std::endian::little, "written as it lies in memory");

constexpr std::uint32_t kSide = 1582;

// A sheet of 2 m, hardly wavy, as a binary PLY file of 95 MB.
void write_sheet(const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  const std::uint32_t cells = kSide - 1;
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << kSide * kSide
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << 2 * cells * cells
      << "\nproperty list uchar uint vertex_indices\nend_header\n";
  const auto put = [&out](const auto& value) { out.write(reinterpret_cast<const char*>(&value), sizeof value); };
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const float u = 2.0f * static_cast<float>(x) / cells - 1, v = 2.0f * static_cast<float>(y) / cells - 1;
      put(u), put(v), put(0.001f * std::sin(9 * u) * std::cos(7 * v));
    }
  }
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t a = y * kSide + x, b = a + 1, c = a + kSide, d = c + 1;
      for (const auto& corners : {std::array{a, c, b}, std::array{b, c, d}}) put(std::uint8_t{3}), put(corners);
    }
  }
}

class LargeMesh : public GlTest {};

TEST_F(LargeMesh, OfFiveMillionTrianglesIsReadAndDrawn) {
#ifdef RINKAKU_SANITIZED
  GTEST_SKIP() << "takes minutes and gigabytes with sanitizers";
#endif
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("rinkaku_large_" + std::to_string(getpid()) + ".ply");
  write_sheet(file);
  const mesh::Imported sheet = mesh::import(file);
  std::filesystem::remove(file);
  ASSERT_EQ(sheet.mesh.triangles.size(), 2u * (kSide - 1) * (kSide - 1));
  EXPECT_EQ(sheet.summary.dropped_collapsed, 0u);
  // 2 m seen from 4 m; its waves change the outline by a thousandth.
  const passes::Layer layer = drawn(scene_of(toon(sheet.mesh, moved(0, 0, 4))), view(320, 240, 300));
  EXPECT_NEAR(area_px(layer) / (150 * 150), 1, 0.005);
}

}  // namespace
}  // namespace rinkaku::test

#include "pipeline/portrait.h"

#include <array>

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using pipeline::portrait;
using pipeline::PortraitOptions;

class Portrait : public GlTest {};

const std::uint8_t* pixel(const Frame& frame, int x, int y) {
  return frame.planes[0].data + y * frame.planes[0].stride_bytes + x * 4;
}

// Columns and rows from the first to the last pixel that isn't the ground.
struct Extent {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};
Extent extent_of(const Frame& frame) {
  Extent e;
  const std::array<std::uint8_t, 3> ground = {pixel(frame, 0, 0)[0], pixel(frame, 0, 0)[1], pixel(frame, 0, 0)[2]};
  for (int y = 0; y < frame.format.height_px; ++y) {
    for (int x = 0; x < frame.format.width_px; ++x) {
      if (std::equal(ground.begin(), ground.end(), pixel(frame, x, y))) continue;
      e.left = std::min(e.left, x), e.right = std::max(e.right, x);
      e.top = std::min(e.top, y), e.bottom = std::max(e.bottom, y);
    }
  }
  return e;
}

TEST_F(Portrait, FillsThePictureUpToItsMarginsInTheMiddle) {
  for (const auto& [width, height] : {std::pair(300, 200), std::pair(200, 300)}) {
    PortraitOptions options;
    options.width_px = width, options.height_px = height, options.margin = 0.1;
    const Extent e = extent_of(portrait(cube(), options));
    // The line lies outside the mesh, two pixels, and its smooth edge; one pixel is rounding.
    const double across = e.right + 1 - e.left, down = e.bottom + 1 - e.top;
    EXPECT_NEAR(std::max(across / width, down / height), 0.8, 6.0 / 200);
    EXPECT_LE(across, 0.8 * width + 6);
    EXPECT_LE(down, 0.8 * height + 6);
    EXPECT_NEAR(e.left + e.right, width - 1, 3);
    EXPECT_NEAR(e.top + e.bottom, height - 1, 3);
  }
}

TEST_F(Portrait, SizeAndPlaceOfTheMeshMakeNoDifference) {
  PortraitOptions options;
  options.width_px = options.height_px = 120;
  const Extent wish = extent_of(portrait(cube(), options));
  for (float size : {1e-6f, 1e6f}) {
    mesh::Mesh mesh = cube();
    for (glm::vec3& p : mesh.positions) p = (p + glm::vec3(3, -2, 1)) * size;
    const Extent e = extent_of(portrait(mesh, options));
    EXPECT_NEAR(e.left, wish.left, 1) << size;
    EXPECT_NEAR(e.bottom, wish.bottom, 1) << size;
  }
}

TEST_F(Portrait, IsOpaqueAndShowsTheUpAxisUp) {
  PortraitOptions options;
  options.width_px = options.height_px = 100;
  for (char up : {'x', 'y', 'z'}) {
    options.up = up;
    // A cube whose upper side is red.
    mesh::Mesh mesh = cube();
    const int axis = up - 'x';
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      mesh.colours.push_back(mesh.normals[v][axis] > 0.5f ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 0, 1, 1));
    }
    const Frame frame = portrait(mesh, options);
    for (int y = 0; y < 100; ++y) {
      for (int x = 0; x < 100; ++x) ASSERT_EQ(pixel(frame, x, y)[3], 255);
    }
    const std::uint8_t *above = pixel(frame, 50, 18), *below = pixel(frame, 50, 70);
    EXPECT_GT(above[0], above[2]) << up;
    EXPECT_GT(below[2], below[0]) << up;
  }
}

TEST_F(Portrait, MeshWithoutSizeIsRefused) {
  mesh::Mesh point;
  point.positions = {{1, 2, 3}};
  EXPECT_THROW(portrait(point), Error);
}

}  // namespace
}  // namespace rinkaku::test

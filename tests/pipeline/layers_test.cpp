// What --layers writes beside the plate: lines, depth, the line around a filmed thing; and colours at a lower
// resolution.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

using test::ShotFolder;

constexpr int width = 320, height = 240;
const PictureFormat format = test::picture("yuv420p", width, height, test::bt709_limited);
constexpr double focal_px = width;

const std::string plain_cube = "[[object]]\nmesh = \"cube.obj\"\nheight_m = 0.5\ntoon = false\ncolour = \"#2060e0\"\n";
const std::string red_line = "outline = { width_px = 6, colour = \"#ff0000\" }\n";
// The cube's front is 1.25 m away, its middle in the middle of the picture.
const std::string before = "[track]\nlocked = { position_m = [0, -1.5, 0.25], look_at_m = [0, 0, 0.25] }\n";

int depth_mm(const Frame& frame, int x, int y) {
  const std::uint8_t* at = frame.planes[0].data + y * frame.planes[0].stride_bytes + 2 * x;
  const int big = at[0] << 8 | at[1], little = at[1] << 8 | at[0];
  return frame.format.pixels.big_endian ? big : little;
}

// The first frame of each layer that rendering the scene wrote.
class Written {
 public:
  explicit Written(const std::string& scene, const std::string& distortion = "0, 0, 0, 0, 0") {
    const ShotFolder folder(width, height);
    folder.write("camera.yml", ShotFolder::camera_text(width, height, distortion));
    folder.noise_clip("in.mkv", format, 1);
    folder.render(test::plate + scene, {.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")});
    for (const char* name : {"plate", "cg", "line", "depth"}) {
      if (!std::filesystem::exists(folder / ("layers/" + std::string(name) + "_000000.png"))) continue;
      layers_.emplace(name, folder.frames("layers/" + std::string(name) + "_%06d.png").at(0));
    }
  }
  bool has(const std::string& layer) const { return layers_.contains(layer); }
  const Frame& operator()(const std::string& layer) const { return layers_.at(layer); }

 private:
  std::map<std::string, Frame> layers_;
};

TEST(Layers, DepthIsInMillimetresAlongTheCamerasAxis) {
  const Written written(before + plain_cube);
  const Frame& depth = written("depth");
  EXPECT_EQ(depth.format.pixels.component[0].depth_bits, 16);
  const double half_px = 0.25 * focal_px / 1.25;
  int inside = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double out = std::max(std::abs(x - (width - 1) / 2.0), std::abs(y - (height - 1) / 2.0)) - half_px;
      if (out < -1) {
        ASSERT_EQ(depth_mm(depth, x, y), 1250) << x << ", " << y;  // also at the borders: not along the ray
        ++inside;
      } else if (out > 1) {
        ASSERT_EQ(depth_mm(depth, x, y), 0) << x << ", " << y;
      }
    }
  }
  EXPECT_GT(inside, 15000);
}

// Where the ray through a pixel meets the box, along the axis; the camera as `locked` puts it.
std::optional<double> depth_of_box(const glm::dvec3& eye, const glm::dvec3& target, double x, double y) {
  const glm::dvec3 forward = glm::normalize(target - eye), right = glm::normalize(glm::cross(forward, {0, 0, 1}));
  const glm::dvec3 down = glm::cross(forward, right);
  const glm::dvec3 ray =
      forward + right * ((x - (width - 1) / 2.0) / focal_px) + down * ((y - (height - 1) / 2.0) / focal_px);
  const glm::dvec3 low(-0.25, -0.25, 0), high(0.25, 0.25, 0.5);
  double from = 0, to = 1e9;
  for (int k = 0; k < 3; ++k) {
    const double a = (low[k] - eye[k]) / ray[k], b = (high[k] - eye[k]) / ray[k];
    from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
  }
  if (from >= to) return std::nullopt;
  return from;  // forward is 1 long
}

TEST(Layers, DepthIsThatOfSlantedFacesToo) {
  const glm::dvec3 eye(0.9, -1.1, 0.8), target(0, 0, 0.25);
  const Written written("[track]\nlocked = { position_m = [0.9, -1.1, 0.8], look_at_m = [0, 0, 0.25] }\n" + plain_cube);
  const Frame& depth = written("depth");
  int inside = 0;
  double sum = 0;
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      const auto here = depth_of_box(eye, target, x, y);
      double steepest = 0;
      bool whole = here.has_value();
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const auto beside = depth_of_box(eye, target, x + dx, y + dy);
        whole = whole && beside.has_value();
        if (whole) steepest = std::max(steepest, std::abs(*beside - *here));
      }
      if (!whole) continue;
      ++inside;
      const double error = std::abs(depth_mm(depth, x, y) - 1000 * *here);
      sum += error;
      // Surfaces are drawn half a pixel smaller at the contour: half a pixel's way along the slope; and rounding.
      ASSERT_LE(error, 0.5 + 0.75 * 1000 * steepest) << x << ", " << y;
    }
  }
  EXPECT_GT(inside, 8000);
  EXPECT_LT(sum / inside, 3);  // a pixel's way is 3 to 6 mm on these faces
}

TEST(Layers, DepthIsNeverMixedByTheLens) {
  const Written straight(before + plain_cube), bent(before + plain_cube, "-0.3, 0.05, 0.002, 0.001, 0");
  const Frame &depth = bent("depth"), &cg = bent("cg");
  int inside = 0;
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      const int mm = depth_mm(depth, x, y);
      ASSERT_TRUE(mm == 0 || mm == 1250) << mm;
      inside += mm == 1250;
      // It lies where the colours lie.
      const auto alpha = [&](int dx, int dy) { return test::sample(cg, 3, x + dx, y + dy); };
      if (std::min({alpha(-1, 0), alpha(1, 0), alpha(0, -1), alpha(0, 1)}) == 255) {
        ASSERT_EQ(mm, 1250) << x << ", " << y;
      }
      if (std::max({alpha(0, 0), alpha(-1, 0), alpha(1, 0), alpha(0, -1), alpha(0, 1)}) == 0) {
        ASSERT_EQ(mm, 0) << x << ", " << y;
      }
    }
  }
  int flat = 0;
  const Frame& unbent = straight("depth");
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) flat += depth_mm(unbent, x, y) == 1250;
  }
  EXPECT_LT(inside, flat - 100) << "barrel distortion makes it smaller";
  EXPECT_GT(inside, flat * 0.85);
}

TEST(Layers, LinesAreAlone) {
  const Written written(before + plain_cube + red_line);
  const Frame &line = written("line"), &cg = written("cg");
  const double half_px = 0.25 * focal_px / 1.25;
  int opaque = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double out = std::max(std::abs(x - (width - 1) / 2.0), std::abs(y - (height - 1) / 2.0)) - half_px;
      const int alpha = test::sample(line, 3, x, y);
      if (out < -2) {
        ASSERT_EQ(alpha, 0) << "on the body: " << x << ", " << y;
      }
      if (out > 2) {
        for (int c = 0; c < 4; ++c) ASSERT_EQ(test::sample(line, c, x, y), test::sample(cg, c, x, y)) << x << ", " << y;
      }
      if (alpha < 255) continue;
      ++opaque;
      ASSERT_EQ(test::sample(line, 0, x, y), 255);
      ASSERT_EQ(test::sample(line, 2, x, y), 0) << "the body's blue";
    }
  }
  // A square's contour of 512 pixels, 6 wide; less soft edges, and corners are rounded.
  EXPECT_GT(opaque, 1500);
  EXPECT_LT(opaque, 3600);
}

TEST(Layers, WhatIsNearerHidesLines) {
  const std::string nearer = plain_cube + "position_m = [0.3, -0.8, 0]\n";
  const Written alone(before + plain_cube + red_line), hidden(before + plain_cube + red_line + nearer);
  const Frame &line = alone("line"), &covered = hidden("line"), &depth = hidden("depth");
  int gone = 0, left = 0;
  for (int y = 2; y + 2 < height; ++y) {
    for (int x = 2; x + 2 < width; ++x) {
      if (test::sample(line, 3, x, y) < 255) continue;
      // The nearer cube's front is 0.45 m away.
      if (depth_mm(depth, x - 2, y) == 450 && depth_mm(depth, x + 2, y) == 450) {
        ASSERT_EQ(test::sample(covered, 3, x, y), 0) << x << ", " << y;
        ++gone;
      } else if (depth_mm(depth, x - 2, y) != 450 && depth_mm(depth, x + 2, y) != 450) {
        left += test::sample(covered, 3, x, y) == 255;
      }
    }
  }
  EXPECT_GT(gone, 300);
  EXPECT_GT(left, 300);
}

TEST(Layers, EachSliceHasItsLinesAndDepthAndAThingItsLine) {
  ShotFolder folder(width, height);
  folder.noise_clip("in.mkv", format, 1);
  const PictureFormat grey = test::picture("gray", width, height, test::bt709_full);
  std::vector<Frame> mattes = test::noise_frames(grey, 1);
  for (int y = 0; y < height; ++y) {
    std::uint8_t* row = mattes[0].planes[0].data + y * mattes[0].planes[0].stride_bytes;
    for (int x = 0; x < width; ++x) row[x] = x >= 100 && x < 140 && y >= 60 && y < 200 ? 255 : 0;
  }
  test::write_all({.path = folder.file("mattes.mkv"), .codec = "ffv1"}, test::incoming(grey), mattes);
  // It stands in the middle of the cube, which reaches through.
  folder.render(test::plate + before +
                    "[[foreground]]\nname = \"bar\"\nmethod = \"file\"\nfile = { video = \"mattes.mkv\" }\n"
                    "distance_m = 1.5\noutline = { width_px = 4, colour = \"#00ff00\" }\n" +
                    plain_cube + red_line,
                {.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")});
  const auto layer = [&folder](const std::string& name) { return folder.frames("layers/" + name + "_%06d.png").at(0); };
  EXPECT_EQ(depth_mm(layer("depth-0"), 160, 120), 1250);
  // Behind the cut its inner sides turn their backs; only what faces the eye is drawn.
  EXPECT_EQ(depth_mm(layer("depth-1"), 160, 120), 0);
  EXPECT_GT(test::sample(layer("line-0"), 3, 160, 120 + 64 + 3), 250);
  EXPECT_EQ(test::sample(layer("line-0"), 3, 160, 120), 0);
  const Frame around = layer("line_bar");
  EXPECT_EQ(test::sample(around, 3, 120, 120), 0) << "inside the thing";
  EXPECT_EQ(test::sample(around, 3, 98, 120), 255) << "beside it";
  EXPECT_EQ(test::sample(around, 1, 98, 120), 255);
  EXPECT_EQ(test::sample(around, 3, 80, 120), 0);
}

TEST(Layers, WhatTheSceneHasNotIsNotWritten) {
  const Written without_line(before + plain_cube);
  EXPECT_TRUE(without_line.has("cg"));
  EXPECT_TRUE(without_line.has("depth"));
  EXPECT_FALSE(without_line.has("line"));
  const Written empty("");
  EXPECT_TRUE(empty.has("plate"));
  EXPECT_FALSE(empty.has("depth"));
}

// Through the lens, with a line, shaded in bands: edges are those of the full resolution.
TEST(Layers, ShadingScaleLeavesLinesDepthAndCoverage) {
  const std::string scene =
      "[track]\nlocked = { position_m = [0.9, -1.1, 0.8], look_at_m = [0, 0, 0.25] }\n"
      "[[object]]\nmesh = \"cube.obj\"\nheight_m = 0.5\ncolour = \"#e0c020\"\n" +
      red_line;
  const Written full(scene, "-0.3, 0.05, 0, 0, 0"), third(scene + "shading_scale = 3\n", "-0.3, 0.05, 0, 0, 0");
  for (const char* name : {"line", "depth"}) {
    EXPECT_EQ(test::samples(full(name)), test::samples(third(name))) << name;
  }
  const Frame a = full("cg"), b = third("cg");
  int opaque = 0, other = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      ASSERT_EQ(test::sample(a, 3, x, y), test::sample(b, 3, x, y)) << x << ", " << y;
      if (test::sample(a, 3, x, y) < 255) continue;
      ++opaque;
      for (int c = 0; c < 3; ++c) other += std::abs(test::sample(a, c, x, y) - test::sample(b, c, x, y)) > 2;
    }
  }
  EXPECT_GT(opaque, 10000);
  // Where two faces meet in the cube, colours mix over three pixels: some 200 pixels of edges that are seen.
  EXPECT_LT(other, 3 * 3 * 200);
}

// Lines that are found in a picture of the object see its colours at the full resolution.
TEST(Layers, ShadingScaleLeavesLinesFoundInPictures) {
  const std::string scene =
      "[track]\nlocked = { position_m = [0.9, -1.1, 0.8], look_at_m = [0, 0, 0.25] }\n"
      "[[object]]\nmesh = \"cube.obj\"\nheight_m = 0.5\ncolour = \"#e0c020\"\n"
      "outline = { method = \"laplacian\", width_px = 4, colour = \"#ff0000\" }\n";
  const Written full(scene), third(scene + "shading_scale = 3\n");
  EXPECT_EQ(test::samples(full("line")), test::samples(third("line")));
}

// Strokes remember the frame before: the picture of the lines is of the same strokes, not of the next.
TEST(Layers, StrokesAreTheSameWithLayersAndWithout) {
  const ShotFolder folder(width, height);
  folder.write("camera.yml", ShotFolder::camera_text(width, height, "0, 0, 0, 0, 0"));
  folder.noise_clip("in.mkv", format, 4);
  const std::string scene =
      test::plate + before + plain_cube +
      "outline = { method = \"wobble\", width_px = 4, colour = \"#ff0000\", redraw_frames = 2 }\n";
  folder.render(scene, {.output = "with.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")});
  folder.render(scene, {.output = "without.mkv", .codec = "ffv1"});
  const auto with = folder.frames("with.mkv"), without = folder.frames("without.mkv");
  ASSERT_EQ(with.size(), 4u);
  ASSERT_EQ(without.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(test::samples(with[i]), test::samples(without[i])) << "frame " << i;
}

}  // namespace
}  // namespace rinkaku::pipeline

// Animated objects over a recording, from the scene file to the picture.
#include <cstring>

#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

const PictureFormat small = test::picture("yuv420p", 64, 48, test::bt709_limited);

/// Writes slide.gltf: a cube of 0.4 m about its origin that slides from x = -0.5 to 0.5 m in its only clip's second.
void write_slide(const test::ShotFolder& folder) {
  std::string bytes;
  const auto put = [&bytes](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis) put((i >> axis & 1) != 0 ? 0.2f : -0.2f);
  }
  for (const int i :
       {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5}) {
    put(static_cast<std::uint16_t>(i));
  }
  for (const float f : {0.0f, 1.0f, -0.5f, 0.0f, 0.0f, 0.5f, 0.0f, 0.0f}) put(f);
  folder.write("slide.bin", bytes);
  folder.write("slide.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0,"name":"slider"}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
    "buffers":[{"uri":"slide.bin","byteLength":200}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":72},
      {"buffer":0,"byteOffset":168,"byteLength":8},{"buffer":0,"byteOffset":176,"byteLength":24}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[-0.2,-0.2,-0.2],"max":[0.2,0.2,0.2]},
      {"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"},
      {"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
      {"bufferView":3,"componentType":5126,"count":2,"type":"VEC3"}],
    "animations":[{"name":"slide","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
      "samplers":[{"input":2,"output":3,"interpolation":"LINEAR"}]}]})");
}

// Seen from 2 m before it, straight on: 64 px are as wide as the distance.
std::string slide_scene(const std::string& animation) {
  return test::plate + "[track]\nlocked = { position_m = [0, -2, 0], look_at_m = [0, 0, 0] }\n" +
         "[[object]]\nmesh = \"slide.gltf\"\nscale = 1\ntoon = false\n" + animation + "[output]\ncontent = \"cg\"\n";
}

double centre_px(const Frame& layer) {
  double sum = 0, weight = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const int alpha = test::sample(layer, 3, x, y);
      sum += alpha * x;
      weight += alpha;
    }
  }
  return sum / weight;
}

// Where a box's picture has its centroid: its front face is at 1.8 m, and of the side that is seen a strip.
double expected_px(double x_m) {
  const auto column = [](double x, double depth) { return 31.5 + 64 * x / depth; };
  const double left = std::min(column(x_m - 0.2, 1.8), column(x_m - 0.2, 2.2));
  const double right = std::max(column(x_m + 0.2, 1.8), column(x_m + 0.2, 2.2));
  return (left + right) / 2;
}

std::vector<Frame> layers_of(const test::ShotFolder& folder, const std::string& animation, RenderOptions options = {}) {
  options.output = "out%04d.png";
  options.overwrite = true;
  folder.render(slide_scene(animation), options);
  return folder.frames("out%04d.png");
}

TEST(AnimatedShot, PlaysInTimeWithTheVideo) {
  const test::ShotFolder folder;
  write_slide(folder);
  folder.noise_clip("in.mkv", small, 12);  // of 25 frames a second
  const std::vector<Frame> layers = layers_of(folder, "animation = true\n");
  ASSERT_EQ(layers.size(), 12u);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    // The side's strip is a trapezium, nearly a rectangle: its centroid is off by less than half a pixel.
    EXPECT_NEAR(centre_px(layers[i]), expected_px(-0.5 + static_cast<double>(i) / 25), 0.5) << i;
  }
}

TEST(AnimatedShot, StartSpeedAndEndAreTheScenes) {
  const test::ShotFolder folder;
  write_slide(folder);
  folder.noise_clip("in.mkv", small, 12);
  const std::vector<Frame> layers =
      layers_of(folder, "animation = { clip = \"slide\", loop = false, start_s = 0.08, speed = 4 }\n");
  // Still for two frames, then 4 m/s for six and a half, then at its end.
  EXPECT_NEAR(centre_px(layers.at(1)), expected_px(-0.5), 0.5);
  EXPECT_NEAR(centre_px(layers.at(5)), expected_px(-0.5 + 0.48), 0.5);
  EXPECT_NEAR(centre_px(layers.at(11)), expected_px(0.5), 0.5);
}

TEST(AnimatedShot, SameFrameIsTheSamePictureFromWhereverARunBegins) {
  const test::ShotFolder folder;
  write_slide(folder);
  folder.noise_clip("in.mkv", small, 12);
  const std::string animation = "outline = { method = \"curvature\" }\nanimation = { speed = 7.3 }\n";
  const std::vector<Frame> whole = layers_of(folder, animation);
  RenderOptions one;
  one.first_frame = 7, one.end_frame = 8;
  std::filesystem::remove(folder / "out0007.png");
  layers_of(folder, animation, one);
  EXPECT_EQ(test::samples(folder.frames("out%04d.png").at(7)), test::samples(whole.at(7)));
}

// Lines that are found in pictures of the object, drawn from all of its triangles, or chained along its contour and
// creases go where it goes.
TEST(AnimatedShot, LinesOfOtherMethodsGoWithTheShape) {
  const test::ShotFolder folder;
  write_slide(folder);
  folder.noise_clip("in.mkv", small, 12);
  const auto cover_px = [](const Frame& layer) {
    double sum = 0;
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) sum += test::sample(layer, 3, x, y) / 255.0;
    }
    return sum;
  };
  const double bare_px = cover_px(layers_of(folder, "animation = true\n").at(11));
  for (const std::string method : {"hull", "depth_normals", "silhouette", "laplacian", "facing", "z_lines",
                                   "hidden_lines", "isophote", "wobble", "strokes"}) {
    // Of the box's flat sides the one has no line and the other its thinnest.
    const std::string width = method == "facing" || method == "isophote" ? "" : ", width_px = 2";
    const std::vector<Frame> layers =
        layers_of(folder, "animation = true\noutline = { method = \"" + method + "\"" + width + ", inner = true }\n");
    for (const std::size_t i : {0u, 5u, 11u}) {
      // What the side's strip adds; a line left behind by 4 px and more would draw the centroid to it by 1.
      EXPECT_NEAR(centre_px(layers.at(i)), expected_px(-0.5 + static_cast<double>(i) / 25), 0.6) << method << ", " << i;
    }
    // The box is some 14 px wide; a line of 2 px, or of its outer half, all around adds this at least.
    if (width.empty() || method == "strokes") continue;  // a brush's line is as wide where it is pressed down
    EXPECT_GT(cover_px(layers.at(11)), bare_px + 4 * 12 * 0.8) << method;
  }
}

TEST(AnimatedShot, ClipsThatAreNotThereAreNamed) {
  const test::ShotFolder folder;
  write_slide(folder);
  folder.noise_clip("in.mkv", small, 2);
  const auto message = [&](const std::string& scene) -> std::string {
    try {
      folder.render(scene, {.output = "out.mkv"});
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_status(), 2);
      const std::string line = error.what();
      return line.substr(line.find("scene.toml"));
    }
    return {};
  };
  EXPECT_EQ(message(slide_scene("animation = { clip = \"hop\" }\n")),
            "scene.toml:10:22: slide.gltf has no clip \"hop\"; it has \"slide\"");
  EXPECT_EQ(message(slide_scene("animation = { clip = 1 }\n")),
            "scene.toml:10:22: slide.gltf has no clip 1; its clips are 0 to 0");
  EXPECT_EQ(message(test::drawn_scene + "animation = true\n"),
            "scene.toml:10:13: cube.obj has no animation; leave 'animation' out, or export the mesh with its clips");
  EXPECT_FALSE(std::filesystem::exists(folder / "out.mkv"));
}

}  // namespace
}  // namespace rinkaku::pipeline

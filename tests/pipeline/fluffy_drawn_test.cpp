// Fluff over real plates: recordings/desk with its mascot made fluffy.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/gl/context.h"
#include "pipeline/objects/drawing.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/set_up.h"
#include "tests/pipeline/made_by.h"
#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

using test::ShotFolder;

const std::filesystem::path source_folder = RINKAKU_SOURCE_DIR;

// The desk's scene with true poses, and a mascot half as high as in the recording's own.
std::string desk(const std::string& look) {
  const std::string desk = (source_folder / "recordings" / "desk").string();
  return "[plate]\nvideo = \"" + desk + "/video.mp4\"\ncamera = \"" + desk + "/camera.yml\"\n[track]\nposes = \"" +
         desk + "/poses.csv\"\n[light]\ndirection = [-0.60, -0.50, 0.62]\n[[object]]\nmesh = \"" +
         (source_folder / "recordings" / "meshes" / "mascot.glb").string() +
         "\"\nposition_m = [0.1235, 0.091, 0]\nheight_m = 0.08\n" + look;
}

const std::string fluffy_coat = "outline = true\nfluffy = { parts = [\"coat\", \"stripe\", \"cream\"] }\n";

cv::Mat as_picture(const Frame& frame) {
  cv::Mat picture(frame.format.height_px, frame.format.width_px, CV_8UC4);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      cv::Vec4b& to = picture.at<cv::Vec4b>(y, x);
      for (int c = 0; c < 4; ++c) to[c] = static_cast<std::uint8_t>(test::sample(frame, c, x, y));
      std::swap(to[0], to[2]);  // as OpenCV has it
    }
  }
  return picture;
}

cv::Mat premultiplied(const cv::Mat& picture) {
  cv::Mat out = picture.clone();
  out.forEach<cv::Vec4b>([](cv::Vec4b& p, const int*) {
    for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(p[c] * p[3] / 255);
  });
  return out;
}

// RINKAKU_WRITE_GOLDEN=1 writes the golden frames anew, after somebody has looked at them.
TEST(FluffyDesk, LooksAsItDidWhenSomebodyLooked) {
  // How OpenCV synchronises its threads ThreadSanitizer can't see.
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const ShotFolder folder;
  for (const int number : {40, 120}) {
    RenderOptions options{.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")};
    options.first_frame = number;
    options.end_frame = number + 1;
    options.overwrite = true;
    folder.render(desk(fluffy_coat), options);
    char name[32];
    std::snprintf(name, sizeof name, "cg_%06d.png", number);
    const cv::Mat whole = as_picture(folder.frames(std::string("layers/") + name).at(0));
    cv::Mat alpha;
    cv::extractChannel(whole, alpha, 3);
    const cv::Rect box = cv::boundingRect(alpha);
    ASSERT_GT(box.area(), 10'000);
    const std::filesystem::path golden =
        source_folder / "tests" / "golden" / ("fluffy_desk_" + std::to_string(number) + ".png");
    if (std::getenv("RINKAKU_WRITE_GOLDEN") != nullptr) cv::imwrite(golden.string(), whole(box));
    const cv::Mat expected = cv::imread(golden.string(), cv::IMREAD_UNCHANGED);
    ASSERT_FALSE(expected.empty()) << golden;
    // Another driver may round coverage at the outermost pixel differently.
    ASSERT_LE(std::abs(expected.cols - box.width), 2);
    ASSERT_LE(std::abs(expected.rows - box.height), 2);
    const cv::Rect common(0, 0, std::min(expected.cols, box.width), std::min(expected.rows, box.height));
    cv::Mat difference;
    cv::absdiff(premultiplied(whole(box)(common)), premultiplied(expected(common)), difference);
    const cv::Scalar mean = cv::mean(difference);
    // Drawn anew by the same driver nothing differs; a tuft in the wrong place differs by a hundred in some pixels.
    EXPECT_LT(std::max({mean[0], mean[1], mean[2], mean[3]}), 1.0) << number;
  }
  cv::setNumThreads(threads);
}

TEST(FluffyDesk, PlateOutsideTheFluffIsBitIdentical) {
  const ShotFolder folder;
  RenderOptions options{.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")};
  options.first_frame = 40;
  options.end_frame = 43;
  folder.render(desk(fluffy_coat), options);
  const auto out = folder.frames("out.mkv"), layers = folder.frames("layers/cg_%06d.png");
  const auto source = source::open((source_folder / "recordings" / "desk" / "video.mp4").string());
  std::size_t compared = 0, changed = 0;
  for (int number = 0; number < 43; ++number) {
    const Frame in = source->next().value();
    if (number < 40) continue;
    const auto index = static_cast<std::size_t>(number - 40);
    const Frame& composite = out.at(index);
    const Frame& layer = layers.at(index);
    // Luma: where the layer has no alpha. Chroma: where none of the block's pixels has.
    for (int y = 0; y < in.format.height_px; ++y) {
      for (int x = 0; x < in.format.width_px; ++x) {
        const bool touched = test::sample(layer, 3, x, y) > 0;
        const bool same = test::sample(in, 0, x, y) == test::sample(composite, 0, x, y);
        EXPECT_TRUE(touched || same) << x << ", " << y;
        changed += touched && !same ? 1 : 0;
        compared += touched ? 0 : 1;
      }
    }
    for (int y = 0; y < in.format.height_px / 2; ++y) {
      for (int x = 0; x < in.format.width_px / 2; ++x) {
        bool touched = false;
        for (int k = 0; k < 4; ++k) touched = touched || test::sample(layer, 3, 2 * x + k % 2, 2 * y + k / 2) > 0;
        if (touched) continue;
        for (int c = 1; c < 3; ++c) EXPECT_EQ(test::sample(in, c, x, y), test::sample(composite, c, x, y));
      }
    }
  }
  EXPECT_GT(compared, 1'000'000u);
  EXPECT_GT(changed, 10'000u);
}

TEST(Unused, FluffThatNobodyWantsIsNeitherCompiledNorAllocated) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", test::picture("yuv420p", 64, 48, test::bt709_limited), 1);
  const std::string lined = test::drawn_scene + "outline = true\n";
  const gl::Made plain = test::made_by(folder, lined);
  EXPECT_EQ(test::made_by(folder, lined + "fluffy = false\n"), plain);
  const gl::Made fluffy = test::made_by(folder, lined + "fluffy = { line = \"none\" }\n");
  EXPECT_EQ(fluffy.programs, plain.programs + 1);
  EXPECT_EQ(fluffy.textures, plain.textures + 1);
  EXPECT_GT(fluffy.buffers, plain.buffers);
  // The line around the fluff has a shader of its own.
  EXPECT_EQ(test::made_by(folder, lined + "fluffy = true\n").programs, plain.programs + 2);
}

// Whatever draws the line, the fluff reaches out from the body.
TEST(FluffyDesk, FluffIsSeenWithLinesOfEveryKind) {
  const ShotFolder folder;
  const auto covered_px = [&](const std::string& look) {
    RenderOptions options{.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")};
    options.end_frame = 1;
    options.overwrite = true;
    folder.render(desk(look), options);
    cv::Mat alpha;
    cv::extractChannel(as_picture(folder.frames("layers/cg_000000.png").at(0)), alpha, 3);
    return cv::sum(alpha)[0] / 255;
  };
  for (const char* method : {"hull", "depth_normals"}) {
    const std::string line = std::string("outline = { method = \"") + method + "\" }\n";
    // The mascot's contour is some 500 px long, and about half of the fluff's 6 px beyond the line are covered.
    EXPECT_GT(covered_px(line + "fluffy = { length_m = 0.01 }\n"), covered_px(line) + 500) << method;
  }
}

TEST(FluffyErrors, NameTheSceneFilesLine) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", test::picture("yuv420p", 64, 48, test::bt709_limited), 1);
  folder.write("no.png", "this is no picture");
  const auto message = [&](const std::string& keys) -> std::string {
    try {
      folder.render(test::drawn_scene + keys + "\n", {.output = "out.mkv", .codec = "ffv1"});
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_status(), 2);
      EXPECT_FALSE(std::filesystem::exists(folder / "out.mkv"));
      return error.what();
    }
    return {};
  };
  const std::string parts = message("fluffy = { parts = \"mane\" }");
  EXPECT_NE(parts.find("scene.toml:10:"), std::string::npos) << parts;
  EXPECT_NE(parts.find("'mane'"), std::string::npos) << parts;
  EXPECT_NE(message("fluffy = { coordinates = \"mesh\" }").find("no texture coordinates"), std::string::npos);
  EXPECT_NE(message("fluffy = { vertex_paint = \"red\" }").find("no vertex colours"), std::string::npos);
  EXPECT_NE(message("fluffy = { texture = \"no.png\" }").find("no.png"), std::string::npos);
}

}  // namespace
}  // namespace rinkaku::pipeline

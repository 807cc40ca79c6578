#include "pipeline/scene/plate.h"

#include <cmath>
#include <cstdint>
#include <numeric>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

namespace fs = std::filesystem;
using toml::Table;

Rational read_fps(const Table& plate) {
  if (plate.has("video"))
    throw plate.error_at("fps", "goes with 'images': a video has times of its own", "leave it out");
  const double fps = *plate.number("fps", {0.001, 1000});
  // 23.976 (or 23.98), 29.97 and their like stand for 24 and 30 times 1000/1001.
  const std::int64_t whole = std::llround(fps);
  const bool ntsc = whole > 0 && (whole % 12 == 0 || whole % 15 == 0);
  if (ntsc && std::abs(fps - static_cast<double>(whole) * 1000 / 1001) < 0.005) return {whole * 1000, 1001};
  const std::int64_t millionths = std::llround(fps * 1e6), divisor = std::gcd(millionths, std::int64_t{1'000'000});
  return {millionths / divisor, 1'000'000 / divisor};
}

}  // namespace

toml::Schema plate_schema() {
  return {{.path = "plate",
           .keys = {"video", "images", "fps", "camera"},
           .refused = {{"device", "this version takes recordings only: give 'video' or 'images'"}}}};
}

PlateScene read_plate(const Table& plate, const std::string& input) {
  PlateScene scene;
  if (!input.empty()) {
    plate.exclude("video", "images");
    scene.input = fs::absolute(input).lexically_normal().string();
  } else if (plate.exactly_one({"video", "images"}) == "video") {
    scene.input = existing_file(plate, "video").string();
  } else {
    scene.input = image_pattern(plate, "images", "%*?[", "frames/%04d.png");
    const fs::path folder = fs::path(scene.input).parent_path();
    std::error_code error;
    const bool plain = folder.string().find_first_of("%*?[") == std::string::npos;
    if (plain && !fs::is_directory(folder, error)) {
      throw plate.error_at("images", "names a folder that doesn't exist: " + folder.string());
    }
  }
  if (plate.has("fps")) scene.fps = read_fps(plate);
  if (plate.has("camera")) scene.camera = existing_file(plate, "camera");
  return scene;
}

}  // namespace rinkaku::pipeline

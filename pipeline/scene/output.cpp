#include "pipeline/scene/output.h"

#include <string_view>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {

toml::Schema output_schema() {
  return {{.path = "output", .keys = {"video", "images", "codec", "bit_rate", "content"}}};
}

OutputScene read_output(const toml::Table& output) {
  OutputScene scene;
  output.exclude("video", "images");
  if (const auto video = output.text("video")) {
    scene.path = *video == "-" ? *video : toml::resolved(*video, output.file()).string();
  } else if (output.has("images")) {
    scene.path = image_pattern(output, "images", "%", "frames/%04d.png");
    for (const std::string_view key : {"codec", "bit_rate"}) {
      if (output.has(key)) throw output.error_at(key, "goes with 'video', not with 'images'", "leave it out");
    }
  }
  scene.codec = output.text("codec").value_or("");
  scene.bit_rate = output.integer("bit_rate", 1000, 10'000'000'000).value_or(0);
  const std::string content = output.text("content").value_or("composite");
  if (content != "composite" && content != "cg") throw output.wrong("content", "\"composite\" or \"cg\"");
  scene.content = content == "cg" ? OutputScene::Content::Cg : OutputScene::Content::Composite;
  return scene;
}

}  // namespace rinkaku::pipeline

#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "pipeline/frame/error.h"
#include "pipeline/scene/scene.h"
#include "tests/support/test_data.h"

namespace rinkaku::pipeline::test_scenes {

/// A folder with everything that the scenes here name.
class SceneFolder : public rinkaku::test::TemporaryFolder {
 public:
  SceneFolder() {
    for (const char* name : {"a.mp4", "camera.yml", "cow.obj", "board.toml", "poses.csv"}) std::ofstream(*this / name);
    std::filesystem::create_directories(*this / "frames");
  }
  std::filesystem::path write(const std::string& text) const {
    std::ofstream(*this / "scene.toml", std::ios::binary) << text;
    return *this / "scene.toml";
  }
  Scene read(const std::string& text) const { return read_scene(write(text)); }

  /// The message for a bad scene, this folder's name replaced by "DIR". Empty if the scene was taken.
  std::string message(const std::string& text) const {
    write(text);
    return message_for("scene.toml");
  }
  std::string message_for(const std::string& name) const {
    try {
      read_scene(*this / name);
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_status(), 2);
      std::string line = error.what();
      EXPECT_EQ(line.find('\n'), std::string::npos);
      for (auto at = line.find(path().string()); at != std::string::npos; at = line.find(path().string())) {
        line.replace(at, path().string().size(), "DIR");
      }
      return line;
    }
    return {};
  }
};

// Beginnings of scenes: a plate; with a pose; with an object.
inline const std::string plate = "[plate]\nvideo = \"a.mp4\"\ncamera = \"camera.yml\"\n";
inline const std::string tracked = plate + "[track]\nposes = \"poses.csv\"\n";
inline const std::string object = tracked + "[[object]]\nmesh = \"cow.obj\"\n";

}  // namespace rinkaku::pipeline::test_scenes

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/scene/scene.h"
#include "pipeline/toml/edit.h"

namespace rinkaku::app {

/// A scene file that is edited while it is shown: its text, what was read from it, and when it and what it names were
/// last seen to change. One thread.
class SceneFile {
 public:
  /// `shaders`: a folder of them that is looked at as well, see gl::use_shaders_from(); empty for none.
  /// Throws Error (Input) as read_scene() does.
  SceneFile(std::filesystem::path file, pipeline::SceneOptions options, std::filesystem::path shaders = {});

  const pipeline::Scene& scene() const { return scene_; }
  const std::string& text() const { return text_; }
  /// A value as the text has it now; null if it hasn't.
  const toml::Value* find(const toml::Path& path) const { return toml::find(document_, path); }
  /// How many [[object]] there are.
  std::size_t objects() const { return scene_.objects.size(); }
  bool unsaved() const { return text_ != saved_; }

  /// What a change means for a run.
  enum class Effect { None, Redraw, Restart };

  /// Sets one value, TOML as `toml::with_value` takes it. Throws Error (Input), and nothing changes, if the scene isn't
  /// right with it.
  Effect set(const toml::Path& path, const std::string& value);

  /// Sets the whole text, as set() does one value.
  Effect set_text(std::string text);

  /// Reads anew what changed on disk since it was last looked at, the scene or what it names. Throws Error (Input), and
  /// nothing changes, if the scene isn't right; it is then looked at again only when it changes once more.
  Effect look();

  /// Writes the text in the file's place, whole or not at all. Throws Error (Runtime).
  void save();

 private:
  Effect take(std::string text);
  void remember_times();

  std::filesystem::path file_, shaders_;
  pipeline::SceneOptions options_;
  std::string text_, saved_;
  toml::Value document_;
  pipeline::Scene scene_;
  struct Seen {
    std::filesystem::path path;
    std::filesystem::file_time_type time;
    Effect effect;
  };
  std::vector<Seen> seen_;
};

}  // namespace rinkaku::app

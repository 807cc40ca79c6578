#include "apps/rinkaku/viewer/scene_file.h"

#include <algorithm>
#include <utility>

#include "pipeline/files/pending_file.h"
#include "pipeline/gl/shader_text.h"

namespace rinkaku::app {
namespace {

namespace fs = std::filesystem;

fs::file_time_type time_of(const fs::path& path) {
  std::error_code error;
  const auto time = fs::last_write_time(path, error);
  return error ? fs::file_time_type::min() : time;
}

// Objects, light and water are drawn anew between two frames; all else is set up before the first one.
SceneFile::Effect effect_of(const std::vector<std::string>& changed, const pipeline::Scene& before,
                            const pipeline::Scene& after) {
  if (changed.empty()) return SceneFile::Effect::None;
  const bool only_drawn = std::all_of(changed.begin(), changed.end(), [](const std::string& key) {
    return key == "object" || key == "light" || key == "water";
  });
  const bool draws =
      before.objects.empty() == after.objects.empty() && before.water.has_value() == after.water.has_value();
  return only_drawn && draws && (!after.objects.empty() || after.water) ? SceneFile::Effect::Redraw
                                                                        : SceneFile::Effect::Restart;
}

// In the folder and those below it that aren't hidden, nor what a build made.
std::vector<fs::path> shader_files(const fs::path& folder) {
  std::vector<fs::path> found;
  if (folder.empty()) return found;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (at->is_directory(error) && (name.starts_with('.') || name == "build")) at.disable_recursion_pending();
    if (gl::is_shader_file(at->path())) found.push_back(at->path());
  }
  return found;
}

}  // namespace

SceneFile::SceneFile(fs::path file, pipeline::SceneOptions options, fs::path shaders)
    : file_(std::move(file)),
      shaders_(std::move(shaders)),
      options_(std::move(options)),
      text_(toml::read_text(file_)),
      saved_(text_) {
  document_ = toml::parse_text(text_, file_);
  pipeline::SceneOptions with_text = options_;
  with_text.text = text_;
  scene_ = pipeline::read_scene(file_, with_text);
  remember_times();
}

SceneFile::Effect SceneFile::take(std::string text) {
  toml::Value document = toml::parse_text(text, file_);
  pipeline::SceneOptions with_text = options_;
  with_text.text = text;
  pipeline::Scene scene = pipeline::read_scene(file_, with_text);
  const Effect effect = effect_of(toml::changed_keys(document_, document), scene_, scene);
  text_ = std::move(text);
  document_ = std::move(document);
  scene_ = std::move(scene);
  return effect;
}

SceneFile::Effect SceneFile::set_text(std::string text) { return take(std::move(text)); }

SceneFile::Effect SceneFile::set(const toml::Path& path, const std::string& value) {
  return take(toml::with_value(text_, path, value));
}

void SceneFile::remember_times() {
  seen_.clear();
  const auto add = [this](const fs::path& path, Effect effect) {
    if (!path.empty()) seen_.push_back({path, time_of(path), effect});
  };
  add(file_, Effect::None);
  add(scene_.plate.camera, Effect::Restart);
  for (const pipeline::ObjectScene& object : scene_.objects) add(object.mesh, Effect::Redraw);
  for (const fs::path& shader : shader_files(shaders_)) {
    // Water is set up with the run, all else is made anew with the objects.
    const bool of_water = *fs::relative(shader, shaders_).begin() == "water";
    add(shader, of_water || scene_.objects.empty() ? Effect::Restart : Effect::Redraw);
  }
}

SceneFile::Effect SceneFile::look() {
  Effect effect = Effect::None;
  bool scene_changed = false;
  for (Seen& seen : seen_) {
    const auto time = time_of(seen.path);
    // A file that is just being written in another's place is gone for a moment.
    if (time == seen.time || time == fs::file_time_type::min()) continue;
    seen.time = time;
    if (seen.path == file_) scene_changed = true;
    effect = std::max(effect, seen.effect);
  }
  if (!scene_changed) return effect;
  std::string text = toml::read_text(file_);
  if (text == saved_) return effect;
  effect = std::max(effect, take(text));
  saved_ = std::move(text);
  remember_times();
  return effect;
}

void SceneFile::save() {
  files::PendingFile file(file_.string(), true);
  file.write(text_);
  saved_ = text_;
  remember_times();
}

}  // namespace rinkaku::app

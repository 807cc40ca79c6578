#include "pipeline/scene/animation.h"

#include <variant>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {

toml::Schema animation_schema() {
  return {{.path = "object.animation", .keys = {"clip", "loop", "start_s", "speed", "skinning"}}};
}

std::optional<AnimationScene> read_animation(const toml::Table& object) {
  if (!object.has("animation")) return std::nullopt;
  AnimationScene scene;
  scene.where = object.where("animation");
  const auto animation = object.table_unless_flag("animation");
  if (!animation) {
    if (!*object.flag("animation")) return std::nullopt;
    return scene;
  }
  if (const toml::Value* clip = animation->find("clip")) {
    scene.where = animation->where("clip");
    if (std::holds_alternative<std::int64_t>(clip->held)) {
      scene.clip_index = *animation->integer("clip", 0, 1'000'000);
    } else if (std::holds_alternative<std::string>(clip->held)) {
      scene.clip_name = *animation->text("clip");
    } else {
      throw animation->wrong("clip", "a clip's name or its number, counted from 0");
    }
  }
  scene.loop = animation->flag("loop").value_or(scene.loop);
  scene.start_s = animation->number("start_s", {-1e6, 1e6}).value_or(scene.start_s);
  scene.speed = animation->number("speed", {-1000, 1000}).value_or(scene.speed);
  scene.skinning = read_choice<Skinning>(*animation, "skinning",
                                         {{"auto", Skinning::Auto}, {"cpu", Skinning::Cpu}, {"gpu", Skinning::Gpu}})
                       .value_or(scene.skinning);
  return scene;
}

}  // namespace rinkaku::pipeline

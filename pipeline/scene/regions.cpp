#include "pipeline/scene/regions.h"

#include <string>
#include <variant>

namespace rinkaku::pipeline {

std::optional<RegionsScene> read_regions(const toml::Table& object) {
  const toml::Value* value = object.find("regions");
  if (value == nullptr) return std::nullopt;
  if (std::holds_alternative<bool>(value->held)) {
    return *object.flag("regions") ? std::optional<RegionsScene>(RegionsScene{}) : std::nullopt;
  }
  if (!std::holds_alternative<std::string>(value->held)) throw object.wrong("regions", "true, false or a path");
  return RegionsScene{toml::resolved(*object.text("regions"), object.file())};
}

}  // namespace rinkaku::pipeline

#include "apps/rinkaku/json_output.h"

#include <cstdio>

#include <nlohmann/json.hpp>

namespace rinkaku::app {

std::string json_text(const nlohmann::json& value, int indent) {
  return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void print_json(const nlohmann::json& value) { std::fputs(json_text(value).c_str(), stdout); }

}  // namespace rinkaku::app

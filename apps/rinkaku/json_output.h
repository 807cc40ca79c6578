#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace rinkaku::app {

/// The JSON text and a line end. File names may hold any bytes: what is no UTF-8 becomes U+FFFD. `indent` -1: one line.
std::string json_text(const nlohmann::json& value, int indent = -1);

/// One line of JSON on standard output.
void print_json(const nlohmann::json& value);

}  // namespace rinkaku::app

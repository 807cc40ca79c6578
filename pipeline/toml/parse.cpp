#include <algorithm>
#include <string_view>

#include <toml++/toml.h>

#include "pipeline/files/read_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/toml/value.h"

namespace rinkaku::toml {
namespace {

constexpr std::size_t most_bytes = std::size_t{4} << 20;

Position position(const ::toml::source_position& at) {
  return {static_cast<int>(at.line), static_cast<int>(at.column)};
}

Value converted(const ::toml::node& node) {
  Value value{position(node.source().begin), DateOrTime{}};
  if (const auto* flag = node.as_boolean()) {
    value.held = flag->get();
  } else if (const auto* integer = node.as_integer()) {
    value.held = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.held = number->get();
  } else if (const auto* text = node.as_string()) {
    value.held = text->get();
  } else if (const auto* array = node.as_array()) {
    Array elements;
    for (const auto& element : *array) elements.push_back(converted(element));
    value.held = std::move(elements);
  } else if (const auto* table = node.as_table()) {
    Entries entries;
    for (const auto& [key, held] : *table) {
      entries.push_back({std::string(key.str()), position(key.source().begin), converted(held)});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.at < b.at; });
    value.held = std::move(entries);
  }
  return value;
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  std::string text = files::read_file(file, most_bytes);
  if (text.find('\0') != std::string::npos) throw input_error(file.string(), "isn't a text file, so it can't be TOML");
  return text;
}

Value parse_file(const std::filesystem::path& file) { return parse_text(read_text(file), file); }

Value parse_text(std::string_view text, const std::filesystem::path& file) {
  try {
    const ::toml::table table = ::toml::parse(text);
    return converted(table);
  } catch (const ::toml::parse_error& error) {
    const Position at = position(error.source().begin);
    throw input_error(file.string() + ":" + std::to_string(at.line) + ":" + std::to_string(at.column),
                      "not valid TOML: " + std::string(error.description()));
  }
}

}  // namespace rinkaku::toml

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include <toml++/toml.h>

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
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) throw input_error(file.string(), "no such file");
  if (std::filesystem::is_directory(status)) {
    throw input_error(file.string(), "is a folder", "name the TOML file in it");
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw input_error(file.string(), std::string("can't be read: ") + std::strerror(errno));
  std::string text(most_bytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad()) throw input_error(file.string(), "can't be read to its end");
  if (text.find('\0') != std::string::npos) throw input_error(file.string(), "isn't a text file, so it can't be TOML");
  if (text.size() > most_bytes) throw input_error(file.string(), "is larger than 4 MiB, so it can't be meant");
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

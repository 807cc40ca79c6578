#include "pipeline/toml/table.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rinkaku::toml {
namespace {

std::string shown(double number) { return described(Value{{}, number}); }

std::string range(const Limits& limits) {
  const bool least = limits.least > std::numeric_limits<double>::lowest();
  const bool most = limits.most < std::numeric_limits<double>::max();
  std::string text;
  if (limits.least_excluded) {
    text = " above " + shown(limits.least) + (most ? " and at most " + shown(limits.most) : "");
  } else if (least && most) {
    text = " from " + shown(limits.least) + " to " + shown(limits.most);
  } else if (least) {
    text = " of at least " + shown(limits.least);
  } else if (most) {
    text = " of at most " + shown(limits.most);
  }
  return text;
}

std::optional<double> as_number(const Value& value) {
  if (const auto* number = std::get_if<double>(&value.held)) return *number;
  if (const auto* integer = std::get_if<std::int64_t>(&value.held)) return static_cast<double>(*integer);
  return std::nullopt;
}

bool within(double number, const Limits& limits) {
  if (!std::isfinite(number) || number > limits.most) return false;
  return limits.least_excluded ? number > limits.least : number >= limits.least;
}

std::string quoted(std::string_view word) { return std::string("'").append(word).append("'"); }

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace

Table::Table(const Document& document, const Value& value, std::string path)
    : document_(&document), value_(&value), path_(std::move(path)) {}

const Value* Table::find(std::string_view key) const {
  for (const Entry& entry : std::get<Entries>(value_->held)) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

std::optional<bool> Table::flag(std::string_view key) const {
  const Value* value = find(key);
  if (!value) return std::nullopt;
  if (const auto* flag = std::get_if<bool>(&value->held)) return *flag;
  throw wrong(key, "true or false");
}

std::optional<std::string> Table::text(std::string_view key) const {
  const Value* value = find(key);
  if (!value) return std::nullopt;
  const auto* text = std::get_if<std::string>(&value->held);
  if (!text) throw wrong(key, "a text in quotes");
  if (text->empty()) throw error_at(key, "must not be empty");
  if (std::any_of(text->begin(), text->end(), is_control)) {
    throw wrong(key, "a text without control characters");
  }
  return *text;
}

std::optional<std::int64_t> Table::integer(std::string_view key, std::int64_t least, std::int64_t most) const {
  const Value* value = find(key);
  if (!value) return std::nullopt;
  const auto* integer = std::get_if<std::int64_t>(&value->held);
  if (!integer || *integer < least || *integer > most) {
    throw wrong(key, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return *integer;
}

double Table::checked(std::string_view key, const Value& value, const Limits& limits, std::string_view expected) const {
  const auto number = as_number(value);
  if (!number || !within(*number, limits)) {
    throw input_error(place(value.at), described(key) + " must be " + std::string(expected) + range(limits) +
                                           ", found " + toml::described(value));
  }
  return *number;
}

std::optional<double> Table::number(std::string_view key, const Limits& limits) const {
  const Value* value = find(key);
  if (!value) return std::nullopt;
  return checked(key, *value, limits, "a number");
}

std::optional<glm::dvec3> Table::vector3(std::string_view key, const Limits& limits) const {
  const Value* value = find(key);
  if (!value) return std::nullopt;
  const auto* array = std::get_if<Array>(&value->held);
  if (!array || array->size() != 3) throw wrong(key, "three numbers [x, y, z]");
  glm::dvec3 numbers;
  for (int i = 0; i < 3; ++i) {
    numbers[i] = checked(key, (*array)[static_cast<std::size_t>(i)], limits, "three numbers");
  }
  return numbers;
}

std::optional<Table> Table::table(std::string_view key) const {
  const Value* value = find(key);
  if (!value) return std::nullopt;
  if (std::holds_alternative<Entries>(value->held)) return below(key, *value);
  throw wrong(key, path_.empty() ? "one table, [" + std::string(key) + "]" : "a table { ... }");
}

std::vector<Table> Table::tables(std::string_view key) const {
  const Value* value = find(key);
  if (!value) return {};
  const std::string expected = "tables, each headed [[" + std::string(key) + "]] in two brackets";
  const auto* array = std::get_if<Array>(&value->held);
  if (!array) throw wrong(key, expected);
  std::vector<Table> tables;
  for (const Value& element : *array) {
    if (!std::holds_alternative<Entries>(element.held)) throw wrong(key, expected);
    tables.push_back(below(key, element));
  }
  return tables;
}

std::optional<Table> Table::table_unless_flag(std::string_view key) const {
  const Value* value = find(key);
  if (!value || std::holds_alternative<bool>(value->held)) return std::nullopt;
  if (std::holds_alternative<Entries>(value->held)) return below(key, *value);
  throw wrong(key, "true, false or a table { ... }");
}

std::string_view Table::exactly_one(std::initializer_list<std::string_view> keys) const {
  std::string_view given;
  std::string all;
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    if (key != keys.begin()) all += key + 1 == keys.end() ? " or " : ", ";
    all += quoted(*key);
    if (!has(*key)) continue;
    if (!given.empty()) exclude(given, *key);
    given = *key;
  }
  if (given.empty()) {
    throw error((path_.empty() ? "the file" : title(document_->schema(), path_)) + " needs one of " + all);
  }
  return given;
}

void Table::exclude(std::string_view key, std::string_view other) const {
  if (!has(key) || !has(other)) return;
  const bool later = find(key)->at < find(other)->at;
  throw error_at(later ? other : key, "can't stand beside '" + std::string(later ? key : other) + "'",
                 "keep one of them");
}

const std::filesystem::path& Table::file() const { return document_->file(); }
std::string Table::where(std::string_view key) const { return place(find(key)->at); }

Error Table::wrong(std::string_view key, std::string_view expected) const {
  const Value* value = find(key);
  return input_error(place(value->at),
                     described(key) + " must be " + std::string(expected) + ", found " + toml::described(*value));
}

Error Table::error_at(std::string_view key, std::string_view what, std::string_view remedy) const {
  return input_error(where(key), described(key) + " " + std::string(what), remedy);
}

Error Table::error(std::string_view what, std::string_view remedy) const {
  return input_error(place(value_->at), what, remedy);
}

Error Table::missing(std::string_view key) const { return error(described(key) + " is missing"); }

Table Table::below(std::string_view key, const Value& value) const {
  return {*document_, value, path_.empty() ? std::string(key) : path_ + "." + std::string(key)};
}

std::string Table::described(std::string_view key) const {
  const std::string in = title(document_->schema(), path_);
  return quoted(key).append(in.empty() ? "" : " in ").append(in);
}

std::string Table::place(Position at) const {
  return document_->file().string() + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
}

Document::Document(std::filesystem::path file, Schema schema)
    : file_(std::move(file)), schema_(std::move(schema)), value_(parse_file(file_)) {
  check_keys(schema_, value_, file_.string());
}

Document::Document(std::filesystem::path file, Schema schema, std::string_view text)
    : file_(std::move(file)), schema_(std::move(schema)), value_(parse_text(text, file_)) {
  check_keys(schema_, value_, file_.string());
}

std::filesystem::path resolved(const std::filesystem::path& path, const std::filesystem::path& written_in) {
  const auto folder = std::filesystem::absolute(written_in).parent_path();
  return (folder / path).lexically_normal();
}

}  // namespace rinkaku::toml

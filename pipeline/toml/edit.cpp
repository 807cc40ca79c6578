#include "pipeline/toml/edit.h"

#include <algorithm>

#include "pipeline/frame/error.h"

namespace rinkaku::toml {
namespace {

constexpr const char* where = "scene text";

// The byte at a position; columns count characters of UTF-8.
std::size_t byte_at(std::string_view text, Position at) {
  std::size_t byte = 0;
  for (int line = 1; line < at.line; ++line) {
    byte = text.find('\n', byte);
    if (byte == std::string_view::npos) return text.size();
    ++byte;
  }
  for (int column = 1; column < at.column && byte < text.size(); ++column) {
    ++byte;
    while (byte < text.size() && (static_cast<unsigned char>(text[byte]) & 0xc0) == 0x80) ++byte;
  }
  return byte;
}

std::size_t end_of_line(std::string_view text, std::size_t from) {
  return std::min(text.find('\n', from), text.size());
}

// Past the string that starts here.
std::size_t end_of_string(std::string_view text, std::size_t from) {
  const char quote = text[from];
  const std::string_view three = text.substr(from, 3);
  const bool lines = three.size() == 3 && three[1] == quote && three[2] == quote;
  const std::size_t width = lines ? 3 : 1;
  for (std::size_t at = from + width; at < text.size(); ++at) {
    if (text[at] == '\\' && quote == '"') {
      ++at;
    } else if (text.substr(at, width) == text.substr(from, width)) {
      return at + width;
    }
  }
  return text.size();
}

// Past the value that starts here.
std::size_t end_of_value(std::string_view text, std::size_t from) {
  if (text[from] == '"' || text[from] == '\'') return end_of_string(text, from);
  if (text[from] != '[' && text[from] != '{') {
    std::size_t end = std::min(text.find_first_of(",]}#\r\n", from), text.size());
    while (end > from && (text[end - 1] == ' ' || text[end - 1] == '\t')) --end;
    return end;
  }
  int depth = 0;
  for (std::size_t at = from; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = end_of_string(text, at) - 1;
    } else if (c == '#') {
      at = end_of_line(text, at);
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if ((c == ']' || c == '}') && --depth == 0) {
      return at + 1;
    }
  }
  return text.size();
}

const Value* child(const Value& table, const Step& step) {
  const auto* entries = std::get_if<Entries>(&table.held);
  if (!entries) return nullptr;
  const auto found = std::find_if(entries->begin(), entries->end(), [&](const Entry& e) { return e.key == step.key; });
  if (found == entries->end()) return nullptr;
  const auto* elements = std::get_if<Array>(&found->value.held);
  const bool of_tables = elements && !elements->empty() && std::holds_alternative<Entries>(elements->front().held);
  if (!of_tables) return &found->value;
  return step.index < elements->size() ? &(*elements)[step.index] : nullptr;
}

// Past all that a value was written as: past the last entry of a table with a header, and of those below it.
std::size_t end_of_all(std::string_view text, const Value& value) {
  const std::size_t begin = byte_at(text, value.at);
  if (const auto* entries = std::get_if<Entries>(&value.held); entries && text.substr(begin, 1) != "{") {
    std::size_t end = end_of_line(text, begin);
    for (const Entry& entry : *entries) end = std::max(end, end_of_all(text, entry.value));
    return end;
  }
  const auto* elements = std::get_if<Array>(&value.held);
  const bool of_tables = elements && !elements->empty() && std::holds_alternative<Entries>(elements->front().held);
  if (of_tables && text.substr(byte_at(text, elements->front().at), 1) != "{") {
    return end_of_all(text, elements->back());
  }
  return begin < text.size() ? end_of_value(text, begin) : begin;
}

bool blank(char c) { return c == ' ' || c == '\t'; }

// Puts `key = value` into the table that starts at byte `at`: `{ ... }`, or a header's line.
std::string inserted(std::string_view text, std::size_t at, const std::string& entry) {
  std::string result(text);
  if (at < text.size() && text[at] == '{') {
    std::size_t close = end_of_value(text, at) - 1;
    std::size_t last = close;
    while (last > at + 1 && (text[last - 1] == ' ' || text[last - 1] == '\t')) --last;
    const bool empty = last == at + 1;
    return result.replace(last, close - last, (empty ? " " : ", ") + entry + " ");
  }
  const std::size_t end = end_of_line(text, at);
  return result.insert(end, "\n" + entry);
}

}  // namespace

const Value* find(const Value& document, const Path& path) {
  const Value* at = &document;
  for (const Step& step : path) {
    at = child(*at, step);
    if (!at) return nullptr;
  }
  return at;
}

std::string with_value(std::string_view text, const Path& path, std::string_view value) {
  const Value document = parse_text(text, where);
  if (const Value* old = find(document, path)) {
    const std::size_t begin = byte_at(text, old->at), end = end_of_value(text, begin);
    return std::string(text).replace(begin, end - begin, value);
  }
  if (path.size() < 2) throw input_error(where, "has no such table");
  const Path above(path.begin(), path.end() - 1);
  const std::string entry = path.back().key + " = " + std::string(value);
  const Value* table = find(document, above);
  if (!table && above.size() == 1) {
    const bool ends_line = text.empty() || text.back() == '\n';
    return std::string(text) + (ends_line ? "\n[" : "\n\n[") + above.back().key + "]\n" + entry + "\n";
  }
  if (!table) return with_value(text, above, "{ " + entry + " }");
  if (std::holds_alternative<bool>(table->held)) return with_value(text, above, "{ " + entry + " }");
  if (!std::holds_alternative<Entries>(table->held)) throw input_error(where, "'" + above.back().key + "' is no table");
  return inserted(text, byte_at(text, table->at), entry);
}

std::string with_table(std::string_view text, const Path& array, std::span<const std::string> entries) {
  const Value document = parse_text(text, where);
  const Value* above = find(document, {array.begin(), array.end() - 1});
  const Value* old = nullptr;
  if (const auto* held = above ? std::get_if<Entries>(&above->held) : nullptr) {
    for (const Entry& entry : *held) old = entry.key == array.back().key ? &entry.value : old;
  } else {
    throw input_error(where, "has no such table");
  }
  const auto* elements = old ? std::get_if<Array>(&old->held) : nullptr;
  if (old && !elements) throw input_error(where, "'" + array.back().key + "' is no array");
  const Value* last = elements && !elements->empty() ? &elements->back() : nullptr;
  const Value& before = last ? *last : *above;
  std::string added;
  // An empty array was written as [], so its tables go between the brackets.
  if ((old && !last) || text.substr(byte_at(text, before.at), 1) == "{") {
    for (const std::string& entry : entries) added += (added.empty() ? "{ " : ", ") + entry;
    added += " }";
    if (last) return std::string(text).insert(end_of_all(text, *last), ", " + added);
    return with_value(text, array, "[" + added + "]");
  }
  for (const Step& step : array) added += (added.empty() ? "\n[[" : ".") + step.key;
  added += "]]";
  for (const std::string& entry : entries) added += "\n" + entry;
  return std::string(text).insert(end_of_line(text, end_of_all(text, before)), added);
}

std::string without_table(std::string_view text, const Path& table) {
  const Value document = parse_text(text, where);
  const Value* old = find(document, table);
  if (!old || !std::holds_alternative<Entries>(old->held)) throw input_error(where, "has no such table");
  std::size_t begin = byte_at(text, old->at), end = end_of_all(text, *old);
  if (text[begin] == '{') {
    // With the comma behind it, or as the last one with that before it.
    std::size_t comma = end;
    while (comma < text.size() && blank(text[comma])) ++comma;
    if (comma < text.size() && text[comma] == ',') {
      end = comma + 1;
      while (end < text.size() && blank(text[end])) ++end;
    } else {
      std::size_t back = begin;
      while (back > 0 && (blank(text[back - 1]) || text[back - 1] == '\n' || text[back - 1] == '\r')) --back;
      if (back > 0 && text[back - 1] == ',') begin = back - 1;
    }
    return std::string(text).erase(begin, end - begin);
  }
  while (begin > 0 && text[begin - 1] != '\n') --begin;
  end = std::min(end_of_line(text, end) + 1, text.size());
  return std::string(text).erase(begin, end - begin);
}

bool same(const Value& a, const Value& b) {
  if (a.held.index() != b.held.index()) return false;
  if (const auto* elements = std::get_if<Array>(&a.held)) {
    const auto& others = std::get<Array>(b.held);
    return std::equal(elements->begin(), elements->end(), others.begin(), others.end(), same);
  }
  if (std::holds_alternative<Entries>(a.held)) return changed_keys(a, b).empty();
  if (const auto* flag = std::get_if<bool>(&a.held)) return *flag == std::get<bool>(b.held);
  if (const auto* integer = std::get_if<std::int64_t>(&a.held)) return *integer == std::get<std::int64_t>(b.held);
  if (const auto* number = std::get_if<double>(&a.held)) return *number == std::get<double>(b.held);
  if (const auto* words = std::get_if<std::string>(&a.held)) return *words == std::get<std::string>(b.held);
  return true;
}

std::vector<std::string> changed_keys(const Value& before, const Value& after) {
  std::vector<std::string> changed;
  const auto& old_entries = std::get<Entries>(before.held);
  const auto& new_entries = std::get<Entries>(after.held);
  const auto value_in = [](const Entries& entries, const std::string& key) -> const Value* {
    const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
    return found == entries.end() ? nullptr : &found->value;
  };
  for (const Entry& entry : old_entries) {
    const Value* now = value_in(new_entries, entry.key);
    if (!now || !same(entry.value, *now)) changed.push_back(entry.key);
  }
  for (const Entry& entry : new_entries) {
    if (!value_in(old_entries, entry.key)) changed.push_back(entry.key);
  }
  return changed;
}

}  // namespace rinkaku::toml

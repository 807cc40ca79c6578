#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/toml/value.h"

namespace rinkaku::toml {

/// One step down a document: a key, and which element where the key holds an array of tables.
struct Step {
  std::string key;
  std::size_t index = 0;
};
using Path = std::vector<Step>;

/// The value at a path; null if there is none. Valid as long as the document.
const Value* find(const Value& document, const Path& path);

/// The text with a value set, everything else as it was, comments and layout too: an old value is replaced where it
/// stands, a new one is put into its table, and a missing or flag-valued last table (`outline = true`) is made.
/// `value` is TOML text, e.g. "3.5" or "\"red\"". Throws Error (Input) if `text` is no TOML or holds no such place.
std::string with_value(std::string_view text, const Path& path, std::string_view value);

/// The text with one more table at the end of an array of tables, written as its neighbours are: headed [[...]] or as
/// { ... }. The last step of `array` names the array, its index doesn't matter; `entries` are "key = value". Throws as
/// with_value() does.
std::string with_table(std::string_view text, const Path& array, std::span<const std::string> entries);

/// The text without one table of an array of tables; comments between tables stay. Throws as with_value() does.
std::string without_table(std::string_view text, const Path& table);

/// Whether two values are the same wherever they were written; the order of a table's keys doesn't matter.
bool same(const Value& a, const Value& b);

/// The keys of the top level whose values differ, or that only one document has.
std::vector<std::string> changed_keys(const Value& before, const Value& after);

}  // namespace rinkaku::toml

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rinkaku::toml {

/// Where something stands in a file: both count from 1, columns count characters.
struct Position {
  int line = 0;
  int column = 0;
  auto operator<=>(const Position&) const = default;
};

struct Value;
struct Entry;

/// TOML's dates and times: nothing here takes one.
struct DateOrTime {};

using Array = std::vector<Value>;
using Entries = std::vector<Entry>;  ///< a table's, in the file's order

/// A TOML value that knows where it was written.
struct Value {
  Position at;
  std::variant<DateOrTime, bool, std::int64_t, double, std::string, Array, Entries> held;
};

/// One `key = value` of a table, or a `[key]`.
struct Entry {
  std::string key;
  Position at;
  Value value;
};

/// Parses a TOML file; the result holds Entries. Throws Error (Input) if the file can't be read, isn't text, is larger
/// than 4 MiB, or isn't TOML (then with line and column).
Value parse_file(const std::filesystem::path& file);

/// The same of a text that stands, or shall stand, in `file`, which isn't looked at.
Value parse_text(std::string_view text, const std::filesystem::path& file);

/// The file's text. Throws Error (Input) as parse_file() does.
std::string read_text(const std::filesystem::path& file);

/// How a message shows a value: `the text "3 px"`, `-0.2`, `a table`, `an array of 2`.
std::string described(const Value& value);

}  // namespace rinkaku::toml

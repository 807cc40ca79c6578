#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/toml/schema.h"
#include "pipeline/toml/value.h"

namespace rinkaku::toml {

/// What a number may be. NaN and infinity are never taken.
struct Limits {
  double least = std::numeric_limits<double>::lowest();
  double most = std::numeric_limits<double>::max();
  bool least_excluded = false;  ///< must be above `least`, not equal to it

  static Limits above(double least, double most = std::numeric_limits<double>::max()) { return {least, most, true}; }
};

/// Strict reading of one table: every accessor answers empty if the key is absent, and throws Error (Input) with line
/// and column, what was expected and what was found, if its value is of another type or out of its limits.
///
/// A view: valid as long as its Document lives.
class Table {
 public:
  bool has(std::string_view key) const { return find(key) != nullptr; }
  const Value* find(std::string_view key) const;

  std::optional<bool> flag(std::string_view key) const;
  std::optional<std::string> text(std::string_view key) const;  ///< not empty, without control characters
  std::optional<std::int64_t> integer(std::string_view key, std::int64_t least, std::int64_t most) const;
  std::optional<double> number(std::string_view key, const Limits& limits = {}) const;
  std::optional<glm::dvec3> vector3(std::string_view key, const Limits& limits = {}) const;
  std::optional<Table> table(std::string_view key) const;
  std::vector<Table> tables(std::string_view key) const;  ///< of [[key]]; none if absent
  /// For a key that is `true`, `false` or a table of details.
  std::optional<Table> table_unless_flag(std::string_view key) const;

  /// The one of these keys that is given; throws unless it is exactly one.
  std::string_view exactly_one(std::initializer_list<std::string_view> keys) const;
  /// Throws if both are given.
  void exclude(std::string_view key, std::string_view other) const;

  /// The value, or the error that the key is missing: `table.required("id", table.integer("id", 0, 9))`.
  template <class T>
  T required(std::string_view key, std::optional<T> value) const {
    if (!value) throw missing(key);
    return *std::move(value);
  }

  /// The file that it was read from.
  const std::filesystem::path& file() const;
  /// "file:line:column" of a key's value, which must be there.
  std::string where(std::string_view key) const;
  /// "file:line:column: 'key' in [table] must be `expected`, found ...".
  Error wrong(std::string_view key, std::string_view expected) const;
  /// "file:line:column: 'key' in [table] `what`; remedy", at the key's value.
  Error error_at(std::string_view key, std::string_view what, std::string_view remedy = {}) const;
  /// "file:line:column: `what`; remedy", at the table's start.
  Error error(std::string_view what, std::string_view remedy = {}) const;
  Error missing(std::string_view key) const;

 private:
  friend class Document;
  Table(const class Document& document, const Value& value, std::string path);
  Table below(std::string_view key, const Value& value) const;
  std::string described(std::string_view key) const;
  std::string place(Position at) const;
  double checked(std::string_view key, const Value& value, const Limits& limits, std::string_view expected) const;

  const Document* document_;
  const Value* value_;
  std::string path_;
};

/// A TOML file whose keys were all checked against a schema.
class Document {
 public:
  /// Throws Error (Input) as parse_file() and check_keys() do.
  Document(std::filesystem::path file, Schema schema);
  /// Of a text in the file's place.
  Document(std::filesystem::path file, Schema schema, std::string_view text);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  Table root() const { return {*this, value_, {}}; }
  bool empty() const { return std::get<Entries>(value_.held).empty(); }
  const std::filesystem::path& file() const { return file_; }
  const Schema& schema() const { return schema_; }

 private:
  std::filesystem::path file_;
  Schema schema_;
  Value value_;
};

/// The path as written in a file, made absolute: relative ones start at that file's folder.
std::filesystem::path resolved(const std::filesystem::path& path, const std::filesystem::path& written_in);

}  // namespace rinkaku::toml

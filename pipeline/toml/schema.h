#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipeline/toml/value.h"

namespace rinkaku::toml {

/// A key that people will try but that isn't taken, and what to do instead.
struct RefusedKey {
  std::string_view key;
  std::string_view reason;
};

/// The keys that one table may hold.
struct Section {
  /// Its place: "" for the top level, "object", "object.outline". A key that has a section may hold something else than
  /// a table as well (`outline = true`).
  std::string_view path;
  std::vector<std::string_view> keys;
  bool repeated = false;  ///< written as [[object]], any number of times
  std::vector<RefusedKey> refused = {};
};

/// Every table of a kind of file.
using Schema = std::vector<Section>;

/// How a message names a section: "[plate]", "[[object]]", "outline of [[object]]"; empty for the top level.
std::string title(const Schema& schema, std::string_view path);

/// Throws Error (Input) for the first key in the file that its table doesn't take, with the nearest known key, or with
/// the table where that key belongs.
void check_keys(const Schema& schema, const Value& document, const std::string& file);

/// The word nearest to `word`, letter case aside, or empty if none is near. Counted in insertions, deletions,
/// replacements and swaps of neighbours; a third of the word may be wrong, and one letter of a short one. A unit may be
/// left out: "width" is near "width_px".
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& words);

}  // namespace rinkaku::toml

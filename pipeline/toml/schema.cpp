#include "pipeline/toml/schema.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "pipeline/frame/error.h"

namespace rinkaku::toml {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Optimal string alignment: Damerau's and Levenshtein's edits, none of them inside another.
std::size_t edits(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<std::size_t> cost((a.size() + 1) * columns);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return cost[i * columns + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        at(i, j) = i + j;
        continue;
      }
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  }
  return cost.back();
}

/// A candidate without its unit, so that "width" finds "width_px".
std::string_view stem(std::string_view word) {
  const auto underscore = word.rfind('_');
  return underscore == std::string_view::npos || underscore < 3 ? word : word.substr(0, underscore);
}

const Section* find_section(const Schema& schema, std::string_view path) {
  const auto found = std::find_if(schema.begin(), schema.end(), [&](const Section& s) { return s.path == path; });
  return found == schema.end() ? nullptr : &*found;
}

std::string joined(const std::vector<std::string>& words, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? last : ", ";
    text += words[i];
  }
  return text;
}

std::string place(const Schema& schema, const Section& section) {
  return section.path.empty() ? "at the top level" : "in " + title(schema, section.path);
}

/// What to write instead of an unknown key.
std::string advice(const Schema& schema, const Section& section, std::string_view key) {
  std::vector<std::string> homes;
  for (const Section& other : schema) {
    if (std::find(other.keys.begin(), other.keys.end(), key) != other.keys.end()) homes.push_back(place(schema, other));
  }
  if (!homes.empty()) return "it belongs " + joined(homes, " or ");
  if (const auto near = nearest(key, section.keys); !near.empty()) {
    return "did you mean '" + std::string(near) + "'?";
  }
  for (const Section& other : schema) {
    if (const auto near = nearest(key, other.keys); !near.empty()) {
      return "did you mean '" + std::string(near) + "', which belongs " + place(schema, other) + "?";
    }
  }
  std::vector<std::string> known(section.keys.begin(), section.keys.end());
  std::sort(known.begin(), known.end());
  return "known keys are " + joined(known, " and ");
}

struct Unknown {
  Position at;
  const Section* section;
  std::string_view key;
};

void find_unknown(const Schema& schema, std::string_view path, const Value& value, std::optional<Unknown>& first) {
  const Section* section = find_section(schema, path);
  if (!section) return;
  if (const auto* array = std::get_if<Array>(&value.held)) {
    for (const Value& element : *array) find_unknown(schema, path, element, first);
  }
  const auto* entries = std::get_if<Entries>(&value.held);
  if (!entries) return;
  for (const Entry& entry : *entries) {
    if (std::find(section->keys.begin(), section->keys.end(), entry.key) == section->keys.end()) {
      if (!first || entry.at < first->at) first = Unknown{entry.at, section, entry.key};
    } else {
      find_unknown(schema, path.empty() ? entry.key : std::string(path) + "." + entry.key, entry.value, first);
    }
  }
}

}  // namespace

std::string title(const Schema& schema, std::string_view path) {
  if (path.empty()) return {};
  if (const auto dot = path.rfind('.'); dot != std::string_view::npos) {
    return std::string(path.substr(dot + 1)) + " of " + title(schema, path.substr(0, dot));
  }
  const Section* section = find_section(schema, path);
  const bool repeated = section && section->repeated;
  return std::string(repeated ? "[[" : "[").append(path).append(repeated ? "]]" : "]");
}

void check_keys(const Schema& schema, const Value& document, const std::string& file) {
  std::optional<Unknown> unknown;
  find_unknown(schema, "", document, unknown);
  if (!unknown) return;
  const auto& [at, section, key] = *unknown;
  const std::string where = file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
  const std::string in = section->path.empty() ? "" : " in " + title(schema, section->path);
  for (const RefusedKey& refused : section->refused) {
    if (refused.key == key) {
      throw input_error(where, "'" + std::string(key) + "'" + in + " isn't supported", refused.reason);
    }
  }
  throw input_error(where, "unknown key '" + quotable(key) + "'" + in, advice(schema, *section, key));
}

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& words) {
  std::string_view best;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / 3) + 1;
  if (word.size() > 100) return {};
  for (const std::string_view candidate : words) {
    const std::size_t count = std::min(edits(word, candidate), edits(word, stem(candidate)));
    if (count < fewest) {
      fewest = count;
      best = candidate;
    }
  }
  return best;
}

}  // namespace rinkaku::toml

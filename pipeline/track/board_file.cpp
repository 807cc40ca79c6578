// Reads board files, see read_board() in board.h.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include <glm/geometric.hpp>
#include <toml++/toml.h>

#include "pipeline/frame/error.h"
#include "pipeline/track/board.h"
#include "pipeline/track/dictionary.h"
#include "pipeline/track/text_file.h"

namespace rinkaku::track {
namespace {

constexpr std::size_t most_bytes = 16u << 20;

std::string place(const std::string& file, const toml::source_region& at) {
  return file + ":" + std::to_string(at.begin.line) + ":" + std::to_string(at.begin.column);
}

// A table of the file: typed reads, and an error for every key that nobody asked for.
class TableReader {
 public:
  TableReader(const std::string& file, const toml::table& table, std::vector<std::string> known)
      : file_(file), table_(table) {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      throw input_error(place(file_, key.source()), "unknown key \"" + name + "\"",
                        "did you mean \"" + nearest_name(name, known) + "\"?");
    }
  }

  std::string here() const { return place(file_, table_.source()); }
  std::string where(const std::string& key) const {
    const toml::node* node = table_.get(key);
    return node ? place(file_, node->source()) : here();
  }

  const toml::node& need(const std::string& key) const {
    if (const toml::node* node = table_.get(key)) return *node;
    throw input_error(here(), "key \"" + key + "\" is missing");
  }

  double number(const std::string& key) const { return number_of(need(key), key); }

  int integer(const std::string& key, std::optional<int> otherwise = {}) const {
    if (otherwise && !table_.contains(key)) return *otherwise;
    const toml::node& node = need(key);
    const auto value = node.value_exact<std::int64_t>();
    constexpr std::int64_t limit = 1'000'000;
    if (!value || *value < -limit || *value > limit) {
      throw input_error(where(key), "\"" + key + "\" must be a whole number");
    }
    return static_cast<int>(*value);
  }

  std::string text(const std::string& key) const {
    if (const auto value = need(key).value_exact<std::string>()) return *value;
    throw input_error(where(key), "\"" + key + "\" must be a text in quotes");
  }

  TableReader table(const std::string& key, std::vector<std::string> known) const {
    if (const toml::table* table = need(key).as_table()) return {file_, *table, std::move(known)};
    throw input_error(where(key), "\"" + key + "\" must be a table: { ... }");
  }

  double number_of(const toml::node& node, const std::string& key) const {
    const auto value = node.value<double>();
    if (!node.is_number() || !value || !std::isfinite(*value)) {
      throw input_error(place(file_, node.source()), "\"" + key + "\" must be a number");
    }
    return *value;
  }

  bool has(const std::string& key) const { return table_.contains(key); }

 private:
  const std::string& file_;
  const toml::table& table_;
};

BoardMarker read_marker(const std::string& file, const toml::node& node, const std::string& dictionary) {
  const toml::table* table = node.as_table();
  if (!table) throw input_error(place(file, node.source()), "a marker must be a table: [[marker]]");
  const TableReader reader(file, *table, {"id", "corners_m"});
  BoardMarker marker;
  marker.id = reader.integer("id");
  check_marker(reader.where("id"), dictionary, marker.id);
  const std::string where = reader.where("corners_m");
  const toml::array* corners = reader.need("corners_m").as_array();
  const std::string order = "four corners [x, y] or [x, y, z] in metres, from the print's top left, clockwise";
  if (!corners || corners->size() != 4) throw input_error(where, "corners_m must hold four corners", order);
  for (std::size_t i = 0; i < 4; ++i) {
    const toml::array* corner = (*corners)[i].as_array();
    if (!corner || corner->size() < 2 || corner->size() > 3) {
      throw input_error(place(file, (*corners)[i].source()), "a corner must hold two or three numbers", order);
    }
    for (std::size_t axis = 0; axis < corner->size(); ++axis) {
      marker.corners_m[i][static_cast<int>(axis)] = reader.number_of((*corner)[axis], "corners_m");
    }
  }
  // Turning the same way at each corner, and really turning: a convex quadrilateral.
  const auto& c = marker.corners_m;
  const double size = std::max(glm::distance(c[0], c[2]), glm::distance(c[1], c[3]));
  const glm::dvec3 normal = glm::cross(c[2] - c[0], c[3] - c[1]);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 turn = glm::cross(c[(i + 1) % 4] - c[i], c[(i + 2) % 4] - c[(i + 1) % 4]);
    if (!(size > 1e-5) || !(size < 1e4) || !(glm::dot(turn, normal) > 1e-6 * std::pow(size, 4))) {
      throw input_error(where, "the four corners are not those of a convex quadrilateral", order);
    }
  }
  const double off_plane = std::abs(glm::dot(glm::normalize(normal), c[0] - c[1] + c[2] - c[3]));
  if (off_plane > 0.02 * size) throw input_error(where, "the four corners do not lie in one plane", order);
  return marker;
}

Board read_markers(const std::string& file, const toml::table& root, const std::string& dictionary) {
  const toml::node& node = *root.get("marker");
  const toml::array* entries = node.as_array();
  if (!entries || entries->empty()) {
    throw input_error(place(file, node.source()), "\"marker\" must be a list of tables",
                      "write [[marker]] before each");
  }
  Board board;
  board.layout = Board::Layout::Markers;
  board.dictionary = dictionary;
  std::set<int> seen;
  for (const toml::node& entry : *entries) {
    board.markers.push_back(read_marker(file, entry, dictionary));
    const int id = board.markers.back().id;
    if (!seen.insert(id).second) {
      throw input_error(place(file, entry.source()), "marker " + std::to_string(id) + " is given twice");
    }
  }
  return board;
}

Board read_layout(const std::string& file, const toml::table& table) {
  const TableReader root(file, table, {"dictionary", "grid", "charuco", "chessboard", "marker"});
  std::vector<std::string> layouts;
  for (const char* key : {"grid", "charuco", "chessboard", "marker"}) {
    if (root.has(key)) layouts.emplace_back(key);
  }
  const std::string remedy = "give one of grid, charuco, chessboard and [[marker]]";
  if (layouts.empty()) throw input_error(file, "the board has no layout", remedy);
  if (layouts.size() > 1) {
    throw input_error(root.where(layouts[1]), "\"" + layouts[0] + "\" and \"" + layouts[1] + "\" exclude each other",
                      remedy);
  }
  const std::string& layout = layouts[0];
  if (layout == "chessboard") {
    if (root.has("dictionary")) {
      throw input_error(root.where("dictionary"), "a chessboard has no dictionary", "leave it out, or use charuco");
    }
    const TableReader t = root.table(layout, {"columns", "rows", "square_m"});
    return chessboard(root.where(layout), {t.integer("columns"), t.integer("rows"), t.number("square_m")});
  }
  const std::string dictionary = root.text("dictionary");
  dictionary_size(root.where("dictionary"), dictionary);
  if (layout == "grid") {
    const TableReader t = root.table(layout, {"columns", "rows", "size_m", "gap_m", "first_id"});
    return grid_board(
        root.where(layout), dictionary,
        {t.integer("columns"), t.integer("rows"), t.number("size_m"), t.number("gap_m"), t.integer("first_id", 0)});
  }
  if (layout == "charuco") {
    const TableReader t = root.table(layout, {"columns", "rows", "square_m", "marker_m", "first_id"});
    return charuco_board(root.where(layout), dictionary,
                         {t.integer("columns"), t.integer("rows"), t.number("square_m"), t.number("marker_m"),
                          t.integer("first_id", 0)});
  }
  return read_markers(file, table, dictionary);
}

}  // namespace

Board read_board(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string text = read_text_file(file, most_bytes);
  try {
    Board board = read_layout(name, toml::parse(text, name));
    board.name = name;
    return board;
  } catch (const toml::parse_error& error) {
    throw input_error(place(name, error.source()), std::string(error.description()));
  }
}

}  // namespace rinkaku::track

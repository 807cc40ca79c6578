// Reads board files, see read_board() in board.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include <glm/geometric.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/toml/table.h"
#include "pipeline/track/board.h"
#include "pipeline/track/dictionary.h"

namespace rinkaku::track {
namespace {

using toml::Table;

const toml::Schema& board_schema() {
  static const toml::Schema schema = {
      {"", {"dictionary", "grid", "charuco", "chessboard", "marker"}},
      {"grid", {"columns", "rows", "size_m", "gap_m", "first_id"}},
      {"charuco", {"columns", "rows", "square_m", "marker_m", "first_id"}},
      {"chessboard", {"columns", "rows", "square_m"}},
      {"marker", {"id", "corners_m"}, true},
  };
  return schema;
}

// The table's numbers; what they may be is for grid_board() and its like to say.
int whole(const Table& table, std::string_view key) {
  return static_cast<int>(table.required(key, table.integer(key, 0, 1'000'000)));
}
int whole_or_0(const Table& table, std::string_view key) { return table.has(key) ? whole(table, key) : 0; }
double number(const Table& table, std::string_view key) { return table.required(key, table.number(key)); }

std::optional<double> finite_number(const toml::Value& value) {
  double number = std::nan("");
  if (const auto* real = std::get_if<double>(&value.held)) number = *real;
  if (const auto* integer = std::get_if<std::int64_t>(&value.held)) number = static_cast<double>(*integer);
  if (!std::isfinite(number)) return {};
  return number;
}

constexpr std::string_view four_corners =
    "four corners [x, y] or [x, y, z] in metres, from the print's top left, clockwise";

std::array<glm::dvec3, 4> read_corners(const Table& marker) {
  const toml::Value* value = marker.find("corners_m");
  if (!value) throw marker.missing("corners_m");
  const auto wrong = [&] { return marker.wrong("corners_m", four_corners); };
  const auto* corners = std::get_if<toml::Array>(&value->held);
  if (!corners || corners->size() != 4) throw wrong();
  std::array<glm::dvec3, 4> read{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto* corner = std::get_if<toml::Array>(&(*corners)[i].held);
    if (!corner || corner->size() < 2 || corner->size() > 3) throw wrong();
    for (std::size_t axis = 0; axis < corner->size(); ++axis) {
      const toml::Value& held = (*corner)[axis];
      const auto metres = finite_number(held);
      if (!metres) throw marker.error_at("corners_m", "must hold numbers, found " + toml::described(held));
      read[i][static_cast<int>(axis)] = *metres;
    }
  }
  return read;
}

// Turning the same way at each corner, and really turning: a convex quadrilateral, and flat.
void check_quadrilateral(const Table& marker, const std::array<glm::dvec3, 4>& c) {
  const double size = std::max(glm::distance(c[0], c[2]), glm::distance(c[1], c[3]));
  const glm::dvec3 normal = glm::cross(c[2] - c[0], c[3] - c[1]);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 turn = glm::cross(c[(i + 1) % 4] - c[i], c[(i + 2) % 4] - c[(i + 1) % 4]);
    if (!(size > 1e-5) || !(size < 1e4) || !(glm::dot(turn, normal) > 1e-6 * std::pow(size, 4))) {
      throw marker.error_at("corners_m", "must be the corners of a convex quadrilateral",
                            "give " + std::string(four_corners));
    }
  }
  const double off_plane = std::abs(glm::dot(glm::normalize(normal), c[0] - c[1] + c[2] - c[3]));
  if (off_plane > 0.02 * size) throw marker.error_at("corners_m", "must lie in one plane");
}

Board read_markers(const Table& root, const std::string& dictionary) {
  const std::vector<Table> markers = root.tables("marker");
  if (markers.empty()) throw root.error_at("marker", "must not be empty", "write [[marker]] before each");
  Board board;
  board.layout = Board::Layout::Markers;
  board.dictionary = dictionary;
  const int most_id = dictionary_size(root.where("dictionary"), dictionary) - 1;
  std::set<int> seen;
  for (const Table& marker : markers) {
    BoardMarker& read = board.markers.emplace_back();
    read.id = static_cast<int>(marker.required("id", marker.integer("id", 0, most_id)));
    read.corners_m = read_corners(marker);
    check_quadrilateral(marker, read.corners_m);
    if (!seen.insert(read.id).second) throw marker.error("marker " + std::to_string(read.id) + " is given twice");
  }
  return board;
}

Board read_layout(const Table& root) {
  const std::string_view layout = root.exactly_one({"grid", "charuco", "chessboard", "marker"});
  if (layout == "chessboard") {
    if (root.has("dictionary")) {
      throw root.error_at("dictionary", "has no meaning beside 'chessboard'", "leave it out, or use charuco");
    }
    const Table t = *root.table(layout);
    return chessboard(root.where(layout), {whole(t, "columns"), whole(t, "rows"), number(t, "square_m")});
  }
  const std::string dictionary = root.required("dictionary", root.text("dictionary"));
  dictionary_size(root.where("dictionary"), dictionary);
  if (layout == "grid") {
    const Table t = *root.table(layout);
    return grid_board(
        root.where(layout), dictionary,
        {whole(t, "columns"), whole(t, "rows"), number(t, "size_m"), number(t, "gap_m"), whole_or_0(t, "first_id")});
  }
  if (layout == "charuco") {
    const Table t = *root.table(layout);
    return charuco_board(root.where(layout), dictionary,
                         {whole(t, "columns"), whole(t, "rows"), number(t, "square_m"), number(t, "marker_m"),
                          whole_or_0(t, "first_id")});
  }
  return read_markers(root, dictionary);
}

}  // namespace

Board read_board(const std::filesystem::path& file) {
  const toml::Document document(file, board_schema());
  Board board = read_layout(document.root());
  board.name = file.string();
  return board;
}

}  // namespace rinkaku::track

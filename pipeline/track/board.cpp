#include "pipeline/track/board.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/track/dictionary.h"

namespace rinkaku::track {
namespace {

// More squares than any print has; bounds memory for hostile files.
constexpr int most_squares = 1000;

void check_length(std::string_view where, const char* key, double metres) {
  // 1e-5 m is a printer's dot, 1e4 m a town.
  if (!(metres >= 1e-5 && metres <= 1e4)) {
    throw input_error(where, std::string(key) + " must lie between 0.00001 and 10000", "it is a length in metres");
  }
}

void check_counts(std::string_view where, int columns, int rows, int fewest) {
  const auto check = [&](const char* key, int count) {
    if (count < fewest || count > most_squares) {
      throw input_error(where, std::string(key) + " must lie between " + std::to_string(fewest) + " and " +
                                   std::to_string(most_squares));
    }
  };
  check("columns", columns);
  check("rows", rows);
}

// A square marker whose bottom left corner is at (x, y).
BoardMarker square(int id, double x, double y, double size) {
  return {id, {{{x, y + size, 0}, {x + size, y + size, 0}, {x + size, y, 0}, {x, y, 0}}}};
}

struct Box {
  glm::dvec3 low{0}, high{0};
};

Box bounding_box(const Board& board) {
  Box box;
  bool first = true;
  const auto add = [&](const glm::dvec3& p) {
    box.low = first ? p : glm::min(box.low, p);
    box.high = first ? p : glm::max(box.high, p);
    first = false;
  };
  for (const BoardMarker& marker : board.markers) {
    for (const glm::dvec3& corner : marker.corners_m) add(corner);
  }
  if (board.square_m > 0) {
    add({0, 0, 0});
    add({board.columns * board.square_m, board.rows * board.square_m, 0});
  }
  return box;
}

}  // namespace

std::vector<glm::dvec3> Board::chess_corners_m() const {
  std::vector<glm::dvec3> corners;
  if (square_m <= 0) return corners;
  for (int row = 1; row < rows; ++row) {
    for (int column = 1; column < columns; ++column) {
      corners.emplace_back(column * square_m, (rows - row) * square_m, 0);
    }
  }
  return corners;
}

glm::dvec3 Board::centre_m() const {
  const Box box = bounding_box(*this);
  return (box.low + box.high) * 0.5;
}

double Board::radius_m() const {
  const Box box = bounding_box(*this);
  return glm::length(box.high - box.low) * 0.5;
}

bool Board::is_flat() const {
  return std::all_of(markers.begin(), markers.end(), [](const BoardMarker& marker) {
    return std::all_of(marker.corners_m.begin(), marker.corners_m.end(), [](const glm::dvec3& p) { return p.z == 0; });
  });
}

Board single_marker(std::string_view where, const std::string& dictionary, int id, double size_m) {
  check_marker(where, dictionary, id);
  check_length(where, "size_m", size_m);
  Board board;
  board.layout = Board::Layout::Single;
  board.name = where;
  board.dictionary = dictionary;
  board.columns = board.rows = 1;
  board.markers = {square(id, -size_m / 2, -size_m / 2, size_m)};
  return board;
}

Board grid_board(std::string_view where, const std::string& dictionary, const GridLayout& layout) {
  check_counts(where, layout.columns, layout.rows, 1);
  check_length(where, "size_m", layout.size_m);
  check_length(where, "gap_m", layout.gap_m);
  check_marker(where, dictionary, layout.first_id);
  check_marker(where, dictionary, layout.first_id + layout.columns * layout.rows - 1);
  Board board;
  board.layout = Board::Layout::Grid;
  board.name = where;
  board.dictionary = dictionary;
  board.columns = layout.columns;
  board.rows = layout.rows;
  const double step = layout.size_m + layout.gap_m;
  int id = layout.first_id;
  for (int row = 0; row < layout.rows; ++row) {
    for (int column = 0; column < layout.columns; ++column) {
      board.markers.push_back(square(id++, column * step, (layout.rows - 1 - row) * step, layout.size_m));
    }
  }
  return board;
}

Board charuco_board(std::string_view where, const std::string& dictionary, const CharucoLayout& layout) {
  check_counts(where, layout.columns, layout.rows, 2);
  check_length(where, "square_m", layout.square_m);
  check_length(where, "marker_m", layout.marker_m);
  if (layout.marker_m >= layout.square_m) {
    throw input_error(where, "marker_m must be smaller than square_m", "about 0.7 of it prints and detects well");
  }
  check_marker(where, dictionary, layout.first_id);
  check_marker(where, dictionary, layout.first_id + layout.columns * layout.rows / 2 - 1);
  Board board;
  board.layout = Board::Layout::Charuco;
  board.name = where;
  board.dictionary = dictionary;
  board.columns = layout.columns;
  board.rows = layout.rows;
  board.square_m = layout.square_m;
  const double margin = (layout.square_m - layout.marker_m) / 2;
  int id = layout.first_id;
  for (int row = 0; row < layout.rows; ++row) {
    for (int column = 0; column < layout.columns; ++column) {
      if ((row + column) % 2 == 0) continue;  // a black square
      board.markers.push_back(square(id++, column * layout.square_m + margin,
                                     (layout.rows - 1 - row) * layout.square_m + margin, layout.marker_m));
    }
  }
  return board;
}

Board chessboard(std::string_view where, const ChessboardLayout& layout) {
  check_counts(where, layout.columns, layout.rows, 4);
  check_length(where, "square_m", layout.square_m);
  Board board;
  board.layout = Board::Layout::Chessboard;
  board.name = where;
  board.columns = layout.columns;
  board.rows = layout.rows;
  board.square_m = layout.square_m;
  return board;
}

}  // namespace rinkaku::track

#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::track {

/// One printed square marker. Corners in the order that OpenCV detects them: from the marker's own top left, clockwise
/// as seen by a viewer. In metres, in the board's frame.
struct BoardMarker {
  int id = 0;
  std::array<glm::dvec3, 4> corners_m{};
};

/// What is printed and filmed; its frame is the world.
///
/// x points right along the print, y up the print, z out of it towards the viewer. The origin is the centre of a single
/// marker, the bottom left corner of a grid (of its bottom left marker), of a charuco board and of a chessboard (of its
/// bottom left square), and whatever the file says for markers given one by one.
struct Board {
  enum class Layout { Single, Grid, Charuco, Chessboard, Markers };

  Layout layout = Layout::Single;
  std::string name;        ///< where it came from, for messages
  std::string dictionary;  ///< empty for a chessboard
  std::vector<BoardMarker> markers;
  /// Columns and rows of markers (Grid) or of squares (Charuco, Chessboard; squares, not inner corners).
  int columns = 0;
  int rows = 0;
  double square_m = 0;  ///< a chess square's side; Charuco and Chessboard only

  /// The inner corners of the chess squares, row by row from the top left; empty for boards without squares.
  std::vector<glm::dvec3> chess_corners_m() const;
  /// Centre and radius of the ball around the middle of the bounding box that holds every corner.
  glm::dvec3 centre_m() const;
  double radius_m() const;
  /// Whether every corner lies in the plane z = 0, so that the board can be printed on one page.
  bool is_flat() const;
};

/// A board of one marker, its side `size_m` in metres. Throws Error (Input), naming `where`, for an unknown dictionary
/// or id, or a size that is not positive and finite.
Board single_marker(std::string_view where, const std::string& dictionary, int id, double size_m);

/// Marker ids row by row from the top left, counted from `first_id`; `gap_m` between the markers.
struct GridLayout {
  int columns = 0;
  int rows = 0;
  double size_m = 0;
  double gap_m = 0;
  int first_id = 0;
};
Board grid_board(std::string_view where, const std::string& dictionary, const GridLayout& layout);

/// A chessboard whose white squares hold markers, ids row by row from the top left, counted from `first_id`. The top
/// left square is black (OpenCV from 4.6 on, not its older "legacy" pattern).
struct CharucoLayout {
  int columns = 0;
  int rows = 0;
  double square_m = 0;
  double marker_m = 0;
  int first_id = 0;
};
Board charuco_board(std::string_view where, const std::string& dictionary, const CharucoLayout& layout);

/// A plain chessboard, its top left square black; for calibration only: it can't be told from itself turned around.
struct ChessboardLayout {
  int columns = 0;
  int rows = 0;
  double square_m = 0;
};
Board chessboard(std::string_view where, const ChessboardLayout& layout);

/// Reads a board file (TOML):
///
///     dictionary = "4X4_50"                      # all but a chessboard
///     grid = { columns = 5, rows = 7, size_m = 0.03, gap_m = 0.006 }         # one of these four;
///     charuco = { columns = 5, rows = 7, square_m = 0.03, marker_m = 0.022 } # first_id = 0 may be given to these two
///     chessboard = { columns = 9, rows = 6, square_m = 0.025 }
///     [[marker]]
///     id = 3
///     corners_m = [[0, 0.1, 0], [0.1, 0.1, 0], [0.1, 0, 0], [0, 0, 0]]        # z may be left out: 0
///
/// Throws Error (Input) naming file, line and column: unknown keys with the nearest known one, wrong types, values out
/// of range, ids the dictionary lacks or that come twice, markers that are no quadrilateral. Any thread.
Board read_board(const std::filesystem::path& file);

}  // namespace rinkaku::track

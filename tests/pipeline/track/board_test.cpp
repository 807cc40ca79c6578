#include "pipeline/track/board.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "pipeline/track/dictionary.h"
#include "tests/pipeline/track/track_test_support.h"
#include "tests/support/test_data.h"

namespace rinkaku::track {
namespace {

using test::write;

class BoardFile : public testing::Test {
 protected:
  Board read(const std::string& text) { return read_board(write(folder_ / "board.toml", text)); }
  rinkaku::test::TemporaryFolder folder_;
};

void expect_corner(const glm::dvec3& corner, double x, double y) {
  EXPECT_NEAR(glm::distance(corner, glm::dvec3(x, y, 0)), 0, 1e-12) << corner.x << " " << corner.y << " " << corner.z;
}

TEST(Board, OfASingleMarkerHasItsOriginInTheMiddleAndCornersClockwiseFromTopLeft) {
  const Board board = single_marker("scene", "ARUCO_ORIGINAL", 101, 0.1);
  ASSERT_EQ(board.markers.size(), 1u);
  const auto& c = board.markers[0].corners_m;
  expect_corner(c[0], -0.05, 0.05);
  expect_corner(c[1], 0.05, 0.05);
  expect_corner(c[2], 0.05, -0.05);
  expect_corner(c[3], -0.05, -0.05);
  EXPECT_NEAR(board.radius_m(), 0.05 * std::sqrt(2), 1e-12);
  expect_corner(board.centre_m(), 0, 0);
}

TEST(Board, RefusesMarkersThatAreNot) {
  EXPECT_REFUSED(single_marker("scene:3:1", "ARUCO_ORIGINAL", 1024, 0.1),
                 "scene:3:1: dictionary ARUCO_ORIGINAL has no marker");
  EXPECT_REFUSED(single_marker("s", "ARUCO_ORIGINAL", -1, 0.1), "ids run from 0 to 1023");
  EXPECT_REFUSED(single_marker("s", "aruco_original", 1, 0.1), "did you mean \"ARUCO_ORIGINAL\"?");
  EXPECT_REFUSED(single_marker("s", "DICT_4X4_50", 1, 0.1), "did you mean \"4X4_50\"?");
  EXPECT_REFUSED(single_marker("s", "4X4_50", 1, 0), "size_m");
  EXPECT_REFUSED(single_marker("s", "4X4_50", 1, -0.1), "size_m");
  EXPECT_REFUSED(single_marker("s", "4X4_50", 1, std::nan("")), "size_m");
}

TEST(Board, KnowsEveryDictionaryOfOpenCv) {
  ASSERT_EQ(dictionary_names().size(), 21u);
  EXPECT_EQ(dictionary_size("s", "4X4_50"), 50);
  EXPECT_EQ(dictionary_size("s", "7X7_1000"), 1000);
  EXPECT_EQ(dictionary_size("s", "ARUCO_ORIGINAL"), 1024);
  EXPECT_EQ(dictionary_size("s", "APRILTAG_16h5"), 30);
  EXPECT_EQ(dictionary_size("s", "APRILTAG_36h10"), 2320);
  EXPECT_EQ(dictionary_size("s", "APRILTAG_36h11"), 587);
}

TEST_F(BoardFile, GridCountsRowByRowFromTheTopLeftWithItsOriginBottomLeft) {
  const Board board = read("dictionary = \"4X4_50\"\ngrid = { columns = 3, rows = 2, size_m = 0.04, gap_m = 0.01 }\n");
  ASSERT_EQ(board.markers.size(), 6u);
  EXPECT_EQ(board.markers[5].id, 5);
  expect_corner(board.markers[0].corners_m[0], 0, 0.09);
  expect_corner(board.markers[1].corners_m[0], 0.05, 0.09);
  expect_corner(board.markers[3].corners_m[3], 0, 0);
  expect_corner(board.markers[5].corners_m[1], 0.14, 0.04);
  expect_corner(board.centre_m(), 0.07, 0.045);
}

TEST_F(BoardFile, CharucoHasABlackSquareAtTheTopLeft) {
  const Board board = read(
      "dictionary = \"4X4_50\"\ncharuco = { columns = 5, rows = 4, square_m = 1, marker_m = 0.6, first_id = 10 }\n");
  ASSERT_EQ(board.markers.size(), 10u);
  EXPECT_EQ(board.markers[0].id, 10);
  expect_corner(board.markers[0].corners_m[0], 1.2, 3.8);  // the second square of the top row
  expect_corner(board.markers[2].corners_m[0], 0.2, 2.8);
  const auto corners = board.chess_corners_m();
  ASSERT_EQ(corners.size(), 12u);
  expect_corner(corners[0], 1, 3);
  expect_corner(corners[4], 1, 2);
}

TEST_F(BoardFile, ChessboardCountsSquares) {
  const Board board = read("chessboard = { columns = 9, rows = 6, square_m = 0.025 }\n");
  EXPECT_TRUE(board.markers.empty());
  EXPECT_EQ(board.chess_corners_m().size(), 8u * 5u);
}

TEST_F(BoardFile, MarkersMayStandAnywhere) {
  const Board board = read(
      "dictionary = \"APRILTAG_36h11\"\n[[marker]]\nid = 3\ncorners_m = [[0, 0.1], [0.1, 0.1], [0.1, 0], [0, 0]]\n"
      "[[marker]]\nid = 8\ncorners_m = [[0, 0.1, 0.1], [0, 0.1, 0], [0, 0, 0], [0, 0, 0.1]]\n");
  ASSERT_EQ(board.markers.size(), 2u);
  expect_corner(board.markers[0].corners_m[1], 0.1, 0.1);
  EXPECT_EQ(board.markers[1].corners_m[0], glm::dvec3(0, 0.1, 0.1));
  EXPECT_FALSE(board.is_flat());
}

TEST_F(BoardFile, NamesLineAndColumnOfWhatIsWrong) {
  const std::string d = "dictionary = \"4X4_50\"\n";
  EXPECT_REFUSED(read(d + "gird = { columns = 3 }\n"), "board.toml:2:1: unknown key 'gird'; did you mean 'grid'?");
  EXPECT_REFUSED(read(d + "grid = { columns = 3, row = 2, size_m = 0.04, gap_m = 0.01 }\n"),
                 "unknown key 'row' in [grid]; did you mean 'rows'?");
  EXPECT_REFUSED(read(d + "grid = { columns = 3, rows = 2, size_m = 0.04 }\n"),
                 "board.toml:2:8: 'gap_m' in [grid] is missing");
  EXPECT_REFUSED(read(d + "grid = { columns = 3.5, rows = 2, size_m = 0.04, gap_m = 0.01 }\n"),
                 "'columns' in [grid] must be a whole number from 0 to 1000000, found 3.5");
  EXPECT_REFUSED(read(d + "grid = { columns = 0, rows = 2, size_m = 0.04, gap_m = 0.01 }\n"),
                 "columns must lie between");
  EXPECT_REFUSED(read(d + "grid = { columns = 3, rows = 2, size_m = nan, gap_m = 0.01 }\n"),
                 "'size_m' in [grid] must be a number, found nan");
  EXPECT_REFUSED(read(d + "grid = { columns = 3, rows = 2, size_m = -1, gap_m = 0.01 }\n"), "size_m must lie between");
  EXPECT_REFUSED(read(d + "grid = { columns = 3, rows = 2, size_m = true, gap_m = 0.01 }\n"),
                 "'size_m' in [grid] must be a number, found true");
  EXPECT_REFUSED(read(d + "grid = { columns = 10, rows = 6, size_m = 1, gap_m = 1 }\n"), "no marker of id 59");
  EXPECT_REFUSED(read(d + "grid = 3\n"), "board.toml:2:8: 'grid' must be one table, [grid], found 3");
  EXPECT_REFUSED(read(d), "the file needs one of 'grid', 'charuco', 'chessboard' or 'marker'");
  EXPECT_REFUSED(read(d + "grid = {}\nchessboard = {}\n"), "'chessboard' can't stand beside 'grid'; keep one of them");
  EXPECT_REFUSED(read("grid = { columns = 3, rows = 2, size_m = 0.04, gap_m = 0.01 }\n"), "'dictionary' is missing");
  EXPECT_REFUSED(read("dictionary = \"5x5_50\"\ngrid = {}\n"), "board.toml:1:14: there is no marker dictionary");
  EXPECT_REFUSED(read(d + "chessboard = { columns = 9, rows = 6, square_m = 1 }\n"),
                 "'dictionary' has no meaning beside 'chessboard'");
  EXPECT_REFUSED(read(d + "charuco = { columns = 5, rows = 4, square_m = 1, marker_m = 1 }\n"),
                 "smaller than square_m");
  EXPECT_REFUSED(read("dictionary = \n"), "board.toml:1:");
  EXPECT_REFUSED(read_board(folder_ / "none.toml"), "no such file");
}

TEST_F(BoardFile, RefusesMarkersThatAreNoQuadrilateral) {
  const auto marker = [](const std::string& corners, const std::string& id = "3") {
    return "[[marker]]\nid = " + id + "\ncorners_m = " + corners + "\n";
  };
  const std::string d = "dictionary = \"4X4_50\"\n", good = "[[0, 1], [1, 1], [1, 0], [0, 0]]";
  EXPECT_REFUSED(read(d + marker(good) + marker(good)), "marker 3 is given twice");
  EXPECT_REFUSED(read(d + marker(good, "50")), "'id' in [[marker]] must be a whole number from 0 to 49, found 50");
  EXPECT_REFUSED(read(d + marker("[[0, 1], [1, 1], [1, 0]]")), "four corners");
  EXPECT_REFUSED(read(d + marker("[[0, 1], [1, 0], [1, 1], [0, 0]]")), "convex quadrilateral");
  EXPECT_REFUSED(read(d + marker("[[0, 0], [1, 0], [2, 0], [3, 0]]")), "convex quadrilateral");
  EXPECT_REFUSED(read(d + marker("[[0, 0], [0, 0], [0, 0], [0, 0]]")), "convex quadrilateral");
  EXPECT_REFUSED(read(d + marker("[[0, 1], [1, 1, 0.3], [1, 0], [0, 0]]")), "one plane");
  EXPECT_REFUSED(read(d + marker("[[0, 1], [1, 1], [1, 0], [0, inf]]")), "must hold numbers, found infinity");
  EXPECT_REFUSED(read(d + marker("[[0, 1], [1, 1], [1, 0], [0]]")), "must be four corners [x, y] or [x, y, z]");
  EXPECT_REFUSED(read(d + "marker = []\n"), "'marker' must not be empty");
  EXPECT_REFUSED(read(d + "[marker]\nid = 3\n"), "'marker' must be tables, each headed [[marker]]");
}

}  // namespace
}  // namespace rinkaku::track

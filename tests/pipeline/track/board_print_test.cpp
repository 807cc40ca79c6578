#include "pipeline/track/board_print.h"

#include <cstdlib>
#include <map>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/pipeline/track/track_test_support.h"
#include "tests/support/test_data.h"

namespace rinkaku::track {
namespace {

constexpr double dots_per_m = 200 / 0.0254;

class BoardPrint : public testing::Test {
 protected:
  // The sheet as a printer would see it, at 200 dots an inch; empty if there is no PDF renderer here.
  cv::Mat print(const Board& board, const PrintOptions& options = {}) {
    const auto pdf = folder_ / "board.pdf";
    page_ = print_board(board, pdf, options);
    const std::string command =
        "pdftoppm -r 200 -gray -singlefile '" + pdf.string() + "' '" + (folder_ / "page").string() + "'";
    if (std::system(command.c_str()) != 0) return {};
    return cv::imread((folder_ / "page.pgm").string(), cv::IMREAD_GRAYSCALE);
  }

  rinkaku::test::TemporaryFolder folder_;
  PrintedPage page_;
};

#define NEEDS_PDFTOPPM() \
  if (std::system("pdftoppm -v >/dev/null 2>&1") != 0) GTEST_SKIP() << "pdftoppm (poppler-utils) is not installed"

// Finds the markers again and compares their corners with the board's, up to where the board lies on the sheet.
void expect_printed(const cv::Mat& page, const Board& board, int dictionary) {
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  parameters->minMarkerPerimeterRate = 0.01;
  cv::aruco::detectMarkers(page, cv::aruco::getPredefinedDictionary(dictionary), corners, ids, parameters);
  ASSERT_EQ(ids.size(), board.markers.size());
  std::map<int, const BoardMarker*> by_id;
  for (const BoardMarker& marker : board.markers) by_id[marker.id] = &marker;
  std::optional<glm::dvec2> origin;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ASSERT_TRUE(by_id.count(ids[i])) << ids[i];
    for (std::size_t c = 0; c < 4; ++c) {
      const glm::dvec3& truth = by_id[ids[i]]->corners_m[c];
      // y up on the board, down on the sheet.
      const glm::dvec2 here(corners[i][c].x / dots_per_m - truth.x, corners[i][c].y / dots_per_m + truth.y);
      if (!origin) origin = here;
      // A dot is 0.127 mm.
      EXPECT_LT(glm::distance(here, *origin), 0.0002) << "marker " << ids[i] << " corner " << c;
    }
  }
}

TEST_F(BoardPrint, PrintsAGridAtTrueScale) {
  NEEDS_PDFTOPPM();
  const Board board = grid_board("test", "4X4_50", {5, 7, 0.03, 0.006, 3});
  const cv::Mat page = print(board);
  ASSERT_FALSE(page.empty());
  EXPECT_NEAR(page.cols, 0.210 * dots_per_m, 2) << "A4 upright";
  EXPECT_NEAR(page.rows, 0.297 * dots_per_m, 2);
  expect_printed(page, board, cv::aruco::DICT_4X4_50);
}

TEST_F(BoardPrint, PrintsASingleMarker) {
  NEEDS_PDFTOPPM();
  const Board board = single_marker("test", "ARUCO_ORIGINAL", 101, 0.1);
  expect_printed(print(board), board, cv::aruco::DICT_ARUCO_ORIGINAL);
}

TEST_F(BoardPrint, PrintsACharucoBoardAsOpenCvKnowsIt) {
  NEEDS_PDFTOPPM();
  const Board board = charuco_board("test", "5X5_100", {7, 5, 0.035, 0.026});
  const cv::Mat page = print(board);
  EXPECT_NEAR(page.cols, 0.297 * dots_per_m, 2) << "A4 across";
  expect_printed(page, board, cv::aruco::DICT_5X5_100);
}

TEST_F(BoardPrint, PrintsAChessboard) {
  NEEDS_PDFTOPPM();
  const cv::Mat page = print(chessboard("test", {9, 6, 0.025}));
  std::vector<cv::Point2f> corners;
  ASSERT_TRUE(cv::findChessboardCorners(page, {8, 5}, corners));
  EXPECT_NEAR(cv::norm(corners[7] - corners[0]) / 7 / dots_per_m, 0.025, 0.00005);
}

TEST_F(BoardPrint, TakesALargerSheetWhereItMust) {
  print_board(grid_board("test", "4X4_50", {5, 7, 0.03, 0.006}), folder_ / "a.pdf");
  EXPECT_NEAR(print_board(grid_board("test", "4X4_50", {6, 4, 0.05, 0.01}), folder_ / "b.pdf").width_m, 0.420, 1e-9);
  EXPECT_NEAR(print_board(single_marker("test", "4X4_50", 1, 0.5), folder_ / "c.pdf").width_m, 0.594 + 0.247, 0.01);
  EXPECT_REFUSED(print_board(single_marker("big", "4X4_50", 1, 2.0), folder_ / "d.pdf"), "big: the board takes");
  EXPECT_REFUSED(print_board(single_marker("big", "4X4_50", 1, 0.1), folder_ / "d.pdf", {0.08, 0.08}),
                 "80 x 80 mm sheet");
  EXPECT_REFUSED(print_board(single_marker("big", "4X4_50", 1, 0.1), folder_ / "d.pdf", {0.5, 0}),
                 "width and a height");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "d.pdf"));
}

TEST_F(BoardPrint, RefusesBoardsThatAreNotFlat) {
  Board bent = grid_board("bent", "4X4_50", {2, 2, 0.03, 0.01});
  bent.markers[0].corners_m[0].z = 0.01;
  EXPECT_REFUSED(print_board(bent, folder_ / "bent.pdf"), "plane z = 0");
  EXPECT_THROW(print_board(single_marker("m", "4X4_50", 1, 0.1), folder_ / "no" / "folder.pdf"), Error);
}

}  // namespace
}  // namespace rinkaku::track

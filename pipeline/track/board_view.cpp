#include "pipeline/track/board_view.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/track/opencv_marker.h"

namespace rinkaku::track {
namespace {

constexpr std::size_t fewest_points = 8;  // twice what a plane's pose needs

cv::Point3f to_cv(const glm::dvec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

// How abrupt the board's edges are: the Laplacian's deviation relative to the picture's, where the board is.
double sharpness(const cv::Mat& grey, const std::vector<cv::Point2f>& points) {
  const cv::Rect box = cv::boundingRect(points) & cv::Rect(0, 0, grey.cols, grey.rows);
  if (box.empty()) return 0;
  cv::Mat laplacian;
  cv::Laplacian(grey(box), laplacian, CV_16S, 3);
  cv::Scalar mean, edges, levels;
  cv::meanStdDev(laplacian, mean, edges);
  cv::meanStdDev(grey(box), mean, levels);
  return levels[0] > 1 ? edges[0] / levels[0] : 0;
}

}  // namespace

BoardViewFinder::BoardViewFinder(const Board& board) : board_(board) {
  for (const glm::dvec3& corner : board.chess_corners_m()) chess_m_.push_back(to_cv(corner));
  if (board.layout == Board::Layout::Chessboard) return;
  dictionary_ = opencv_dictionary(board.name, board.dictionary);
  parameters_ = cv::aruco::DetectorParameters::create();
  if (board.layout == Board::Layout::Charuco) {
    double marker_m = glm::distance(board.markers[0].corners_m[0], board.markers[0].corners_m[1]);
    charuco_ = cv::aruco::CharucoBoard::create(board.columns, board.rows, static_cast<float>(board.square_m),
                                               static_cast<float>(marker_m), dictionary_);
    for (std::size_t i = 0; i < charuco_->ids.size(); ++i) charuco_->ids[i] = board.markers[i].id;
  } else {
    parameters_->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  }
}

std::optional<BoardView> BoardViewFinder::find(const cv::Mat& grey) {
  BoardView view;
  switch (board_.layout) {
    case Board::Layout::Chessboard:
      find_chessboard(grey, view);
      break;
    case Board::Layout::Charuco:
      find_charuco(grey, view);
      break;
    default:
      find_markers(grey, view);
      break;
  }
  if (view.seen_px.size() < fewest_points) return {};
  view.sharpness = sharpness(grey, view.seen_px);
  return view;
}

void BoardViewFinder::find_chessboard(const cv::Mat& grey, BoardView& view) const {
  // The search runs on a picture of about a thousand pixels, the corners are refined on the full one.
  const double scale = std::min(1.0, 1000.0 / std::max(grey.cols, grey.rows));
  cv::Mat small;
  cv::resize(grey, small, {}, scale, scale, cv::INTER_AREA);
  std::vector<cv::Point2f> corners;
  const cv::Size inner(board_.columns - 1, board_.rows - 1);
  if (!cv::findChessboardCorners(
          small, inner, corners,
          cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK)) {
    return;
  }
  double shortest = 1e9;
  for (cv::Point2f& corner : corners) {
    corner.x = static_cast<float>((corner.x + 0.5) / scale - 0.5);
    corner.y = static_cast<float>((corner.y + 0.5) / scale - 0.5);
    if (&corner != corners.data()) shortest = std::min(shortest, cv::norm(corner - *(&corner - 1)));
  }
  const int half = std::clamp(static_cast<int>(shortest / 3), 2, 11);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 40, 0.005});
  view.board_m = chess_m_;
  view.seen_px = std::move(corners);
}

void BoardViewFinder::find_charuco(const cv::Mat& grey, BoardView& view) const {
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(grey, dictionary_, markers, ids, parameters_);
  if (ids.empty()) return;
  std::vector<cv::Point2f> corners;
  std::vector<int> corner_ids;
  cv::aruco::interpolateCornersCharuco(markers, ids, grey, charuco_, corners, corner_ids);
  for (std::size_t i = 0; i < corner_ids.size(); ++i) {
    view.board_m.push_back(chess_m_[static_cast<std::size_t>(corner_ids[i])]);
    view.seen_px.push_back(corners[i]);
  }
}

void BoardViewFinder::find_markers(const cv::Mat& grey, BoardView& view) const {
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(grey, dictionary_, corners, ids, parameters_);
  for (const BoardMarker& marker : board_.markers) {
    // A marker seen twice is seen wrongly at least once.
    if (std::count(ids.begin(), ids.end(), marker.id) != 1) continue;
    const auto at = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), marker.id) - ids.begin());
    for (std::size_t c = 0; c < 4; ++c) {
      view.board_m.push_back(to_cv(marker.corners_m[c]));
      view.seen_px.push_back(corners[at][c]);
    }
  }
}

}  // namespace rinkaku::track

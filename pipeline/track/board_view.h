#pragma once

#include <optional>
#include <vector>

#include <opencv2/aruco/charuco.hpp>
#include <opencv2/core.hpp>

#include "pipeline/track/board.h"

namespace rinkaku::track {

/// A calibration board as one picture shows it: points of the board (metres, z = 0) and where they are seen.
struct BoardView {
  std::vector<cv::Point3f> board_m;
  std::vector<cv::Point2f> seen_px;
  double sharpness = 0;  ///< larger is sharper; comparable between views of one camera and board
};

/// Finds a calibration board's points in grey pictures to a tenth of a pixel. One thread at a time.
class BoardViewFinder {
 public:
  explicit BoardViewFinder(const Board& board);

  /// Empty if fewer than 8 points are seen.
  std::optional<BoardView> find(const cv::Mat& grey);

 private:
  void find_chessboard(const cv::Mat& grey, BoardView& view) const;
  void find_charuco(const cv::Mat& grey, BoardView& view) const;
  void find_markers(const cv::Mat& grey, BoardView& view) const;

  Board board_;
  std::vector<cv::Point3f> chess_m_;
  cv::Ptr<cv::aruco::Dictionary> dictionary_;
  cv::Ptr<cv::aruco::CharucoBoard> charuco_;
  cv::Ptr<cv::aruco::DetectorParameters> parameters_;
};

}  // namespace rinkaku::track

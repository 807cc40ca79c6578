#pragma once

#include <array>
#include <optional>
#include <set>
#include <vector>

#include <opencv2/aruco.hpp>

namespace rinkaku::track {

/// Which marker a quadrilateral shows, as far as its cells tell.
struct SoftMatch {
  int id = 0;
  int turn = 0;          ///< the marker's own top left is the quadrilateral's corner of this index
  double score = 0;      ///< correlation of the cells with the marker's, 1 is perfect
  double runner_up = 0;  ///< the best score of any other marker of the dictionary
};

/// Reads markers that bit by bit can't be read any more: blurred, badly lit, small. The brightness of every cell
/// is correlated with all markers of the dictionary at once, so that doubtful cells count little (maximum likelihood
/// under even noise and any contrast) where a bit reader must decide each. Keeps scratch memory; one thread at a time.
class SoftDecoder {
 public:
  explicit SoftDecoder(const cv::Ptr<cv::aruco::Dictionary>& dictionary);

  /// The best match of a quadrilateral (corners in pixels, clockwise) if it is one of `wanted` and scores `least` or
  /// more.
  std::optional<SoftMatch> match(const cv::Mat& grey, const std::vector<cv::Point2f>& quad, const std::set<int>& wanted,
                                 double least);

 private:
  double score(int id, int turn) const;

  int cells_;                               // along a side, the border included
  std::vector<std::vector<float>> turned_;  // by 4 id + turn: cells with mean 0 and length 1
  std::vector<float> seen_;
};

}  // namespace rinkaku::track

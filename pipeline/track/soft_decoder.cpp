#include "pipeline/track/soft_decoder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace rinkaku::track {
namespace {

// A cell's outer quarter is blurred into its neighbours.
constexpr double within_cell[] = {0.3, 0.5, 0.7};
// Less contrast than this, as a sum over these points, is noise.
constexpr double least_contrast = 4 * 9;

// Mean 0 and length 1; false if there is nothing but an even grey.
bool normalise(std::vector<float>& cells, double least_deviation) {
  const float mean = std::accumulate(cells.begin(), cells.end(), 0.0F) / static_cast<float>(cells.size());
  double squares = 0;
  for (float& cell : cells) {
    cell -= mean;
    squares += static_cast<double>(cell) * cell;
  }
  if (squares < least_deviation * least_deviation * static_cast<double>(cells.size())) return false;
  for (float& cell : cells) cell = static_cast<float>(cell / std::sqrt(squares));
  return true;
}

}  // namespace

SoftDecoder::SoftDecoder(const cv::Ptr<cv::aruco::Dictionary>& dictionary) : cells_(dictionary->markerSize + 2) {
  const int bits = dictionary->markerSize, ids = dictionary->bytesList.rows;
  turned_.reserve(static_cast<std::size_t>(ids) * 4);
  for (int id = 0; id < ids; ++id) {
    cv::Mat whole = cv::Mat::zeros(cells_, cells_, CV_8U);
    cv::aruco::Dictionary::getBitsFromByteList(dictionary->bytesList.rowRange(id, id + 1), bits)
        .copyTo(whole(cv::Rect(1, 1, bits, bits)));
    for (int turn = 0; turn < 4; ++turn) {
      auto& cells = turned_.emplace_back(whole.begin<std::uint8_t>(), whole.end<std::uint8_t>());
      normalise(cells, 0);
      cv::Mat next;
      cv::rotate(whole, next, cv::ROTATE_90_CLOCKWISE);
      whole = next;
    }
  }
}

double SoftDecoder::score(int id, int turn) const {
  const auto& cells = turned_[static_cast<std::size_t>(4 * id + turn)];
  return std::inner_product(seen_.begin(), seen_.end(), cells.begin(), 0.0F);
}

std::optional<SoftMatch> SoftDecoder::match(const cv::Mat& grey, const std::vector<cv::Point2f>& quad,
                                            const std::set<int>& wanted, double least) {
  const float side = static_cast<float>(cells_);
  const cv::Matx33d picture_from_cells =
      cv::getPerspectiveTransform(std::vector<cv::Point2f>{{0, 0}, {side, 0}, {side, side}, {0, side}}, quad);
  const auto brightness = [&](double column, double row) {
    const cv::Vec3d p = picture_from_cells * cv::Vec3d(column, row, 1);
    const int x = std::clamp(cvRound(p[0] / p[2]), 0, grey.cols - 1);
    const int y = std::clamp(cvRound(p[1] / p[2]), 0, grey.rows - 1);
    return static_cast<float>(grey.at<std::uint8_t>(y, x));
  };
  seen_.clear();
  for (int row = 0; row < cells_; ++row) {
    for (int column = 0; column < cells_; ++column) {
      float sum = 0;
      for (const double v : within_cell) {
        for (const double u : within_cell) sum += brightness(column + u, row + v);
      }
      seen_.push_back(sum);
    }
  }
  if (!normalise(seen_, least_contrast)) return {};

  SoftMatch best{-1, 0, least, -1};
  for (const int id : wanted) {
    for (int turn = 0; turn < 4; ++turn) {
      if (const double s = score(id, turn); s >= best.score) best = {id, turn, s, -1};
    }
  }
  if (best.id < 0) return {};
  for (int id = 0; id < static_cast<int>(turned_.size() / 4); ++id) {
    if (id == best.id) continue;
    for (int turn = 0; turn < 4; ++turn) best.runner_up = std::max(best.runner_up, score(id, turn));
  }
  if (best.runner_up >= best.score) return {};
  return best;
}

}  // namespace rinkaku::track

#include "pipeline/track/calibrate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/track/board_view.h"
#include "pipeline/track/luma.h"
#include "pipeline/track/opencv_quiet.h"

namespace rinkaku::track {
namespace {

constexpr std::size_t fewest_views = 4;
constexpr std::size_t most_kept = 400;  // before choosing; bounds memory and the choice's cost

// What makes one view different from another: the board's place, size and tilt in the picture, each about 0 to 1.
using Signature = std::array<double, 5>;

Signature signature(const BoardView& view, cv::Size picture) {
  // The map from board to picture at the board's middle tells size and tilt.
  std::vector<cv::Point2f> flat;
  for (const cv::Point3f& p : view.board_m) flat.emplace_back(p.x, p.y);
  const cv::Mat found = cv::findHomography(flat, view.seen_px);
  const cv::Matx33d h = found.empty() ? cv::Matx33d::eye() : cv::Matx33d(found);
  cv::Point2d middle(0, 0);
  for (const cv::Point2f& p : view.seen_px) middle += cv::Point2d(p);
  middle *= 1.0 / static_cast<double>(view.seen_px.size());
  cv::Point2d on_board(0, 0);
  for (const cv::Point3f& p : view.board_m) on_board += cv::Point2d(p.x, p.y);
  on_board *= 1.0 / static_cast<double>(view.board_m.size());
  const double w = h(2, 0) * on_board.x + h(2, 1) * on_board.y + h(2, 2);
  const double size = std::sqrt(cv::boundingRect(view.seen_px).area() / static_cast<double>(picture.area()));
  // Perspective: how much nearer one end of the board is than the other.
  double widest = 0;
  for (const cv::Point3f& p : view.board_m) widest = std::max(widest, cv::norm(cv::Point2d(p.x, p.y) - on_board));
  return {middle.x / picture.width, middle.y / picture.height, size, 2 * h(2, 0) / w * widest,
          2 * h(2, 1) / w * widest};
}

double distance(const Signature& a, const Signature& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

// Sharp views as unlike one another as can be: each next one is the farthest from all chosen (Gonzalez 1985).
std::vector<BoardView> choose(std::vector<BoardView> views, cv::Size picture, int most) {
  std::vector<double> sharp;
  for (const BoardView& view : views) sharp.push_back(view.sharpness);
  std::nth_element(sharp.begin(), sharp.begin() + static_cast<std::ptrdiff_t>(sharp.size() / 2), sharp.end());
  const double median = sharp[sharp.size() / 2];
  // Half the median sharpness is motion blur; steep and small views lie between.
  std::erase_if(views, [&](const BoardView& view) { return view.sharpness < 0.5 * median; });

  std::vector<Signature> signatures;
  for (const BoardView& view : views) signatures.push_back(signature(view, picture));
  const std::size_t count = std::min(views.size(), static_cast<std::size_t>(most));
  std::vector<double> apart(views.size(), std::numeric_limits<double>::infinity());
  std::vector<BoardView> chosen;
  std::size_t next = static_cast<std::size_t>(
      std::max_element(views.begin(), views.end(),
                       [](const BoardView& a, const BoardView& b) { return a.seen_px.size() < b.seen_px.size(); }) -
      views.begin());
  while (chosen.size() < count) {
    chosen.push_back(views[next]);
    for (std::size_t i = 0; i < views.size(); ++i)
      apart[i] = std::min(apart[i], distance(signatures[i], signatures[next]));
    next = static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
    if (!(apart[next] > 0.01)) break;  // the rest are repetitions
  }
  return chosen;
}

struct Fit {
  double rms_px = 0;
  cv::Mat matrix, distortion;
  std::vector<cv::Mat> rotations, translations;
  std::vector<double> view_rms_px;
};

Fit fit(const std::vector<BoardView>& views, cv::Size picture, int flags) {
  std::vector<std::vector<cv::Point3f>> board;
  std::vector<std::vector<cv::Point2f>> seen;
  for (const BoardView& view : views) {
    board.push_back(view.board_m);
    seen.push_back(view.seen_px);
  }
  Fit result;
  cv::Mat intrinsics_deviation, pose_deviation, errors;
  result.rms_px = cv::calibrateCamera(board, seen, picture, result.matrix, result.distortion, result.rotations,
                                      result.translations, intrinsics_deviation, pose_deviation, errors, flags);
  for (int i = 0; i < errors.rows; ++i) result.view_rms_px.push_back(errors.at<double>(i, 0));
  return result;
}

// Fits, leaving out views that fit far worse than the rest.
Fit fit_robustly(std::vector<BoardView>& views, cv::Size picture) {
  Fit best = fit(views, picture, cv::CALIB_FIX_K3);
  for (int round = 0; round < 3; ++round) {
    std::vector<double> sorted = best.view_rms_px;
    std::sort(sorted.begin(), sorted.end());
    // A tenth of a pixel is as well as corners are found: nothing below three of these is an outlier.
    const double limit = std::max(0.3, 2.5 * sorted[sorted.size() / 2]);
    std::vector<BoardView> kept;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (best.view_rms_px[i] <= limit) kept.push_back(views[i]);
    }
    if (kept.size() == views.size() || kept.size() < fewest_views) break;
    views = std::move(kept);
    best = fit(views, picture, cv::CALIB_FIX_K3);
  }
  // One parameter more always fits a little better; a twentieth better is not chance with hundreds of corners.
  if (Fit full = fit(views, picture, 0); full.rms_px < 0.95 * best.rms_px) best = std::move(full);
  return best;
}

std::string percent(double part) { return std::to_string(static_cast<int>(std::lround(part * 100))) + " %"; }

void judge(Calibration& result) {
  if (result.views < 10) {
    result.warnings.push_back("only " + std::to_string(result.views) +
                              " views were used; film the board from 15 or more different places");
  }
  if (result.coverage < 0.5) {
    result.warnings.push_back("the board covered only " + percent(result.coverage) +
                              " of the picture; bring it near, and into the corners");
  }
  if (result.most_tilt_deg < 20) {
    result.warnings.push_back("the board was always nearly parallel to the picture (at most " +
                              std::to_string(static_cast<int>(result.most_tilt_deg)) +
                              " degrees); tilt it by 30 to 45 degrees, or the focal length is a guess");
  }
  if (result.rms_px > 1) {
    result.warnings.push_back("the corners fit only to " + std::to_string(result.rms_px).substr(0, 4) +
                              " px; keep the board flat and still, light it well, and check its sizes");
  }
}

Calibration describe(const Fit& best, const std::vector<BoardView>& views, cv::Size picture) {
  Calibration result;
  CameraModel& camera = result.camera;
  camera.width_px = picture.width;
  camera.height_px = picture.height;
  camera.fx_px = best.matrix.at<double>(0, 0);
  camera.fy_px = best.matrix.at<double>(1, 1);
  camera.cx_px = best.matrix.at<double>(0, 2);
  camera.cy_px = best.matrix.at<double>(1, 2);
  for (std::size_t i = 0; i < std::min<std::size_t>(best.distortion.total(), 5); ++i) {
    camera.distortion[i] = best.distortion.ptr<double>()[i];
  }
  result.rms_px = best.rms_px;
  result.views = static_cast<int>(views.size());
  std::set<int> cells;
  for (const BoardView& view : views) {
    for (const cv::Point2f& p : view.seen_px) {
      const int column = std::clamp(static_cast<int>(10 * p.x / static_cast<float>(picture.width)), 0, 9);
      const int row = std::clamp(static_cast<int>(10 * p.y / static_cast<float>(picture.height)), 0, 9);
      cells.insert(10 * row + column);
    }
  }
  result.coverage = static_cast<double>(cells.size()) / 100;
  for (const cv::Mat& rotation : best.rotations) {
    cv::Matx33d matrix;
    cv::Rodrigues(rotation, matrix);
    const double tilt = std::acos(std::min(1.0, std::abs(matrix(2, 2)))) * 180 / std::numbers::pi;
    result.most_tilt_deg = std::max(result.most_tilt_deg, tilt);
  }
  return result;
}

bool sound(const CameraModel& camera) {
  const double sum = camera.fx_px + camera.fy_px + camera.cx_px + camera.cy_px + camera.distortion[0];
  return std::isfinite(sum) && camera.fx_px > 0 && camera.fy_px > 0;
}

}  // namespace

Calibration calibrate(const Board& board, const std::function<std::optional<Frame>()>& next,
                      const CalibrateOptions& options) {
  if (!board.is_flat()) {
    throw input_error(board.name, "a board for calibration must lie in one plane, z = 0",
                      "use a chessboard, charuco or grid board");
  }
  BoardViewFinder finder(board);
  std::vector<BoardView> views;
  cv::Mat scratch;
  cv::Size picture;
  int looked_at = 0, with_board = 0;
  double step_s = options.seconds_apart;
  std::optional<double> last_s;
  while (const std::optional<Frame> frame = next()) {
    const double time_s = frame->time_s();
    // Half a millisecond of slack: timestamps are rounded.
    if (last_s && time_s > *last_s && time_s < *last_s + step_s - 5e-4) continue;
    last_s = time_s;
    const cv::Size size(frame->format.width_px, frame->format.height_px);
    if (looked_at > 0 && size != picture) {
      throw input_error(board.name, "the pictures differ in size", "calibrate from pictures of one camera and mode");
    }
    picture = size;
    ++looked_at;
    auto view = with_opencv([&] { return finder.find(luma(*frame, scratch)); },
                            [](const std::string&) { return std::optional<BoardView>(); });
    if (!view) continue;
    ++with_board;
    views.push_back(std::move(*view));
    if (views.size() >= most_kept) {
      // A long film: every other view goes, and from here on every other frame.
      for (std::size_t i = 0; 2 * i < views.size(); ++i) views[i] = std::move(views[2 * i]);
      views.resize((views.size() + 1) / 2);
      step_s = std::max(2 * step_s, 0.1);
    }
  }
  const auto check_enough = [&](std::size_t count, const std::string& what) {
    if (count >= fewest_views) return;
    throw input_error(board.name,
                      what + " of " + std::to_string(looked_at) + " frames; at least " + std::to_string(fewest_views) +
                          " different views are needed",
                      board.layout == Board::Layout::Chessboard
                          ? "check that columns and rows count the squares, not the inner corners"
                          : "check the dictionary and the board's sizes, film it whole and from different sides");
  };
  check_enough(views.size(), "the board was seen in " + std::to_string(with_board));

  return with_opencv(
      [&] {
        views = choose(std::move(views), picture, options.most_views);
        check_enough(views.size(), "the board was seen in " + std::to_string(views.size()) + " different ways in " +
                                       std::to_string(with_board));
        const auto chosen = views.size();
        const Fit best = fit_robustly(views, picture);
        Calibration result = describe(best, views, picture);
        if (!sound(result.camera)) throw runtime_failure(board.name, "no camera explains what was seen");
        result.frames_looked_at = looked_at;
        result.frames_with_board = with_board;
        result.views_rejected = static_cast<int>(chosen - views.size());
        judge(result);
        return result;
      },
      [&](const std::string& message) -> Calibration {
        throw runtime_failure(board.name, "no camera explains what was seen (" + message + ")",
                              "film the board from more sides");
      });
}

}  // namespace rinkaku::track

#include "pipeline/track/edge_refiner.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace rinkaku::track {
namespace {

constexpr double step_px = 0.5;           // along the normal
constexpr double least_contrast = 4;      // grey levels over 2 px; less is noise
constexpr std::size_t fewest_points = 6;  // a side with fewer is not seen

// Bilinear; NaN outside the picture.
double brightness(const cv::Mat& grey, const cv::Point2d& p) {
  const int x = cvFloor(p.x), y = cvFloor(p.y);
  if (x < 0 || y < 0 || x + 1 >= grey.cols || y + 1 >= grey.rows) return std::nan("");
  const double u = p.x - x, v = p.y - y;
  const auto *top = grey.ptr<std::uint8_t>(y) + x, *bottom = grey.ptr<std::uint8_t>(y + 1) + x;
  return (1 - v) * ((1 - u) * top[0] + u * top[1]) + v * ((1 - u) * bottom[0] + u * bottom[1]);
}

}  // namespace

EdgeRefiner::EdgeRefiner(const CameraModel& camera) : camera_(camera), max_radius_(max_undistorted_radius(camera)) {}

std::optional<EdgeRefiner::Line> EdgeRefiner::fit(double outlier) {
  Line line;
  // Total least squares; once more without the points that lie off.
  for (int round = 0; round < 3; ++round) {
    if (points_.size() < fewest_points) return {};
    glm::dvec2 middle(0);
    for (const glm::dvec2& p : points_) middle += p;
    middle /= static_cast<double>(points_.size());
    double xx = 0, xy = 0, yy = 0;
    for (const glm::dvec2& p : points_) {
      const glm::dvec2 d = p - middle;
      xx += d.x * d.x;
      xy += d.x * d.y;
      yy += d.y * d.y;
    }
    const double along = 0.5 * std::atan2(2 * xy, xx - yy);
    line = {-std::sin(along), std::cos(along), 0};
    line.c = line.a * middle.x + line.b * middle.y;
    const auto off = [&](const glm::dvec2& p) { return std::abs(line.a * p.x + line.b * p.y - line.c); };
    double squares = 0;
    for (const glm::dvec2& p : points_) squares += off(p) * off(p);
    const double limit = std::max(outlier, 2 * std::sqrt(squares / static_cast<double>(points_.size())));
    if (std::erase_if(points_, [&](const glm::dvec2& p) { return off(p) > limit; }) == 0) break;
  }
  return line;
}

std::optional<EdgeRefiner::Line> EdgeRefiner::side(const cv::Mat& grey, const cv::Point2d& from, const cv::Point2d& to,
                                                   double reach_px) {
  const cv::Point2d along = to - from;
  const double length = cv::norm(along);
  if (!(length > 4)) return {};
  const cv::Point2d outwards(along.y / length, -along.x / length);
  const int samples = std::clamp(static_cast<int>(length), 12, 40);
  const int steps = static_cast<int>(std::ceil(reach_px / step_px));
  // A difference over 2 px: as wide as a sharp picture's edge, and noise counts less.
  constexpr int span = static_cast<int>(1 / step_px);
  points_.clear();
  for (int i = 0; i < samples; ++i) {
    // Near its ends a side is bent by the blur of the corner.
    const cv::Point2d start = from + along * (0.1 + 0.8 * (i + 0.5) / samples);
    profile_.clear();
    for (int k = -steps - span; k <= steps + span; ++k)
      profile_.push_back(brightness(grey, start + outwards * (k * step_px)));
    const auto rise = [&](int k) {
      const auto at = static_cast<std::size_t>(k);
      return profile_[at + 2 * span] - profile_[at];
    };
    int best = -1;
    for (int k = 0; k <= 2 * steps; ++k) {
      if (rise(k) > (best < 0 ? least_contrast : rise(best))) best = k;  // false for NaN
    }
    if (best <= 0 || best >= 2 * steps) continue;
    const double before = rise(best - 1), peak = rise(best), after = rise(best + 1);
    const double bend = before - 2 * peak + after;
    if (!std::isfinite(bend) || !(bend < 0)) continue;
    const double k = best - steps + 0.5 * (before - after) / bend;
    const cv::Point2d edge = start + outwards * (k * step_px);
    if (const auto p = undistort(camera_, to_normalised(camera_, {edge.x, edge.y}), max_radius_)) points_.push_back(*p);
  }
  return fit(0.2 / camera_.fx_px);
}

std::optional<std::array<cv::Point2d, 4>> EdgeRefiner::refine(const cv::Mat& grey,
                                                              const std::array<cv::Point2d, 4>& rough, double cell_px) {
  std::array<Line, 4> sides;
  const double reach_px = std::clamp(0.5 * cell_px, 1.5, 8.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto line = side(grey, rough[i], rough[(i + 1) % 4], reach_px);
    if (!line) return {};
    sides[i] = *line;
  }
  std::array<cv::Point2d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Line &l = sides[(i + 3) % 4], &m = sides[i];
    const double det = l.a * m.b - l.b * m.a;
    if (!(std::abs(det) > 0.05)) return {};  // nearly parallel: seen edge-on
    const glm::dvec2 corner((l.c * m.b - l.b * m.c) / det, (l.a * m.c - l.c * m.a) / det);
    const glm::dvec2 px = to_pixels(camera_, distort(camera_, corner));
    corners[i] = {px.x, px.y};
    if (!(cv::norm(corners[i] - rough[i]) <= std::max(cell_px, 3.0))) return {};
  }
  return corners;
}

}  // namespace rinkaku::track

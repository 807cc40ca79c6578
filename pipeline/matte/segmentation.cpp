#include "pipeline/matte/segmentation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>

namespace rinkaku::matte {
namespace {

constexpr float least_likely = 0.7f;           // on the average over a person
constexpr double least_part = 0.008;           // of what is looked at
constexpr double small_piece = 0.05;           // of the largest piece: less belongs to nobody
constexpr int fringe_px = 4;                   // how far a piece's soft edge reaches, in the network's pixels
constexpr float nothing = 0.15f, all = 0.85f;  // likelihoods that are taken for certain

constexpr int least_part_px = 32;
constexpr int parts_across = 3, parts = parts_across * parts_across;

// Parts of half the picture's size that overlap by half.
PixelRect part_of(int width_px, int height_px, int index) {
  const int column = index % parts_across, row = index / parts_across;
  const int wide = width_px / 2, high = height_px / 2;
  return {column * (width_px - wide) / 2, row * (height_px - high) / 2, wide, high};
}

}  // namespace

// Leaves in likely_ what belongs to somebody.
void SegmentationMatte::keep_pieces(int largest) {
  const double least = small_piece * stats_.at<int>(largest, cv::CC_STAT_AREA);
  for (int y = 0; y < labels_.rows; ++y) {
    const int* label = labels_.ptr<int>(y);
    auto* out = inside_.ptr<std::uint8_t>(y);
    for (int x = 0; x < labels_.cols; ++x) {
      out[x] = label[x] != 0 && stats_.at<int>(label[x], cv::CC_STAT_AREA) >= least ? 255 : 0;
    }
  }
  cv::dilate(inside_, kept_, cv::getStructuringElement(cv::MORPH_RECT, {2 * fringe_px + 1, 2 * fringe_px + 1}));
  cv::bitwise_not(kept_, kept_);
  likely_.setTo(0, kept_);
}

// Where in the picture somebody is, if anybody is there. Leaves likely_.
std::optional<PixelRect> SegmentationMatte::look(const Picture& picture, const PixelRect& part) {
  find_(picture, part, likely_);
  cv::compare(likely_, 0.5, inside_, cv::CMP_GT);
  const int count = cv::connectedComponentsWithStats(inside_, labels_, stats_, centres_, 8, CV_32S);
  int largest = 0;
  for (int i = 1; i < count; ++i) {
    if (largest == 0 || stats_.at<int>(i, cv::CC_STAT_AREA) > stats_.at<int>(largest, cv::CC_STAT_AREA)) largest = i;
  }
  if (largest == 0) return {};
  const int area = stats_.at<int>(largest, cv::CC_STAT_AREA);
  if (area < least_part * static_cast<double>(likely_.total())) return {};
  cv::compare(labels_, largest, kept_, cv::CMP_EQ);
  if (cv::mean(likely_, kept_)[0] < least_likely) return {};
  keep_pieces(largest);
  const cv::Rect found = cv::boundingRect(inside_);
  const double across = static_cast<double>(part.width_px) / likely_.cols;
  const double down = static_cast<double>(part.height_px) / likely_.rows;
  const int left = part.x_px + static_cast<int>(found.x * across), top = part.y_px + static_cast<int>(found.y * down);
  return PixelRect{left, top, part.x_px + static_cast<int>(std::ceil((found.x + found.width) * across)) - left,
                   part.y_px + static_cast<int>(std::ceil((found.y + found.height) * down)) - top};
}

std::optional<PixelRect> SegmentationMatte::search(const Picture& picture) {
  const int width = picture.width_px(), height = picture.height_px();
  if (const auto found = look(picture, {0, 0, width, height})) return found;
  if (std::min(width, height) < 2 * least_part_px) return {};
  std::optional<PixelRect> best;
  const auto area = [](const PixelRect& rect) { return std::int64_t{rect.width_px} * rect.height_px; };
  for (int i = 0; i < (is_first_ ? parts : 1); ++i) {
    const auto found = look(picture, part_of(width, height, next_part_));
    next_part_ = (next_part_ + 1) % parts;
    if (found && (!best || area(*found) > area(*best))) best = found;
  }
  return best;
}

void SegmentationMatte::write(const PixelRect& part, Matte& matte) {
  likely_.convertTo(levels_, CV_8U, 255 / (all - nothing), -255 * nothing / (all - nothing));
  cv::Mat out(part.height_px, part.width_px, CV_8U, matte.alpha_row(part.y_px) + part.x_px,
              static_cast<std::size_t>(matte.width_px));
  cv::resize(levels_, out, out.size(), 0, 0, cv::INTER_LINEAR);
  find_rect(matte);
}

void SegmentationMatte::estimate(const Frame& frame, Matte& matte) {
  begin_matte(frame, matte);
  const Picture& picture = reader_.read(frame);
  std::optional<PixelRect> found;
  PixelRect looked_at = box_.rect();
  if (!box_.empty()) found = look(picture, looked_at);
  if (!found) {
    box_.lose();
    if (const auto somewhere = search(picture)) {
      box_.begin(*somewhere, {matte.width_px, matte.height_px});
      looked_at = box_.rect();
      found = look(picture, looked_at);
      if (!found) box_.lose();
    }
  }
  is_first_ = false;
  if (!found) return;
  write(looked_at, matte);
  box_.follow(*found);
}

}  // namespace rinkaku::matte

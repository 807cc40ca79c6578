#include "pipeline/matte/crop_box.h"

#include <algorithm>
#include <cmath>

namespace rinkaku::matte {
namespace {

constexpr double margin = 0.1;  // of the thing's longer side
constexpr double outwards = 0.6, inwards = 0.15;
constexpr double aspects[] = {9.0 / 16, 1, 16.0 / 9};  // width over height

// What a box of w x h grows to, in area, to have a shape.
double area_as(int shape, double w, double h) {
  const double wide = std::max(w, h * aspects[shape]);
  return wide * wide / aspects[shape];
}

// An interval of at least `length` around the middle of [low, high], moved into [0, end]; all of it if it is longer.
void lengthen(double& low, double& high, double length, double end) {
  length = std::min(length, end);
  const double middle = (low + high) / 2;
  low = std::clamp(middle - length / 2, 0.0, end - length);
  high = low + length;
}

}  // namespace

CropBox::Sides CropBox::with_margin(const PixelRect& thing) {
  const double around = margin * std::max(thing.width_px, thing.height_px);
  return {thing.x_px - around, thing.y_px - around, thing.right_px() + around, thing.bottom_px() + around};
}

void CropBox::begin(const PixelRect& thing, const cv::Size& whole) {
  whole_ = whole;
  shape_ = -1;
  set(with_margin(thing));
}

void CropBox::follow(const PixelRect& thing) {
  Sides wish = with_margin(thing);
  const double further = margin * 2 * std::max(thing.width_px, thing.height_px);
  if (thing.x_px <= rect_.x_px + 1) wish.left -= further;
  if (thing.y_px <= rect_.y_px + 1) wish.top -= further;
  if (thing.right_px() >= rect_.right_px() - 1) wish.right += further;
  if (thing.bottom_px() >= rect_.bottom_px() - 1) wish.bottom += further;
  const auto low = [](double from, double to) { return from + (to < from ? outwards : inwards) * (to - from); };
  const auto high = [](double from, double to) { return from + (to > from ? outwards : inwards) * (to - from); };
  set({low(sides_.left, wish.left), low(sides_.top, wish.top), high(sides_.right, wish.right),
       high(sides_.bottom, wish.bottom)});
}

void CropBox::set(const Sides& sides) {
  sides_ = {std::max(sides.left, 0.0), std::max(sides.top, 0.0), std::min<double>(sides.right, whole_.width),
            std::min<double>(sides.bottom, whole_.height)};
  Sides box = sides_;
  const double w = box.right - box.left, h = box.bottom - box.top;
  int best = 0;
  for (int i = 1; i < 3; ++i) best = area_as(i, w, h) < area_as(best, w, h) ? i : best;
  constexpr double clearly = 1.15;
  if (shape_ < 0 || area_as(best, w, h) * clearly < area_as(shape_, w, h)) shape_ = best;
  const double wide = std::max(w, h * aspects[shape_]);
  lengthen(box.left, box.right, wide, whole_.width);
  lengthen(box.top, box.bottom, wide / aspects[shape_], whole_.height);
  const int left = static_cast<int>(box.left), top = static_cast<int>(box.top);
  rect_ = {left, top, std::min(whole_.width, static_cast<int>(std::ceil(box.right))) - left,
           std::min(whole_.height, static_cast<int>(std::ceil(box.bottom))) - top};
}

}  // namespace rinkaku::matte

#include "pipeline/matte/foreground.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "pipeline/matte/count.h"

namespace rinkaku::matte {
namespace {

void keep_within(const PixelRect& rect, Matte& matte) {
  const PixelRect kept = intersection(matte.rect, rect);
  for (int y = matte.rect.y_px; y < matte.rect.bottom_px(); ++y) {
    std::uint8_t* row = matte.alpha_row(y);
    const bool outside = y < kept.y_px || y >= kept.bottom_px() || kept.empty();
    std::fill(row + matte.rect.x_px, row + (outside ? matte.rect.right_px() : kept.x_px), std::uint8_t{0});
    if (!outside) std::fill(row + kept.right_px(), row + matte.rect.right_px(), std::uint8_t{0});
  }
  matte.rect = kept.empty() ? PixelRect{} : kept;
}

}  // namespace

Foreground::Foreground(std::vector<std::unique_ptr<MatteEstimator>> estimators, const ForegroundOptions& options)
    : estimators_(std::move(estimators)),
      options_(options),
      own_colours_known_(estimators_.size() == 1 && estimators_.front()->knows_behind() && !options.refine) {
  ++counters().things;
  if (options.refine) refinement_.emplace();
  if (options.line) line_.emplace(*options.line);
}

void Foreground::combine(const Matte& with, Matte& matte) const {
  using Combine = ForegroundOptions::Combine;
  for (std::size_t i = 0; i < matte.alpha.size(); ++i) {
    std::uint8_t& a = matte.alpha[i];
    const std::uint8_t b = with.alpha[i];
    switch (options_.combine) {
      case Combine::Maximum:
        a = std::max(a, b);
        break;
      case Combine::Minimum:
        a = std::min(a, b);
        break;
      case Combine::Confidence:
        if (std::abs(2 * b - 255) > std::abs(2 * a - 255)) a = b;
        break;
    }
  }
}

void Foreground::find_alpha(const Frame& frame, Matte& matte) {
  estimators_.front()->estimate(frame, matte);
  for (std::size_t i = 1; i < estimators_.size(); ++i) {
    estimators_[i]->estimate(frame, other_);
    combine(other_, matte);
  }
  if (estimators_.size() > 1) find_rect(matte);
  if (options_.within) keep_within(*options_.within, matte);
}

void Foreground::find(const Frame& frame, Matte& matte) {
  find_alpha(frame, matte);
  if (!own_colours_known_) {
    const Picture& picture = reader_.read(frame);
    if (refinement_) refinement_->refine(picture, matte);
    own_colours_.find(picture, matte);
  }
  if (line_) line_->draw(matte);
}

}  // namespace rinkaku::matte

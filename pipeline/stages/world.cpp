#include "pipeline/stages/world.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "pipeline/frame/error.h"
#include "pipeline/passes/composite/straight_alpha.h"

namespace rinkaku::pipeline {
namespace {

void fill(passes::Layer& layer, const std::array<double, 3>& colour) {
  std::uint8_t rgba[4] = {0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c) rgba[c] = static_cast<std::uint8_t>(std::lround(colour[c] * 255));
  for (std::size_t i = 0; i < layer.rgba.size(); i += 4) std::memcpy(layer.rgba.data() + i, rgba, 4);
}

}  // namespace

World::World(const BackgroundScene& scene, const source::Description& plate)
    : input_(scene.input), plate_is_live_(plate.live) {
  const PictureFormat& format = plate.format;
  picture_.rect = {0, 0, format.width_px, format.height_px};
  picture_.rgba.resize(static_cast<std::size_t>(format.width_px) * format.height_px * 4);
  if (scene.colour) {
    fill(picture_, *scene.colour);
    return;
  }
  const PictureFormat own = source::open(input_)->description().format;
  const double scale = std::max(static_cast<double>(format.width_px) / own.width_px,
                                static_cast<double>(format.height_px) / own.height_px);
  options_.convert_to =
      passes::rgba_format(std::max(format.width_px, static_cast<int>(std::lround(own.width_px * scale))),
                          std::max(format.height_px, static_cast<int>(std::lround(own.height_px * scale))), {1, 1});
  is_sequence_ = scene.is_sequence;
  open();
  read_ahead(0);
  if (!ahead_) throw input_error(input_, "it holds no picture", "give another background");
}

void World::open() { source_ = source::open(input_, options_); }

void World::show(const Frame& frame) {
  const PixelRect& rect = picture_.rect;
  const int left = (frame.format.width_px - rect.width_px) / 2, top = (frame.format.height_px - rect.height_px) / 2;
  for (int y = 0; y < rect.height_px; ++y) {
    std::uint8_t* out = picture_.rgba.data() + static_cast<std::size_t>(y) * rect.width_px * 4;
    std::memcpy(out, frame.planes[0].data + (top + y) * frame.planes[0].stride_bytes + left * 4,
                static_cast<std::size_t>(rect.width_px) * 4);
    for (int x = 0; x < rect.width_px; ++x) out[4 * x + 3] = 255;
  }
}

// The frame after the one that is ahead; the first again after the last. Of a single picture there is no other. Rounds
// that would be over by now are left out.
void World::read_ahead(double now) {
  const bool first = !ahead_;
  double length = ahead_at_ + lasts_ - began_at_;
  ahead_ = source_->next();
  if (ahead_) {
    moves_ = !first;
  } else if (moves_) {
    open();
    ahead_ = source_->next();
    // Containers round times: rounds of an even rate are whole frames long.
    const double even = is_sequence_ ? length : std::round(length * rate_) / rate_;
    if (std::abs(length - even) < 0.0011) length = even;
    began_at_ += length * std::max(1.0, std::floor((now - began_at_) / length));
  }
  if (!ahead_) return;
  const source::Description& of = source_->description();
  if (of.frame_rate.num > 0) rate_ = of.frame_rate.value();
  const double time_s = ahead_->time_s() - of.first_time_s();
  ahead_at_ = began_at_ + (is_sequence_ ? static_cast<double>(ahead_->number) : time_s);
  lasts_ = is_sequence_ ? 1 : 1 / rate_;
}

const passes::Layer& World::at(double time_s, std::int64_t frame) {
  // Containers round times, to a millisecond at worst.
  const double now = is_sequence_ ? static_cast<double>(frame) : time_s + 0.001;
  // What is slower to decode than a camera films falls behind, and doesn't hold it up.
  constexpr int most_live = 3;
  std::optional<Frame> shown;
  for (int read = 0; ahead_ && ahead_at_ <= now && !(plate_is_live_ && read == most_live); ++read) {
    shown = *ahead_;
    read_ahead(now);
  }
  if (shown) show(*shown);
  return picture_;
}

}  // namespace rinkaku::pipeline

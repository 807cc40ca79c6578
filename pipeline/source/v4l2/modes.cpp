#include "pipeline/source/v4l2/modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <tuple>
#include <utility>

#include <linux/videodev2.h>

namespace rinkaku::source::v4l2 {
namespace {

// What nobody asked about: fluent, and no larger than it can be drawn at that rate without a graphics card.
constexpr int usual_width_px = 1280, usual_height_px = 720;
constexpr double usual_rate = 30;

constexpr std::array<std::pair<int, int>, 8> usual_sizes{
    {{1920, 1080}, {1280, 720}, {1024, 576}, {960, 540}, {800, 600}, {640, 480}, {640, 360}, {320, 240}}};

double per_second(const v4l2_fract& interval) {
  return interval.numerator == 0 ? 0 : static_cast<double>(interval.denominator) / interval.numerator;
}

Rational rate_of(const v4l2_fract& interval) {
  return {interval.denominator, std::max<std::int64_t>(1, interval.numerator)};
}

std::vector<Rational> rates_of(const Device& device, FourCc format, int width_px, int height_px) {
  std::vector<Rational> rates;
  v4l2_frmivalenum at{};
  at.pixel_format = format;
  at.width = static_cast<__u32>(width_px);
  at.height = static_cast<__u32>(height_px);
  for (at.index = 0; request(device.descriptor, VIDIOC_ENUM_FRAMEINTERVALS, &at) == 0; ++at.index) {
    if (at.type != V4L2_FRMIVAL_TYPE_DISCRETE) {
      const double slowest = per_second(at.stepwise.max), fastest = per_second(at.stepwise.min);
      for (const int rate : {60, 50, 30, 25, 15}) {
        if (slowest <= rate && rate <= fastest) rates.push_back({rate, 1});
      }
      if (rates.empty()) rates.push_back(rate_of(at.stepwise.min));
      break;
    }
    rates.push_back(rate_of(at.discrete));
  }
  std::sort(rates.begin(), rates.end(), [](Rational a, Rational b) { return a.value() > b.value(); });
  return rates;
}

void add_sizes(const Device& device, FourCc format, std::vector<Mode>& modes) {
  const auto add = [&](int width_px, int height_px) {
    modes.push_back({format, width_px, height_px, rates_of(device, format, width_px, height_px)});
  };
  v4l2_frmsizeenum at{};
  at.pixel_format = format;
  const std::size_t before = modes.size();
  for (at.index = 0; request(device.descriptor, VIDIOC_ENUM_FRAMESIZES, &at) == 0; ++at.index) {
    if (at.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
      add(static_cast<int>(at.discrete.width), static_cast<int>(at.discrete.height));
      continue;
    }
    const v4l2_frmsize_stepwise& s = at.stepwise;
    const auto fits = [](int value, __u32 least, __u32 most, __u32 step) {
      const auto v = static_cast<__u32>(value);
      return least <= v && v <= most && (step == 0 || (v - least) % step == 0);
    };
    for (const auto& [width, height] : usual_sizes) {
      if (fits(width, s.min_width, s.max_width, s.step_width) &&
          fits(height, s.min_height, s.max_height, s.step_height)) {
        add(width, height);
      }
    }
    break;
  }
  if (modes.size() > before) return;
  // It tells no sizes: the one that is set.
  v4l2_format set{};
  set.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (request(device.descriptor, VIDIOC_G_FMT, &set) == 0) {
    add(static_cast<int>(set.fmt.pix.width), static_cast<int>(set.fmt.pix.height));
  }
}

Rational nearest_rate(const Mode& mode, double wanted) {
  if (mode.rates.empty()) return {0, 1};
  return *std::min_element(mode.rates.begin(), mode.rates.end(), [wanted](Rational a, Rational b) {
    return std::abs(a.value() - wanted) < std::abs(b.value() - wanted);
  });
}

// The smaller the better, the first difference decides.
using Distance = std::tuple<long, double, int>;

Distance distance(const Mode& mode, const ModeWish& wish, Rational rate) {
  const bool size_wished = wish.width_px > 0;
  const int width = size_wished ? wish.width_px : usual_width_px;
  const int height = size_wished ? wish.height_px : usual_height_px;
  long size =
      std::labs(static_cast<long>(mode.width_px) - width) + std::labs(static_cast<long>(mode.height_px) - height);
  if (!size_wished && (mode.width_px > width || mode.height_px > height)) size += 100'000;
  const double wanted = wish.rate.num > 0 ? wish.rate.value() : usual_rate;
  // A rate that isn't told may be any; half a frame a second is no difference.
  const double off = rate.num == 0 ? 0 : std::floor(std::abs(rate.value() - wanted) * 2);
  const auto& codes = readable_formats();
  const auto cost = static_cast<int>(std::find(codes.begin(), codes.end(), mode.format) - codes.begin());
  return {size, off, cost};
}

}  // namespace

std::vector<Mode> modes_of(const Device& device) {
  std::vector<Mode> modes;
  v4l2_fmtdesc at{};
  at.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (at.index = 0; request(device.descriptor, VIDIOC_ENUM_FMT, &at) == 0; ++at.index) {
    add_sizes(device, at.pixelformat, modes);
  }
  return modes;
}

std::optional<Choice> best_choice(const std::vector<Mode>& modes, const ModeWish& wish) {
  std::optional<Choice> best;
  std::optional<Distance> least;
  for (const Mode& mode : modes) {
    if (!readable(mode.format) || (wish.format != 0 && mode.format != wish.format)) continue;
    const Rational rate = nearest_rate(mode, wish.rate.num > 0 ? wish.rate.value() : usual_rate);
    const Distance here = distance(mode, wish, rate);
    if (least && *least <= here) continue;
    least = here;
    best = Choice{mode.format, mode.width_px, mode.height_px, wish.rate.num > 0 ? wish.rate : rate};
  }
  return best;
}

}  // namespace rinkaku::source::v4l2

#include "water/particles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

#include "water/scatter.h"

namespace rinkaku::water {
namespace {

// Strokes that drift freely scatter by the square root of what is wanted. Only a plot that is emptier or fuller than
// that by these factors is seen to, so that few have to come and go.
double fewest(double wanted, double deviations) { return wanted - deviations * std::sqrt(wanted); }
constexpr double few = 1.0, very_few = 1.8, many = 1.5;

std::size_t capacity(const Plots& plots, const ParticleOptions& options) {
  std::size_t wanted = 0;
  for (const Plots::Plot& p : plots.plots()) wanted += static_cast<std::size_t>(p.strokes);
  // Room for plots that are fuller than they want, and for what fades or rests.
  const double turnover = 0.01 * (options.fade_frames + options.rest_frames);
  return static_cast<std::size_t>(static_cast<double>(wanted) * (1.6 + turnover)) + 256;
}

}  // namespace

Particles::Particles(const Surface& surface, const Plots& plots, Flow& flow, const ParticleOptions& options)
    : surface_(surface), plots_(plots), flow_(flow), options_(options), list_(capacity(plots, options)) {
  free_.resize(list_.size());
  std::iota(free_.begin(), free_.end(), 0u);
  free_count_ = free_.size();
  for (Particle& p : list_) p.free_since = -options_.rest_frames;
  count_.assign(plots.plots().size(), 0);
  first_.assign(plots.plots().size(), -1);
  next_.assign(list_.size(), -1);
  flow_.set_frame(0);
  for (std::size_t i = 0; i < plots.plots().size(); ++i) {
    for (int k = 0; k < plots.plots()[i].strokes; ++k) bear(static_cast<int>(i), 1);
  }
  count();
}

void Particles::advance() {
  flow_.set_frame(static_cast<double>(frame_));
  ++frame_;
  census_ = {};
  carry();
  count();
  thin_out();
  fill_up();
}

void Particles::carry() {
  const float fade = 1.0f / static_cast<float>(options_.fade_frames);
  for (std::size_t i = 0; i < list_.size(); ++i) {
    Particle& p = list_[i];
    if (p.state == Particle::State::Free) continue;
    carry_along(flow_, surface_, options_.seconds_per_frame, p.at, p.velocity);
    if (p.state == Particle::State::Alive) {
      p.opacity = std::min(p.opacity + fade, 1.0f);
    } else {
      p.opacity -= fade;
      if (p.opacity > 1e-6f) continue;
      p.opacity = 0;
      p.state = Particle::State::Free;
      p.free_since = frame_;
      free_[(free_first_ + free_count_++) % free_.size()] = static_cast<std::uint32_t>(i);
    }
  }
}

void Particles::count() {
  std::fill(count_.begin(), count_.end(), 0);
  std::fill(first_.begin(), first_.end(), -1);
  census_.alive = census_.leaving = 0;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    Particle& p = list_[i];
    if (p.state == Particle::State::Leaving) ++census_.leaving;
    if (p.state != Particle::State::Alive) continue;
    const int plot = plots_.find(p.at);
    // Over the rim of the plots is not yet over the border: ask that where it is near.
    if (plot == Plots::unseen || (plot == Plots::none && !surface_.contains(p.at))) {
      p.state = Particle::State::Leaving;
      ++census_.leaving;
      continue;
    }
    ++census_.alive;
    if (plot < 0) continue;
    next_[i] = first_[plot];
    first_[plot] = static_cast<std::int32_t>(i);
    ++count_[plot];
  }
}

void Particles::thin_out() {
  for (std::size_t plot = 0; plot < count_.size(); ++plot) {
    const double wanted = plots_.plots()[plot].wanted, most = wanted + many * std::sqrt(wanted) + 1;
    while (count_[plot] > most) {
      // The youngest goes: what has been there long is what the eye follows.
      std::int32_t youngest = -1;
      for (std::int32_t i = first_[plot]; i >= 0; i = next_[i]) {
        if (list_[i].state != Particle::State::Alive) continue;
        if (youngest < 0 || list_[i].serial > list_[youngest].serial) youngest = i;
      }
      list_[youngest].state = Particle::State::Leaving;
      --count_[plot];
      --census_.alive;
      ++census_.leaving;
    }
  }
}

double Particles::inflow() const {
  double strokes = 0;
  for (const Plots::Rim& rim : plots_.rim()) {
    strokes += std::max(0.0, glm::dot(flow_.velocity(rim.at), rim.inwards)) * rim.per_m2;
  }
  return strokes * options_.seconds_per_frame;
}

void Particles::fill_up() {
  census_.flowed_in = inflow();
  double wanted = 0;
  for (const Plots::Plot& p : plots_.plots()) wanted += p.strokes;
  const double a_frame = options_.births_per_frame * wanted + census_.flowed_in;
  allowance_ = std::min(allowance_ + a_frame, a_frame + 1);
  const std::size_t n = count_.size();
  if (n == 0) return;
  // The emptiest first; plots take turns in being asked first.
  const std::size_t begin = static_cast<std::size_t>(frame_) * 7919 % n;
  for (const double deviations : {very_few, few}) {
    for (std::size_t k = 0; k < n && allowance_ >= 1; ++k) {
      const std::size_t plot = (begin + k) % n;
      const double least = fewest(plots_.plots()[plot].wanted, deviations);
      while (count_[plot] < least && allowance_ >= 1) {
        if (!bear(static_cast<int>(plot), 0)) break;
        allowance_ -= 1;
        ++census_.births;
        ++census_.alive;
      }
    }
  }
}

bool Particles::bear(int plot, float opacity) {
  if (free_count_ == 0) return false;
  const std::uint32_t place = free_[free_first_];
  if (list_[place].free_since + options_.rest_frames > frame_) return false;
  const Plots::Plot& square = plots_.plots()[plot];
  // Of a few places, the one farthest from its neighbours.
  glm::dvec2 best{0};
  double most = -1;
  constexpr int tries = 24, choices = 5;
  for (int i = 0, found = 0; i < tries && found < choices; ++i) {
    const glm::dvec2 p =
        square.least + square.size_m * glm::dvec2(scattered(born_, 2 * i), scattered(born_, 2 * i + 1));
    if (plots_.find(p) != plot || !surface_.contains(p)) continue;
    ++found;
    double room = glm::length(square.size_m);
    for (std::int32_t k = first_[plot]; k >= 0; k = next_[k]) room = std::min(room, glm::distance(list_[k].at, p));
    if (room > most) best = p, most = room;
  }
  if (most < 0) {
    ++born_;
    return false;
  }
  free_first_ = (free_first_ + 1) % free_.size();
  --free_count_;
  Particle& p = list_[place];
  p.at = best;
  p.velocity = flow_.velocity(best);
  p.opacity = opacity;
  p.serial = born_++;
  p.state = Particle::State::Alive;
  next_[place] = first_[plot];
  first_[plot] = static_cast<std::int32_t>(place);
  ++count_[plot];
  return true;
}

}  // namespace rinkaku::water

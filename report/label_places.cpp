#include "report/label_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

namespace rinkaku::report {
namespace {

// Of a common sans serif, a little generous; bytes that only continue a character have no width.
constexpr double kLetterWidth = 0.55, kLetterHeight = 1.15;

glm::dvec2 half_size_of(const std::string& text, double font_px) {
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; });
  return glm::dvec2(static_cast<double>(letters) * kLetterWidth, kLetterHeight) * font_px / 2.0;
}

double overlap(const glm::dvec2& a, const glm::dvec2& a_half, const glm::dvec2& b, const glm::dvec2& b_half) {
  const glm::dvec2 in = a_half + b_half - glm::abs(a - b);
  return in.x > 0 && in.y > 0 ? in.x * in.y : 0;
}

// How long a part of a line runs within a box, roughly.
double length_within(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& middle, const glm::dvec2& half) {
  const double length = glm::length(b - a);
  const int steps = std::clamp(static_cast<int>(length / 3), 1, 400);
  int inside = 0;
  for (int i = 0; i <= steps; ++i) {
    const glm::dvec2 off = glm::abs(a + (b - a) * (static_cast<double>(i) / steps) - middle);
    inside += off.x < half.x && off.y < half.y ? 1 : 0;
  }
  return length * inside / (steps + 1);
}

double cost(const LabelPlace& place, const LabelField& field, const std::vector<LabelPlace>& placed) {
  const glm::dvec2 low = place.middle - place.half_size, high = place.middle + place.half_size;
  double sum = 0;
  for (int axis = 0; axis < 2; ++axis) {
    sum += 1e4 * std::max({0.0, field.least[axis] - low[axis], high[axis] - field.most[axis]});
  }
  for (const LabelPlace& other : placed) {
    sum += 30 * overlap(place.middle, place.half_size + 1.0, other.middle, other.half_size);
  }
  for (const glm::dvec2& mark : field.marks) {
    sum += 20 * overlap(place.middle, place.half_size, mark, glm::dvec2(field.mark_px));
  }
  for (const auto& line : field.lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      sum += length_within(line[i], line[i + 1], place.middle, place.half_size);
    }
  }
  return sum;
}

}  // namespace

std::vector<LabelPlace> place_labels(const std::vector<LabelWish>& wishes, const LabelField& field) {
  std::vector<LabelPlace> placed;
  constexpr int directions = 16;
  for (const LabelWish& wish : wishes) {
    LabelPlace best;
    double least = std::numeric_limits<double>::infinity();
    for (const double gap_px : {9.0, 16.0, 26.0, 40.0, 58.0, 80.0, 110.0}) {
      for (int i = 0; i < directions; ++i) {
        // To the right first, then left, above, below and between.
        constexpr int order[directions] = {0, 8, 4, 12, 2, 14, 6, 10, 1, 15, 7, 9, 3, 13, 5, 11};
        const double angle = 2 * std::numbers::pi * order[i] / directions;
        const glm::dvec2 way(std::cos(angle), -std::sin(angle));
        LabelPlace place;
        place.half_size = half_size_of(wish.text, field.font_px);
        place.middle = wish.at + way * (place.half_size + gap_px);
        place.far = gap_px > 20;
        const double price = cost(place, field, placed) + gap_px + 0.2 * i;
        if (price < least) least = price, best = place;
      }
    }
    placed.push_back(best);
  }
  return placed;
}

}  // namespace rinkaku::report

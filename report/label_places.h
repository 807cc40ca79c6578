#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace rinkaku::report {

/// A text that is to stand beside a point of a plot. Pixels, y down.
struct LabelWish {
  glm::dvec2 at{0};
  std::string text;
};

/// Where it came to stand.
struct LabelPlace {
  glm::dvec2 middle{0};
  glm::dvec2 half_size{0};  ///< of its box, by an estimate of the letters' widths
  bool far = false;         ///< so far off that a line should lead to its point
};

struct LabelField {
  glm::dvec2 least{0}, most{0};  ///< labels stay within
  double font_px = 12;
  std::vector<glm::dvec2> marks;               ///< middles of marks, which labels keep off
  double mark_px = 6;                          ///< their radius
  std::vector<std::vector<glm::dvec2>> lines;  ///< lines that labels had better keep off
};

/// Finds places for labels one after the other: of some dozens around each point the one that hides least, and of
/// equal ones the nearest. Cost: labels x (labels + marks + lines' parts), times dozens.
std::vector<LabelPlace> place_labels(const std::vector<LabelWish>& wishes, const LabelField& field);

}  // namespace rinkaku::report

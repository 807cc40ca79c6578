#include "report/label_places.h"

#include <random>

#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace rinkaku::report {
namespace {

bool overlap(const glm::dvec2& a, const glm::dvec2& a_half, const glm::dvec2& b, const glm::dvec2& b_half) {
  const glm::dvec2 off = glm::abs(a - b) - a_half - b_half;
  return off.x < 0 && off.y < 0;
}

TEST(LabelPlaces, LabelsOfACrowdHideNeitherEachOtherNorMarks) {
  std::mt19937 engine(3);
  LabelField field;
  field.most = {700, 400};
  std::vector<LabelWish> wishes;
  for (int i = 0; i < 14; ++i) {  // as many as the fullest plot has, in a corner of it
    wishes.push_back({{250 + engine() % 160, 120 + engine() % 120}, "1452 regions"});
    field.marks.push_back(wishes.back().at);
  }
  const std::vector<LabelPlace> places = place_labels(wishes, field);
  ASSERT_EQ(places.size(), wishes.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(overlap(places[i].middle, places[i].half_size, places[k].middle, places[k].half_size)) << i << k;
    }
    for (const glm::dvec2& mark : field.marks) {
      EXPECT_FALSE(overlap(places[i].middle, places[i].half_size, mark, {3, 3})) << i;
    }
  }
}

TEST(LabelPlaces, StayWithinTheField) {
  LabelField field;
  field.most = {200, 100};
  for (const LabelPlace& p : place_labels({{{198, 3}, "right above"}, {{2, 98}, "left below"}}, field)) {
    EXPECT_GE(p.middle.x - p.half_size.x, 0);
    EXPECT_LE(p.middle.x + p.half_size.x, 200);
    EXPECT_GE(p.middle.y - p.half_size.y, 0);
    EXPECT_LE(p.middle.y + p.half_size.y, 100);
  }
}

}  // namespace
}  // namespace rinkaku::report

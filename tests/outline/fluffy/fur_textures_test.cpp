#include "outline/fluffy/fur_textures.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace rinkaku::test {
namespace {

using fluffy::FurKind;

constexpr std::array kinds{FurKind::Fur, FurKind::Wool, FurKind::Down};

TEST(FurTexture, AllHeightsAreEquallyFrequent) {
  for (const FurKind kind : kinds) {
    const mesh::Texture texture = fur_texture(kind);
    std::array<int, 256> count{};
    for (std::size_t i = 0; i < texture.rgba.size(); i += 4) ++count[texture.rgba[i]];
    for (const int c : count) EXPECT_NEAR(c, 512 * 512 / 256, 1);
  }
}

TEST(FurTexture, RepeatsWithoutASeam) {
  for (const FurKind kind : kinds) {
    const mesh::Texture texture = fur_texture(kind);
    const auto at = [&](int x, int y) {
      return static_cast<int>(texture.rgba[(static_cast<std::size_t>(y) * 512 + x) * 4]);
    };
    double across_border = 0, inside = 0;
    for (int i = 0; i < 512; ++i) {
      across_border += std::abs(at(511, i) - at(0, i)) + std::abs(at(i, 511) - at(i, 0));
      inside += std::abs(at(255, i) - at(256, i)) + std::abs(at(i, 255) - at(i, 256));
    }
    // A seam would change by 85 of 255 on average; from texel to texel it is some 5 to 15.
    EXPECT_LT(across_border, 1.6 * inside);
  }
}

TEST(FurTexture, IsTheSameEachTimeAndEachKindItsOwn) {
  EXPECT_EQ(fur_texture(FurKind::Fur).rgba, fur_texture(FurKind::Fur).rgba);
  EXPECT_NE(fur_texture(FurKind::Fur).rgba, fur_texture(FurKind::Down).rgba);
}

}  // namespace
}  // namespace rinkaku::test

// CG layers and mattes in their order of depth, against the compositing equation in floating point.
#include "pipeline/passes/composite/merge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rinkaku::passes {
namespace {

using Colour = std::array<double, 4>;  // premultiplied, 0 to 1

constexpr int width = 37, height = 11;  // no multiple of what loops take at a time

// Values that come up: nothing, all, and anything between.
std::uint8_t any_alpha(std::mt19937& random) {
  const unsigned kind = random() % 3;
  return static_cast<std::uint8_t>(kind == 0 ? 0 : kind == 1 ? 255 : random() % 256);
}

Layer any_layer(std::mt19937& random, const PixelRect& rect) {
  Layer layer;
  layer.rect = rect;
  for (int i = 0; i < rect.width_px * rect.height_px; ++i) {
    const std::uint8_t alpha = any_alpha(random);
    for (int c = 0; c < 3; ++c) layer.rgba.push_back(static_cast<std::uint8_t>(random() % (alpha + 1u)));
    layer.rgba.push_back(alpha);
  }
  return layer;
}

Matte any_matte(std::mt19937& random) {
  Matte matte;
  matte.width_px = width, matte.height_px = height;
  matte.rect = {0, 0, width, height};
  for (int i = 0; i < width * height; ++i) {
    matte.alpha.push_back(any_alpha(random));
    for (int c = 0; c < 3; ++c) matte.own_rgb.push_back(static_cast<std::uint8_t>(random() % 256));
  }
  return matte;
}

Colour at(const Layer& layer, int x, int y) {
  const PixelRect& r = layer.rect;
  if (x < r.x_px || y < r.y_px || x >= r.right_px() || y >= r.bottom_px()) return {};
  Colour colour{};
  for (std::size_t c = 0; c < 4; ++c) {
    colour[c] = layer.rgba[(static_cast<std::size_t>(y - r.y_px) * r.width_px + x - r.x_px) * 4 + c] / 255.0;
  }
  return colour;
}

Colour over(const Colour& top, const Colour& under) {
  Colour out{};
  for (std::size_t c = 0; c < 4; ++c) out[c] = top[c] + (1 - top[3]) * under[c];
  return out;
}

// alpha times `own` over `behind`, within what `behind` covers.
Colour atop(double alpha, const std::uint8_t* own, const Colour& behind) {
  Colour out{};
  for (std::size_t c = 0; c < 3; ++c) out[c] = (1 - alpha) * behind[c] + behind[3] * alpha * own[c] / 255.0;
  out[3] = behind[3];
  return out;
}

TEST(Merge, FollowsTheCompositingEquationInEveryPixel) {
  std::mt19937 random(4);
  for (const std::size_t things : {1u, 2u, 3u}) {
    std::vector<Layer> layers;
    std::vector<Matte> mattes;
    for (std::size_t i = 0; i <= things; ++i) {
      layers.push_back(any_layer(random, {static_cast<int>(i), 1, width - 2 * static_cast<int>(i), height - 2}));
    }
    for (std::size_t i = 0; i < things; ++i) mattes.push_back(any_matte(random));
    Layer out;
    merge({layers, mattes, true}, out);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * width + x;
        Colour wish = at(layers.back(), x, y);
        for (std::size_t i = things; i-- > 0;) {
          const int alpha = mattes[i].alpha[pixel];
          // Opaque, the plate itself is to be seen: nothing is laid over it.
          wish = alpha == 255 ? Colour{} : atop(alpha / 255.0, &mattes[i].own_rgb[3 * pixel], wish);
          wish = over(at(layers[i], x, y), wish);
        }
        const Colour found = at(out, x, y);
        // Each of up to four steps rounds to 1/255 once or twice.
        for (std::size_t c = 0; c < 4; ++c) {
          ASSERT_NEAR(found[c], wish[c], 3.0 / 255) << x << "," << y << " of " << things;
        }
        for (std::size_t c = 0; c < 3; ++c) ASSERT_LE(found[c], found[3]);
      }
    }
  }
}

// picture = alpha own + (1 - alpha) filmed background must become alpha own + (1 - alpha) CG.
TEST(Merge, NoColourOfTheFilmedBackgroundIsLeftBeforeCg) {
  const double alpha = 153 / 255.0;
  const std::array<double, 3> own = {0.9, 0.2, 0.1}, filmed = {0.0, 0.8, 0.0}, cg = {0.1, 0.1, 0.7};
  Matte matte;
  matte.width_px = matte.height_px = 1;
  matte.rect = {0, 0, 1, 1};
  matte.alpha = {153};
  Layer behind{{0, 0, 1, 1}, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    matte.own_rgb.push_back(static_cast<std::uint8_t>(std::lround(own[c] * 255)));
    behind.rgba.push_back(static_cast<std::uint8_t>(std::lround(cg[c] * 255)));
  }
  behind.rgba.push_back(255);
  const std::array<Layer, 2> layers = {Layer{}, behind};
  Layer out;
  merge({layers, {&matte, 1}, true}, out);
  const Colour found = at(out, 0, 0);
  for (std::size_t c = 0; c < 3; ++c) {
    const double plate = alpha * own[c] + (1 - alpha) * filmed[c];
    const double seen = found[c] + (1 - found[3]) * plate;
    EXPECT_NEAR(seen, alpha * own[c] + (1 - alpha) * cg[c], 2.0 / 255);  // rounded three times
  }
}

TEST(Merge, CutsOnlyWithoutOwnColours) {
  std::mt19937 random(9);
  const std::array<Layer, 2> layers = {Layer{}, any_layer(random, {0, 0, width, height})};
  const Matte matte = any_matte(random);
  Layer out;
  merge({layers, {&matte, 1}, false}, out);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double rest = 1 - matte.alpha[static_cast<std::size_t>(y) * width + x] / 255.0;
      for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(at(out, x, y)[c], at(layers[1], x, y)[c] * rest, 0.51 / 255);
    }
  }
}

TEST(Merge, NothingDrawnIsNothingToLayOver) {
  std::mt19937 random(2);
  const std::array<Layer, 2> layers{};
  const Matte matte = any_matte(random);
  Layer out = any_layer(random, {0, 0, 3, 3});
  merge({layers, {&matte, 1}, true}, out);
  EXPECT_TRUE(out.rect.empty());
}

TEST(Merge, WorldStandsBehindWhatIsDrawnAndCoversAll) {
  std::mt19937 random(3);
  Layer world = any_layer(random, {0, 0, width, height}), layer = any_layer(random, {5, 2, 9, 4}), scratch;
  for (std::size_t i = 3; i < world.rgba.size(); i += 4) world.rgba[i] = 255;
  const Layer drawn = layer;
  put_behind(world, layer, scratch);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Colour wish = over(at(drawn, x, y), at(world, x, y));
      for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(at(layer, x, y)[c], wish[c], 0.51 / 255);
    }
  }
}

}  // namespace
}  // namespace rinkaku::passes

#include "water/pass/water_pass.h"

#include <gtest/gtest.h>

#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"
#include "tests/water/waters.h"

namespace rinkaku::test {
namespace {

using water::Stroke;
using water::WaterPass;

// A brush without hairs: paint everywhere.
water::BrushSheet plain() {
  water::BrushSheet sheet;
  sheet.width_px = sheet.height_px = 4, sheet.layers = 1;
  for (int i = 0; i < 16; ++i) sheet.texels.insert(sheet.texels.end(), {255, 128});
  return sheet;
}

class WaterPassTest : public GlTest {
 protected:
  // One stroke over the whole picture.
  Stroke everywhere(std::array<std::uint8_t, 4> colour) const {
    Stroke s;
    s.middle_px = {50, 50}, s.half_px = {100, 0}, s.half_width_px = 100, s.depth_m = 2, s.colour = colour;
    return s;
  }
  // In the camera's frame: a wall 2 m away, 1 m wide and high, seen on 50 x 50 pixels.
  const water::Surface wall{
      "test", {{{-0.5, -0.5, 2}, {0.5, -0.5, 2}, {0.5, 0.5, 2}, {-0.5, 0.5, 2}}, {}, {}}, {0, 0, 0}};
  const passes::View v = view(100, 100, 100);

  passes::Layer drawn_with(std::vector<passes::StyledObject> objects, std::span<const Stroke> strokes,
                           std::span<const Stroke> over = {}) {
    passes::LayerRenderer renderer(std::move(objects), picture_of(v));
    auto pass = std::make_unique<WaterPass>(plain(), plain());
    const water::PaintedSurface painted{&wall, strokes};
    pass->show({&painted, 1}, over, {});
    renderer.add(std::move(pass));
    passes::Layer layer;
    renderer.draw(v, layer);
    return layer;
  }
};

TEST_F(WaterPassTest, PaintsTheSurfaceAndNothingOutside) {
  const Stroke stroke = everywhere({200, 100, 50, 255});
  const passes::Layer layer = drawn_with({}, {&stroke, 1});
  EXPECT_EQ(at(layer, 50, 50), (Rgba{200, 100, 50, 255}));
  EXPECT_EQ(at(layer, 20, 50), (Rgba{0, 0, 0, 0}));
  // 50 x 50 pixels, and half a pixel of feather around.
  EXPECT_NEAR(area_px(layer), 50 * 50 + 4 * 50 * 0.5, 60);
}

TEST_F(WaterPassTest, LaterStrokesLieOverEarlierOnes) {
  std::array<Stroke, 2> strokes{everywhere({200, 0, 0, 255}), everywhere({0, 200, 0, 255})};
  strokes[1].colour[3] = 128;
  const passes::Layer layer = drawn_with({}, strokes);
  EXPECT_NEAR(at(layer, 50, 50)[0], 100, 1);
  EXPECT_NEAR(at(layer, 50, 50)[1], 100, 1);
}

TEST_F(WaterPassTest, IsHiddenByWhatStandsBeforeItAndHidesWhatLiesBehind) {
  const Stroke stroke = everywhere({0, 0, 200, 255});
  // A ball of 0.2 m that the wall cuts through the middle, to the left before, to the right behind it.
  const passes::Layer layer = drawn_with(
      scene_of(toon(sphere(4), moved(-0.25, 0, 1.8) * scaled(0.1)), toon(sphere(4), moved(0.25, 0, 2.2) * scaled(0.1))),
      {&stroke, 1});
  const glm::dvec2 left = to_pixels(v.camera, {-0.25 / 1.8, 0}), right = to_pixels(v.camera, {0.25 / 2.2, 0});
  EXPECT_EQ(at(layer, static_cast<int>(left.x), 50)[2] == 200, false);
  EXPECT_EQ(at(layer, static_cast<int>(right.x), 50), (Rgba{0, 0, 200, 255}));
}

TEST_F(WaterPassTest, StrokesOverEverythingAreTestedAgainstTheObjects) {
  Stroke over = everywhere({10, 20, 30, 255});
  over.depth_m = 1.9f;
  const Stroke water = everywhere({0, 0, 200, 255});
  const passes::Layer layer =
      drawn_with(scene_of(toon(sphere(4), moved(-0.25, 0, 1.6) * scaled(0.1))), {&water, 1}, {&over, 1});
  EXPECT_EQ(at(layer, 70, 70), (Rgba{10, 20, 30, 255}));
  const glm::dvec2 ball = to_pixels(v.camera, {-0.25 / 1.6, 0});
  EXPECT_NE(at(layer, static_cast<int>(ball.x), 50), (Rgba{10, 20, 30, 255}));
}

// Of the user's two brushes one is full of paint, the other has none: their shares are the paint.
TEST_F(WaterPassTest, OwnBrushesAreBlendedByTheirShares) {
  water::BrushSheet own = plain();
  own.layers = 2;
  for (int i = 0; i < 16; ++i) own.texels.insert(own.texels.end(), {0, 128});
  Stroke stroke = everywhere({200, 100, 50, 255});
  stroke.blend = {153, 102, 0, 0};
  passes::LayerRenderer renderer({}, picture_of(v));
  auto pass = std::make_unique<WaterPass>(plain(), plain(), own);
  const water::PaintedSurface painted{&wall, {&stroke, 1}};
  pass->show({&painted, 1}, {}, {});
  renderer.add(std::move(pass));
  passes::Layer layer;
  renderer.draw(v, layer);
  const Rgba seen = at(layer, 50, 50);
  EXPECT_NEAR(seen[3], 153, 1);
  EXPECT_NEAR(seen[0], 200 * 0.6, 1);  // premultiplied
}

TEST_F(WaterPassTest, DrawsNothingWithoutStrokes) { EXPECT_TRUE(drawn_with({}, {}).rect.empty()); }

TEST_F(WaterPassTest, AMirrorsEyeSeesOnlyWhatLiesBeforeTheMirror) {
  // A ball of 0.5 m around the origin of a mirror at z = 3 in the camera's frame; the eye lies behind the mirror at z
  // < 3.
  passes::LayerRenderer renderer(scene_of(toon(sphere(4), moved(0, 0, 3) * scaled(0.25))), picture_of(v));
  passes::View mirror = v;
  passes::Layer whole, half;
  ASSERT_TRUE(renderer.draw_objects(v, picture_of(v), whole));
  mirror.mirror = glm::dvec4(0, 0.6, 0.8, -2.4);  // a slanting plane through (0, 0, 3)
  ASSERT_TRUE(renderer.draw_objects(mirror, picture_of(v), half));
  // Of the half beyond the plane, the upper rim is cut off and the lower part seen.
  EXPECT_EQ(at(whole, 50, 43)[3], 255);
  EXPECT_EQ(at(half, 50, 43)[3], 0);
  EXPECT_EQ(at(half, 50, 56)[3], 255);
}

}  // namespace
}  // namespace rinkaku::test

// Where CG lies in the picture, and what happens at the borders of what can be seen.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::LayerRenderer;
using passes::PixelRect;
using passes::View;

class Framing : public GlTest {};

const glm::vec4 red{1, 0, 0, 1};

TEST_F(Framing, NothingToSeeDrawsNothing) {
  const View v = view(64, 48, 50);
  const mesh::Mesh ball = sphere(2);
  for (const glm::dvec3& centre : {glm::dvec3(0, 0, -3), {40, 0, 3}, {0, -40, 3}, {0, 0, -0.6}, {1e7, 0, 1}}) {
    LayerRenderer renderer(scene_of(toon(ball, moved(centre.x, centre.y, centre.z) * scaled(0.5))), picture_of(v));
    Layer layer;
    layer.rect = {0, 0, 64, 48};
    EXPECT_FALSE(renderer.draw(v, layer)) << centre.x << ", " << centre.y << ", " << centre.z;
    EXPECT_TRUE(layer.rect.empty());
  }
  LayerRenderer none({}, picture_of(v));
  Layer layer;
  EXPECT_FALSE(none.draw(v, layer));
}

TEST_F(Framing, LayerHoldsTheWholeObjectAndLittleElse) {
  const View v = view(320, 240, 300);
  for (const glm::dvec3& centre : {glm::dvec3(0, 0, 2), {0.301, -0.203, 2}, {-0.4, 0.3, 2.5}}) {
    const Layer layer = drawn(scene_of(toon(sphere(4), moved(centre.x, centre.y, centre.z) * scaled(0.2))), v);
    const PixelRect& r = layer.rect;
    int outermost = 0;
    for (int x = r.x_px; x < r.right_px(); ++x)
      outermost += at(layer, x, r.y_px)[3] + at(layer, x, r.bottom_px() - 1)[3];
    for (int y = r.y_px; y < r.bottom_px(); ++y)
      outermost += at(layer, r.x_px, y)[3] + at(layer, r.right_px() - 1, y)[3];
    EXPECT_EQ(outermost, 0);  // nothing was cut off
    const double diameter_px = 2 * 300 * 0.2 / centre.z;
    EXPECT_LT(r.width_px, diameter_px * 1.05 + 8);
    EXPECT_LT(r.height_px, diameter_px * 1.05 + 8);
  }
}

// Cut by the picture's border, an object looks as the same part of it does in a larger picture.
TEST_F(Framing, BordersOfThePictureCutCleanly) {
  const View v = view(64, 48, 100);
  View wide = v;
  wide.camera.width_px += 200, wide.camera.height_px += 200;
  wide.camera.cx_px += 100, wide.camera.cy_px += 100;
  for (const glm::dvec3& centre : {glm::dvec3(0.3, 0.2, 1), {-0.35, 0, 1}, {0, -0.3, 1}, {0, 0, 0.4}}) {
    const glm::dmat4 place = moved(centre.x, centre.y, centre.z) * scaled(0.2);
    const Layer part = drawn(scene_of(toon(sphere(4), place)), v);
    const Layer whole = drawn(scene_of(toon(sphere(4), place)), wide);
    EXPECT_EQ(part.rect, intersection(part.rect, picture_of(v)));
    double sum = 0;
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        // Floats of another viewport round otherwise: a few thousandths of a pixel at the edge.
        ASSERT_NEAR(at(part, x, y)[3], at(whole, x + 100, y + 100)[3], 3) << x << ", " << y;
        sum += at(part, x, y)[3];
      }
    }
    EXPECT_GT(sum, 255 * 200);
  }
}

TEST_F(Framing, PictureMayBeginOutsideThePlate) {
  // As for a lens that bends inwards, whose pinhole picture is larger than the plate.
  const View v = view(64, 48, 100);
  LayerRenderer renderer(scene_of(toon(sphere(4), moved(-0.4, -0.3, 1) * scaled(0.1))), {-30, -25, 124, 98});
  Layer layer;
  ASSERT_TRUE(renderer.draw(v, layer));
  EXPECT_LT(layer.rect.x_px, 0);
  EXPECT_LT(layer.rect.y_px, 0);
  const SeenSphere truth = seen_sphere(v.camera, {-0.4, -0.3, 1}, 0.1);
  EXPECT_NEAR(area_px(layer) / truth.area_px, 1, 0.01);
  EXPECT_LT(glm::length(centroid_px(layer) - truth.centre_px), 0.05);
}

TEST_F(Framing, RowsRunFromTheTop) {
  const View v = view(65, 49, 100);
  const Layer layer = drawn(scene_of(toon(sphere(3, red), moved(0, -0.15, 1) * scaled(0.05)),
                                     toon(sphere(3, {0, 1, 0, 1}), moved(0.2, 0.1, 1) * scaled(0.05))),
                            v);
  EXPECT_EQ(at(layer, 32, 24 - 15), (Rgba{255, 0, 0, 255}));  // y down: -0.15 is above the middle
  EXPECT_EQ(at(layer, 32 + 20, 24 + 10), (Rgba{0, 255, 0, 255}));
}

TEST_F(Framing, PosesAndPlacesCompose) {
  View v = view(320, 240, 300);
  const glm::dquat turn = glm::angleAxis(2.1, glm::normalize(glm::dvec3(0.3, -1, 0.2)));
  // World coordinates of a survey: kilometres from the origin, the object two metres before the camera.
  const glm::dvec3 eye(4200.25, -3100.5, 870.125);
  v.camera_from_world = inverse(RigidTransform{turn, eye});
  const glm::dvec3 seen_at(0.21, -0.13, 2);
  const glm::dvec3 in_world = turn * seen_at + eye;
  const Layer layer = drawn(scene_of(toon(sphere(5), moved(in_world.x, in_world.y, in_world.z) * scaled(0.3))), v);
  const SeenSphere truth = seen_sphere(v.camera, seen_at, 0.3);
  EXPECT_NEAR(area_px(layer) / truth.area_px, 1, 0.004);  // as in Coverage
  EXPECT_LT(glm::length(centroid_px(layer) - truth.centre_px), 0.02);
}

TEST_F(Framing, MirroredObjectIsDrawnRight) {
  const View v = view(160, 120, 200);
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.6, {0.3, 1, 0});
  passes::ToonOptions lit;
  lit.bands = 4;
  lit.light = {0.3f, -0.4f, -1};
  // The cube is its own mirror image, so both must look alike, shading included.
  const Layer plain = drawn(scene_of(toon(cube(red), moved(0, 0, 2) * turn * scaled(0.3), lit)), v);
  const glm::dmat4 mirror = glm::scale(glm::dmat4(1), glm::dvec3(-0.3, 0.3, 0.3));
  const Layer mirrored = drawn(scene_of(toon(cube(red), moved(0, 0, 2) * turn * mirror, lit)), v);
  EXPECT_EQ(plain.rect, mirrored.rect);
  // Only edge pixels may differ: a feather between two corners that are pushed different ways is no parallelogram, its
  // coverage depends on which diagonal cuts it, and the mirror turns the diagonals round.
  for (std::size_t i = 0; i < plain.rgba.size(); ++i) {
    const std::size_t alpha = i / 4 * 4 + 3;
    if (plain.rgba[alpha] < 255 || mirrored.rgba[alpha] < 255) continue;
    // Along inner edges the feathers of both sides are blended in turn, and 8 bits round each time.
    ASSERT_NEAR(plain.rgba[i], mirrored.rgba[i], 2) << i;
  }
  EXPECT_NEAR(area_px(plain) / area_px(mirrored), 1, 0.002);
  EXPECT_GT(area_px(plain), 3000);
}

TEST_F(Framing, FlattenedBallIsSeenAsAnEllipse) {
  const View v = view(320, 240, 300);
  const glm::dmat4 flat = moved(0, 0, 4) * glm::scale(glm::dmat4(1), glm::dvec3(1.2, 0.4, 0.05));
  // So thin that perspective hardly matters: semi-axes 90 and 30 pixels.
  EXPECT_NEAR(area_px(drawn(scene_of(toon(sphere(5), flat)), v)) / (std::numbers::pi * 90 * 30), 1, 0.01);
}

TEST_F(Framing, EyeInsideAnObjectIsNoTrouble) {
  const View v = view(64, 48, 50);
  Layer layer = drawn(scene_of(toon(sphere(2), scaled(3))), v);  // its outer side is not seen
  EXPECT_EQ(area_px(layer), 0);
  mesh::Mesh room = sphere(2, red);
  room.materials[0].two_sided = true;
  layer = drawn(scene_of(toon(room, scaled(3))), v);
  ASSERT_EQ(layer.rect, picture_of(v));
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) ASSERT_EQ(at(layer, x, y), (Rgba{255, 0, 0, 255})) << x << ", " << y;
  }
}

// A floor that begins behind the camera: the near plane cuts it.
TEST_F(Framing, FloorUnderTheCameraReachesTheLowerBorder) {
  const View v = view(160, 121, 80);
  const glm::dmat4 lying = moved(0, 1, 20) * glm::rotate(glm::dmat4(1), std::numbers::pi / 2, {1, 0, 0}) * scaled(40);
  const Layer layer = drawn(scene_of(toon(square(red), lying)), v);
  for (int y = 0; y < 121; ++y) {
    for (int x = 0; x < 160; ++x) {
      // Row y sees the floor, one metre below, at this distance; it ends at 60 m, 1.3 pixels below the horizon.
      const double z = 80 / (y - v.camera.cy_px);
      const bool covered = y > v.camera.cy_px && z < 40, free = y < v.camera.cy_px - 1;
      if (covered) {
        ASSERT_EQ(at(layer, x, y), (Rgba{255, 0, 0, 255})) << x << ", " << y;
      } else if (free) {
        ASSERT_EQ(at(layer, x, y)[3], 0) << x << ", " << y;
      }
    }
  }
}

TEST_F(Framing, SquareThroughTheNearPlaneIsCutAndDrawn) {
  const View v = view(64, 48, 50);
  for (double turn : {0.3, 1.2, 1.6, 2.9}) {
    const glm::dmat4 place = moved(0.02, 0.01, 0.3) * glm::rotate(glm::dmat4(1), turn, {0.2, 1, 0}) * scaled(1);
    const Layer layer = drawn(scene_of(toon(square(red), place)), v);
    EXPECT_EQ(layer.rect, intersection(layer.rect, picture_of(v)));
    EXPECT_GT(area_px(layer), 50) << turn;
    for (std::size_t i = 0; i < layer.rgba.size(); i += 4) ASSERT_NEAR(layer.rgba[i], layer.rgba[i + 3], 1);
  }
}

TEST_F(Framing, PicturesOfAnySizeAreFilled) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {33, 1}, {127, 129}, {35, 29}, {1281, 3}}) {
    const View v = view(width, height, 10);
    const Layer layer = drawn(scene_of(toon(square(red), moved(0, 0, 1) * scaled(500))), v);
    ASSERT_EQ(layer.rect, picture_of(v));
    ASSERT_EQ(layer.rgba.size(), static_cast<std::size_t>(width) * height * 4);
    EXPECT_EQ(area_px(layer), width * height);
  }
}

// One renderer, many frames: what one frame left behind never shows in the next.
TEST_F(Framing, FramesDoNotLeakIntoOneAnother) {
  const View v = view(160, 120, 200);
  const mesh::Mesh ball = sphere(3, red);
  auto seen_from = [&](double x) {
    View from = v;
    from.camera_from_world.translation_m = {x, 0.1 * x, 2 - x};
    return from;
  };
  LayerRenderer renderer(scene_of(toon(ball, scaled(0.2)), toon(square(), moved(0.1, 0, 0.5) * scaled(0.1))),
                         picture_of(v));
  Layer layer;
  for (double x : {0.0, 1.2, -0.3, 0.0, 5.0, 0.2, -0.3}) {
    renderer.draw(seen_from(x), layer);
    const Layer fresh =
        drawn(scene_of(toon(ball, scaled(0.2)), toon(square(), moved(0.1, 0, 0.5) * scaled(0.1))), seen_from(x));
    ASSERT_EQ(layer.rect, fresh.rect) << x;
    EXPECT_TRUE(layer.rect.empty() || layer.rgba == fresh.rgba) << x;
  }
}

}  // namespace
}  // namespace rinkaku::test

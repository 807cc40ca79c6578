// CG drawn in slices of depth.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "pipeline/passes/holdout/holdout_pass.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

class Slices : public GlTest {};

const glm::vec4 red{1, 0, 0, 1}, blue{0, 0, 1, 1};

// A red ball at 2 m and a blue one behind it at 4 m, seen beside it.
std::vector<passes::StyledObject> two_balls() {
  return scene_of(toon(sphere(4, red), moved(0, 0, 2) * scaled(0.4)),
                  toon(sphere(4, blue), moved(0.6, 0, 4) * scaled(0.8)));
}

template <std::size_t N>
std::array<Layer, N> sliced(std::vector<passes::StyledObject> scene, const View& v,
                            const std::array<double, N - 1>& cuts_m) {
  passes::LayerRenderer renderer(std::move(scene), picture_of(v));
  std::array<Layer, N> layers;
  renderer.draw(v, cuts_m, layers);
  return layers;
}

TEST_F(Slices, EachObjectIsInItsOwn) {
  const View v = view(160, 120, 150);
  const auto layers = sliced<2>(two_balls(), v, {3});
  EXPECT_EQ(at(layers[0], 80, 60), (Rgba{255, 0, 0, 255}));
  // Where the red one hid it in one picture, the blue one is whole in its slice: the red one's soft edge needs it.
  EXPECT_EQ(at(layers[1], 92, 60), (Rgba{0, 0, 255, 255}));
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      ASSERT_EQ(at(layers[0], x, y)[2], 0);
      ASSERT_EQ(at(layers[1], x, y)[0], 0);
    }
  }
}

TEST_F(Slices, EmptySlicesAreEmpty) {
  const View v = view(160, 120, 150);
  const auto layers = sliced<4>(two_balls(), v, {1, 3, 6});
  EXPECT_TRUE(layers[0].rect.empty());
  EXPECT_FALSE(layers[1].rect.empty());
  EXPECT_FALSE(layers[2].rect.empty());
  EXPECT_TRUE(layers[3].rect.empty());
}

// The part of a ball that is nearer than the cut: where its front surface is.
TEST_F(Slices, SurfaceThroughTheCutIsDividedWhereItPassesIt) {
  const View v = view(320, 240, 300);
  const double radius = 0.5, cut_m = 1.7;
  const glm::dvec3 centre(0, 0, 2);
  const auto layers = sliced<2>(scene_of(toon(sphere(5, red), moved(0, 0, 2) * scaled(radius))), v, {cut_m});
  int near = 0, far = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const glm::dvec3 ray(to_normalised(v.camera, {x, y}), 1);
      const double a = glm::dot(ray, ray), b = glm::dot(ray, centre);
      const double under_root = b * b - a * (glm::dot(centre, centre) - radius * radius);
      if (under_root < 0.004) continue;  // within two pixels of the outline
      const double depth = (b - std::sqrt(under_root)) / a;
      // The surface that is drawn may leave the sphere by a pixel, which is 6 mm across and more in depth.
      if (std::abs(depth - cut_m) < 0.03) continue;
      const int in_front = at(layers[0], x, y)[3], behind = at(layers[1], x, y)[3];
      ASSERT_EQ(in_front, depth < cut_m ? 255 : 0) << x << "," << y;
      ASSERT_EQ(behind, depth < cut_m ? 0 : 255) << x << "," << y;
      (depth < cut_m ? near : far) += 1;
    }
  }
  EXPECT_GT(near, 1000);
  EXPECT_GT(far, 1000);
}

// A floor half a metre below the eye, seen through a lens and cut along a row of the picture.
std::array<Layer, 2> cut_floor(const glm::vec4& colour, View v, double row) {
  v.camera.distortion[0] = 0.1;
  const double floor_m = 0.5;
  const glm::dmat4 place = moved(0, floor_m + 0.05, 4) * glm::scale(glm::dmat4(1), glm::dvec3(6, 0.05, 3.2));
  mesh::Mesh floor = cube(colour);
  if (colour.a < 1) floor.materials[0].alpha = mesh::Material::Alpha::Blend;
  return sliced<2>(scene_of(toon(floor, place)), v, {v.camera.fy_px * floor_m / (row - v.camera.cy_px)});
}

// A lens moves layers by parts of a pixel and so mixes the nearer slice's first row with nothing: the farther one has
// to reach under it.
TEST_F(Slices, WithALensTheFartherOneReachesUnderTheNearer) {
  const View v = view(160, 120, 150);
  for (const double row : {100.0, 106.3, 109.999, 110.001}) {
    const auto layers = cut_floor(red, v, row);
    const int first = static_cast<int>(std::ceil(row));
    for (int x = 40; x < 120; ++x) {
      EXPECT_EQ(at(layers[0], x, first + 1)[3], 255);
      for (const int y : {first - 1, first}) EXPECT_EQ(at(layers[1], x, y)[3], 255) << x << ", " << y << ", " << row;
    }
    EXPECT_EQ(at(layers[0], 80, first - 2)[3], 0);
    EXPECT_EQ(at(layers[1], 80, first + 4)[3], 0) << "but not far";
  }
}

TEST_F(Slices, WhatCanBeSeenThroughIsSeenOnce) {
  const View v = view(160, 120, 150);
  const auto layers = cut_floor({1, 0, 0, 0.5}, v, 106.3);
  for (int y = 95; y < 118; ++y) {
    for (int x = 40; x < 120; ++x) {
      ASSERT_NEAR(at(layers[0], x, y)[3] + at(layers[1], x, y)[3], 128, 1) << x << ", " << y;
    }
  }
}

TEST_F(Slices, HoldoutHidesWhatIsInSlicesBehindIt) {
  const View v = view(160, 120, 150);
  passes::StyledObject holdout;
  const mesh::Mesh ball = sphere(4, red);
  holdout.object = std::make_unique<passes::DrawnObject>(passes::ObjectShape(ball, moved(0, 0, 2) * scaled(0.4)));
  holdout.passes.push_back(std::make_unique<passes::HoldoutPass>(*holdout.object));
  const auto layers =
      sliced<2>(scene_of(std::move(holdout), toon(sphere(4, blue), moved(0, 0, 5) * scaled(1.6))), v, {3});
  EXPECT_TRUE(layers[0].rect.empty());
  EXPECT_EQ(at(layers[1], 80, 60), (Rgba{0, 0, 0, 0}));      // behind the holdout
  EXPECT_EQ(at(layers[1], 80, 24), (Rgba{0, 0, 255, 255}));  // above it
}

TEST_F(Slices, WithoutCutsIsTheWholePicture) {
  const View v = view(160, 120, 150);
  const Layer whole = drawn(two_balls(), v);
  const auto one = sliced<1>(two_balls(), v, {});
  EXPECT_EQ(whole.rect, one[0].rect);
  EXPECT_EQ(whole.rgba, one[0].rgba);
}

}  // namespace
}  // namespace rinkaku::test

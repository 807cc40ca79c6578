#include "pipeline/passes/toon/toon_pass.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::ToonOptions;
using passes::View;

class Toon : public GlTest {};

const glm::vec3 shade{0.5f, 0.25f, 0.75f};
const glm::vec4 base{0.8f, 0.6f, 1.0f, 1};

// A light at this angle from the surface's normal, which points towards the camera (-z).
ToonOptions lit(int bands, double angle_deg) {
  const double a = angle_deg * std::numbers::pi / 180;
  ToonOptions options;
  options.bands = bands;
  options.shade_colour = shade;
  options.light = glm::vec3(7 * std::sin(a), 0, -7 * std::cos(a));  // any length
  return options;
}

// Half Lambert cut into bands of equal height, the darkest multiplied by `shade`, the brightest by 1.
Rgba expected(int bands, double angle_deg) {
  const double brightness = (std::cos(angle_deg * std::numbers::pi / 180) + 1) / 2;
  const double level = std::min(std::floor(brightness * bands), bands - 1.0);
  Rgba colour{0, 0, 0, 255};
  for (int c = 0; c < 3; ++c) {
    const double factor = shade[c] + (1 - shade[c]) * level / (bands - 1);
    colour[c] = static_cast<int>(std::lround(255 * base[c] * factor));
  }
  return colour;
}

void expect_colour(const Rgba& is, const Rgba& wish, const char* what, int bands, double angle) {
  // 8 bits round; products that end on a half may fall either way in float.
  for (int c = 0; c < 4; ++c)
    EXPECT_NEAR(is[c], wish[c], 1) << what << ", " << bands << " bands, " << angle << " degrees";
}

TEST_F(Toon, FlatFacesTakeTheBandOfTheirAngleToTheLight) {
  const View v = view(32, 32, 40);
  for (int bands : {2, 3, 4}) {
    for (double angle : {0.0, 20.0, 50.0, 75.0, 100.0, 115.0, 140.0, 170.0, 180.0}) {
      // Once open (lit a pixel at a time), once closed (lit by vertex).
      const Layer open = drawn(scene_of(toon(square(base), moved(0, 0, 2), lit(bands, angle))), v);
      expect_colour(at(open, 16, 16), expected(bands, angle), "square", bands, angle);
      const Layer closed = drawn(scene_of(toon(cube(base), moved(0, 0, 3), lit(bands, angle))), v);
      expect_colour(at(closed, 16, 16), expected(bands, angle), "cube", bands, angle);
    }
  }
}

TEST_F(Toon, LightIsInTheWorldNotOnTheObject) {
  const View v = view(32, 32, 40);
  const glm::dmat4 turned = moved(0, 0, 3) * glm::rotate(glm::dmat4(1), std::numbers::pi / 2, {0, 1, 0});
  expect_colour(at(drawn(scene_of(toon(cube(base), turned, lit(4, 50))), v), 16, 16), expected(4, 50), "turned", 4, 50);
}

TEST_F(Toon, SmoothBallShowsItsBandsAtTheAnalyticPlaces) {
  const View v = view(320, 240, 600);
  const int bands = 3;
  ToonOptions options = lit(bands, 60);
  // From so far away that rays are nearly parallel; a radius of 90 pixels.
  const double d = 20, radius = 3;
  for (int levels : {3, 5}) {  // 1,280 triangles (lit by pixel or by vertex, as the pass decides) and 20,480
    const Layer layer = drawn(scene_of(toon(sphere(levels, base), moved(0, 0, d) * scaled(radius), options)), v);
    int checked = 0;
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 320; ++x) {
        const glm::dvec3 ray = glm::normalize(glm::dvec3(to_normalised(v.camera, {x, y}), 1));
        const double along = ray.z * d, root = along * along - d * d + radius * radius;
        if (root < 2) continue;  // near the contour
        const glm::dvec3 normal = (ray * (along - std::sqrt(root)) - glm::dvec3(0, 0, d)) / radius;
        const double angle = std::acos(glm::dot(normal, glm::normalize(glm::dvec3(options.light))));
        const double brightness = (std::cos(angle) + 1) / 2 * bands;
        // A band's border may lie two pixels off (triangles of up to 15 pixels; one pixel is blended).
        if (std::abs(brightness - std::round(brightness)) < 2.0 / 90 * bands / 2 + 0.02) continue;
        expect_colour(at(layer, x, y), expected(bands, angle * 180 / std::numbers::pi), "ball", levels, angle);
        if (HasFailure()) return;
        ++checked;
      }
    }
    EXPECT_GT(checked, 10000);
  }
}

// Red, green, blue and white quarters, from the top left.
mesh::Texture quarters() {
  mesh::Texture texture{8, 8, {}};
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const std::array<std::uint8_t, 4> colours[] = {
          {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 255}};
      for (std::uint8_t c : colours[(y / 4) * 2 + x / 4]) texture.rgba.push_back(c);
    }
  }
  return texture;
}

TEST_F(Toon, TextureStandsUpright) {
  const View v = view(64, 64, 64);
  mesh::Mesh mesh = square();
  mesh.textures = {quarters()};
  mesh.materials[0].texture = 0;
  const Layer layer = drawn(scene_of(toon(mesh, moved(0, 0, 2))), v);  // 64 pixels wide
  EXPECT_EQ(at(layer, 16, 16), (Rgba{255, 0, 0, 255}));
  EXPECT_EQ(at(layer, 48, 16), (Rgba{0, 255, 0, 255}));
  EXPECT_EQ(at(layer, 16, 48), (Rgba{0, 0, 255, 255}));
  EXPECT_EQ(at(layer, 48, 48), (Rgba{255, 255, 255, 255}));
}

TEST_F(Toon, BaseColourAndVertexColoursMultiplyTheTexture) {
  const View v = view(64, 64, 64);
  mesh::Mesh mesh = square({0.5f, 1, 1, 1});
  mesh.textures = {quarters()};
  mesh.materials[0].texture = 0;
  mesh.colours.assign(4, glm::vec4(1, 1, 0.2f, 1));
  const Layer layer = drawn(scene_of(toon(mesh, moved(0, 0, 2))), v);
  const Rgba white = at(layer, 48, 48);
  EXPECT_NEAR(white[0], 128, 1);  // rounding
  EXPECT_EQ(white[1], 255);
  EXPECT_NEAR(white[2], 51, 1);
}

TEST_F(Toon, EachPartHasItsMaterial) {
  const View v = view(64, 64, 64);
  mesh::Mesh mesh = square({1, 0, 0, 1});
  append(mesh, square({0, 1, 0, 1}), {1, 0, 0.5f});
  mesh.textures = {quarters()};
  mesh.materials[1].texture = 0;
  const Layer layer = drawn(scene_of(toon(mesh, moved(0, 0, 4))), v);
  EXPECT_EQ(at(layer, 32, 20), (Rgba{255, 0, 0, 255}));
  EXPECT_EQ(at(layer, 54, 22), (Rgba{0, 255, 0, 255}));  // top right of the texture, times green
}

TEST_F(Toon, OpenSquareIsSeenFromBehindLitOnTheSideThatIsSeen) {
  const View v = view(32, 32, 40);
  for (double angle : {20.0, 100.0, 170.0}) {
    for (double mirror : {1.0, -1.0}) {
      // Turned round, its own normal points away from the camera; what is seen faces the camera all the same.
      const glm::dmat4 place = moved(0, 0, 2) * glm::rotate(glm::dmat4(1), std::numbers::pi, {0, 1, 0}) *
                               glm::scale(glm::dmat4(1), glm::dvec3(mirror, 1, 1));
      const Layer layer = drawn(scene_of(toon(square(base), place, lit(3, angle))), v);
      expect_colour(at(layer, 16, 16), expected(3, angle), "back", 3, angle);
    }
  }
}

// The feather must have the colour of the side that is seen, too.
TEST_F(Toon, FeatherHasTheSurfacesColour) {
  const View v = view(64, 64, 50.3);
  for (double turn : {0.0, std::numbers::pi}) {
    const glm::dmat4 place = moved(0.011, 0.007, 2) * glm::rotate(glm::dmat4(1), turn, {0, 1, 0});
    const Layer layer = drawn(scene_of(toon(square(base), place, lit(3, 20))), v);
    const Rgba inside = expected(3, 20);
    int edge_pixels = 0;
    for (std::size_t i = 0; i < layer.rgba.size(); i += 4) {
      const int a = layer.rgba[i + 3];
      edge_pixels += a > 20 && a < 235;
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(layer.rgba[i + c], inside[c] * a / 255.0, 2) << "alpha " << a;  // roundings
    }
    EXPECT_GT(edge_pixels, 60);
  }
}

TEST_F(Toon, MaskedTexelsAreHoles) {
  const View v = view(64, 64, 64);
  mesh::Mesh mesh = square();
  mesh.textures = {quarters()};
  for (std::size_t i = 0; i < 32; ++i) mesh.textures[0].rgba[i * 4 + 3] = 0;  // the upper half
  mesh.materials[0].texture = 0;
  mesh.materials[0].alpha = mesh::Material::Alpha::Mask;
  const Layer layer = drawn(scene_of(toon(mesh, moved(0, 0, 2))), v);
  EXPECT_EQ(at(layer, 16, 16)[3], 0);
  EXPECT_EQ(at(layer, 16, 48), (Rgba{0, 0, 255, 255}));
}

TEST_F(Toon, TranslucentSurfaceLetsWhatIsBehindItThrough) {
  const View v = view(64, 64, 64);
  mesh::Mesh glass = square({0, 0, 1, 0.25f});
  glass.materials[0].alpha = mesh::Material::Alpha::Blend;
  const Layer alone = drawn(scene_of(toon(glass, moved(0, 0, 2))), v);
  const Rgba blue = at(alone, 32, 32);
  EXPECT_NEAR(blue[2], 64, 1);  // a quarter
  EXPECT_NEAR(blue[3], 64, 1);
  const Layer both = drawn(scene_of(toon(glass, moved(0, 0, 2)), toon(square({1, 0, 0, 1}), moved(0, 0, 3))), v);
  const Rgba mixed = at(both, 32, 32);
  EXPECT_NEAR(mixed[0], 191, 1);
  EXPECT_NEAR(mixed[2], 64, 1);
  EXPECT_EQ(mixed[3], 255);
  const Layer hidden = drawn(scene_of(toon(glass, moved(0, 0, 3)), toon(square({1, 0, 0, 1}), moved(0, 0, 2))), v);
  EXPECT_EQ(at(hidden, 32, 32), (Rgba{255, 0, 0, 255}));
}

TEST_F(Toon, TranslucentObjectsAreLaidOverOneAnotherFromFarToNear) {
  const View v = view(64, 64, 64);
  mesh::Mesh red_glass = square({1, 0, 0, 0.5f}), blue_glass = square({0, 0, 1, 0.5f});
  red_glass.materials[0].alpha = blue_glass.materials[0].alpha = mesh::Material::Alpha::Blend;
  for (bool far_first : {false, true}) {
    auto near = toon(blue_glass, moved(0, 0, 2)), far = toon(red_glass, moved(0, 0, 3));
    const Layer layer = far_first ? drawn(scene_of(std::move(far), std::move(near)), v)
                                  : drawn(scene_of(std::move(near), std::move(far)), v);
    const Rgba seen = at(layer, 32, 32);
    // Half blue, and half of half red shining through; two roundings.
    EXPECT_NEAR(seen[0], 64, 2);
    EXPECT_NEAR(seen[2], 128, 2);
    EXPECT_NEAR(seen[3], 191, 2);
  }
}

// An alpha below 1 in a material that is not declared translucent means nothing.
TEST_F(Toon, OpaqueMaterialIgnoresAlpha) {
  const View v = view(32, 32, 40);
  const Layer layer = drawn(scene_of(toon(square({1, 0, 0, 0.3f}), moved(0, 0, 2))), v);
  EXPECT_EQ(at(layer, 16, 16), (Rgba{255, 0, 0, 255}));
}

int programs_for(const mesh::Mesh& mesh, const ToonOptions& options) {
  passes::DrawnObject object(passes::ObjectShape(mesh, glm::dmat4(1)));
  const gl::Made before = gl::made();
  const passes::ToonPass pass(object, mesh, options);
  return gl::made().programs - before.programs;
}

TEST_F(Toon, OnlyTheVariantsThatMaterialsNeedAreCompiled) {
  EXPECT_EQ(programs_for(cube(), unlit()), 2);  // surface and feather
  EXPECT_EQ(programs_for(cube(), lit(3, 0)), 2);
  EXPECT_EQ(programs_for(sphere(4), lit(3, 0)), 3);  // also for even triangles of levels of detail
  mesh::Mesh same = cube({1, 0, 0, 1});
  append(same, cube({0, 1, 0, 1}), {3, 0, 0});
  EXPECT_EQ(programs_for(same, unlit()), 2);  // colours are no variants
  mesh::Mesh mixed = square();
  append(mixed, square(), {0, 0, 1});
  mixed.textures = {quarters()};
  mixed.materials[1].texture = 0;
  EXPECT_EQ(programs_for(mixed, unlit()), 4);  // textured and not
}

TEST_F(Toon, TexturesAreMadeOnlyWhereThereAreSome) {
  mesh::Mesh mesh = square();
  passes::DrawnObject object(passes::ObjectShape(mesh, glm::dmat4(1)));
  gl::Made before = gl::made();
  const passes::ToonPass plain(object, mesh, unlit());
  EXPECT_EQ(gl::made().textures, before.textures);
  EXPECT_EQ(gl::made().buffers, before.buffers);
  mesh.textures = {quarters()};
  mesh.materials[0].texture = 0;
  before = gl::made();
  const passes::ToonPass textured(object, mesh, unlit());
  EXPECT_EQ(gl::made().textures, before.textures + 1);
}

TEST_F(Toon, DrawingMakesNothingOnceWarm) {
  const View v = view(160, 120, 200);
  passes::LayerRenderer renderer(scene_of(toon(sphere(3), moved(0, 0, 2) * scaled(0.2), lit(3, 30))), picture_of(v));
  Layer layer;
  renderer.draw(v, layer);
  const gl::Made before = gl::made();
  for (int i = 0; i < 10; ++i) renderer.draw(v, layer);
  EXPECT_EQ(gl::made(), before);
}

}  // namespace
}  // namespace rinkaku::test

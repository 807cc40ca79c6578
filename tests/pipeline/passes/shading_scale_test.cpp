// Colour at a lower resolution under edges at the full one.

#include <cstdlib>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "pipeline/passes/toon/coarse_colour.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::ToonOptions;
using passes::View;

class ShadingScale : public GlTest {};

constexpr glm::vec4 red{1, 0, 0, 1}, green{0, 1, 0, 1};

ToonOptions at_scale(int scale, int bands = 0) {
  ToonOptions options;
  options.bands = bands;
  options.shading_scale = scale;
  return options;
}

// A ring lying in z = 0 about the origin, 1 from its middle line to the origin.
mesh::Mesh ring(float thickness, const glm::vec4& colour) {
  constexpr std::uint32_t around = 96, across = 24;
  mesh::Mesh mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    const float u = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / around;
    const glm::vec3 out(std::cos(u), std::sin(u), 0);
    for (std::uint32_t k = 0; k < across; ++k) {
      const float v = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / across;
      mesh.normals.push_back(out * std::cos(v) + glm::vec3(0, 0, std::sin(v)));
      mesh.positions.push_back(out + mesh.normals.back() * thickness);
      mesh.welded.push_back(mesh.point_count++);
    }
  }
  const auto vertex = [](std::uint32_t i, std::uint32_t k) { return (i % around) * across + k % across; };
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      mesh.triangles.emplace_back(vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1));
      mesh.triangles.emplace_back(vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1));
    }
  }
  one_part(mesh, colour);
  return mesh;
}

glm::dmat4 tilted(double z) { return moved(0.02, 0.01, z) * glm::rotate(glm::dmat4(1), 0.9, {1, 0.3, 0}); }

void expect_same_coverage(const Layer& coarse, const Layer& full, const char* what) {
  ASSERT_EQ(coarse.rect, full.rect) << what;
  for (std::size_t i = 3; i < full.rgba.size(); i += 4) ASSERT_EQ(coarse.rgba[i], full.rgba[i]) << what << i / 4;
}

TEST_F(ShadingScale, CoverageIsTheSameToTheLastBit) {
  const View v = view(320, 240, 300);
  const auto three = [&v](int scale) {
    return drawn(scene_of(toon(ring(0.3f, red), tilted(3) * scaled(0.5), at_scale(scale, 3)),
                          toon(cube(green), moved(0.3, 0.1, 2.9) * scaled(0.2), at_scale(scale, 3)),
                          toon(sphere(4), moved(-0.4, -0.2, 2) * scaled(0.13), at_scale(scale, 2))),
                 v);
  };
  const Layer full = three(1);
  ASSERT_GT(area_px(full), 5000);
  for (const int scale : {2, 3, 4}) expect_same_coverage(three(scale), full, "three objects ");
}

// No toon band, no other material: colour has nothing to lose, also where the object has edges of its own inside.
TEST_F(ShadingScale, OneColourIsTheSameInEveryPixel) {
  const View v = view(320, 240, 300);
  for (const int scale : {2, 3}) {
    const auto draw = [&v](int s) {
      return drawn(scene_of(toon(ring(0.2f, {0.8f, 0.4f, 0.2f, 1}), tilted(2.5), at_scale(s))), v);
    };
    const Layer coarse = draw(scale), full = draw(1);
    ASSERT_EQ(coarse.rect, full.rect);
    for (std::size_t i = 0; i < full.rgba.size(); ++i) {
      // Rounded to 8 bits once more, in the coarse picture, whose rim fades.
      ASSERT_NEAR(coarse.rgba[i], full.rgba[i], 1) << scale << ": " << i;
    }
  }
}

// Red before green on nothing: whatever is mixed there is mixed by the full resolution's coverage.
TEST_F(ShadingScale, EdgesTakeNoColourFromOtherObjectsOrTheBackground) {
  const View v = view(320, 240, 300);
  const auto draw = [&v](int scale) {
    return drawn(scene_of(toon(sphere(4, red), moved(0.05, 0.02, 2) * scaled(0.25), at_scale(scale, 3)),
                          toon(sphere(4, green), moved(-0.1, 0.1, 3) * scaled(0.6), at_scale(scale, 3))),
                 v);
  };
  const Layer full = draw(1);
  for (const int scale : {2, 3}) {
    const Layer coarse = draw(scale);
    expect_same_coverage(coarse, full, "red before green ");
    for (std::size_t i = 0; i < full.rgba.size(); i += 4) {
      if (full.rgba[i] == 0) {
        ASSERT_EQ(coarse.rgba[i], 0) << "red where there is none";
      }
      // Green shows where red doesn't: in pixels that red covers it is 0, and was it mixed in by a half, by a texel's
      // width, it would be 60 and more.
      if (full.rgba[i + 1] == 0) {
        ASSERT_EQ(coarse.rgba[i + 1], 0) << "green where there is none";
      }
      // No darkening towards nothing: premultiplied colours stay within the bands', at least the darkest.
      const double darkest = 0.59 * full.rgba[i + 3] - 2;  // shade_colour's green is 0.6, its red 0.62; rounding
      ASSERT_GE(coarse.rgba[i] + coarse.rgba[i + 1], darkest);
    }
  }
}

// A pole before a wall in one mesh: the wall's colour stays out of the pole and the other way round.
TEST_F(ShadingScale, PartsOfOneObjectAtOtherDepthsKeepTheirColours) {
  const View v = view(200, 200, 400);
  mesh::Mesh mesh = square(green);
  mesh::Mesh pole = square(red);
  for (glm::vec3& p : pole.positions) p = glm::vec3(p.x * 0.1f, p.y * 0.7f, p.z);
  append(mesh, pole, {0.013f, 0, -0.3f});
  const auto draw = [&](int scale, double turn) {
    const glm::dmat4 place = moved(0, 0, 3) * glm::rotate(glm::dmat4(1), turn, {0, 0, 1}) * scaled(0.5);
    return drawn(scene_of(toon(mesh, place, at_scale(scale))), v);
  };
  for (const double turn : {0.0, 0.4, 0.9}) {
    const Layer full = draw(1, turn);
    for (const int scale : {2, 3}) {
      const Layer coarse = draw(scale, turn);
      expect_same_coverage(coarse, full, "pole ");
      int crisp = 0;
      for (std::size_t i = 0; i < full.rgba.size(); i += 4) {
        if (full.rgba[i + 3] != 255 || (full.rgba[i] != 255 && full.rgba[i + 1] != 255)) continue;
        ++crisp;
        // The wall lies 13 tolerances behind: the weight of its texels is 3e-5 of the pole's.
        ASSERT_NEAR(coarse.rgba[i], full.rgba[i], 1) << scale << ", " << turn << ": " << i / 4;
        ASSERT_NEAR(coarse.rgba[i + 1], full.rgba[i + 1], 1) << scale << ", " << turn << ": " << i / 4;
      }
      EXPECT_GT(crisp, 10000);
    }
  }
}

// Thinner than a texel: most of it lies between the texels' middles.
TEST_F(ShadingScale, ThinPartsHaveTheirColour) {
  const View v = view(200, 200, 400);
  for (const int scale : {2, 3, 4}) {
    for (const double turn : {0.0, 0.3, 0.7854}) {
      mesh::Mesh bar = cube({0.2f, 0.6f, 1.0f, 1});
      const glm::dmat4 place = moved(0.0013, 0, 2) * glm::rotate(glm::dmat4(1), turn, {0, 0, 1}) *
                               glm::scale(glm::dmat4(1), glm::dvec3(0.0025, 0.3, 0.0025));  // one pixel wide
      const Layer layer = drawn(scene_of(toon(bar, place, at_scale(scale))), v);
      ASSERT_GT(area_px(layer), 80);
      for (std::size_t i = 0; i < layer.rgba.size(); i += 4) {
        const double a = layer.rgba[i + 3];
        // Rounded to 8 bits in the coarse picture, where coverage is at least a half, and twice more by the feathers.
        ASSERT_NEAR(layer.rgba[i], 0.2 * a, 4) << scale << ", " << turn;
        ASSERT_NEAR(layer.rgba[i + 1], 0.6 * a, 4) << scale << ", " << turn;
        ASSERT_NEAR(layer.rgba[i + 2], a, 4) << scale << ", " << turn;
      }
    }
  }
}

// A colour that falls evenly is interpolated back.
TEST_F(ShadingScale, GradientsStaySmooth) {
  const View v = view(200, 200, 400);
  mesh::Mesh mesh = square();
  mesh.colours = {{0, 0, 0, 1}, {0, 1, 0, 1}, {1, 1, 0, 1}, {1, 0, 0, 1}};
  const auto draw = [&](int scale) {
    return drawn(scene_of(toon(mesh, moved(0, 0, 2) * scaled(0.4), at_scale(scale))), v);
  };
  const Layer full = draw(1);
  for (const int scale : {2, 3}) {
    const Layer coarse = draw(scale);
    for (int y = 25; y < 175; ++y) {
      for (int x = 25; x < 175; ++x) {
        // 1.6 levels a pixel; the weights that are never 0 pull by 0.3 %, 8 bits are rounded twice.
        ASSERT_NEAR(at(coarse, x, y)[0], at(full, x, y)[0], 2) << x << ", " << y;
        ASSERT_NEAR(at(coarse, x, y)[1], at(full, x, y)[1], 2) << x << ", " << y;
      }
    }
  }
}

// What is coloured where doesn't depend on where the rectangle begins: texels stand still in the picture.
TEST_F(ShadingScale, TexelsStandStillInThePicture) {
  const View v = view(300, 200, 300);
  mesh::Mesh stripes = square();
  stripes.materials[0].texture = 0;
  mesh::Texture texture;
  texture.width_px = 64, texture.height_px = 1;
  for (int i = 0; i < 64; ++i) {
    const std::uint8_t value = i % 2 == 0 ? 255 : 40;
    texture.rgba.insert(texture.rgba.end(), {value, value, value, 255});
  }
  stripes.textures = {texture};
  const auto draw = [&](std::vector<passes::StyledObject> more) {
    more.push_back(toon(stripes, moved(0, 0, 2) * scaled(0.3), at_scale(3)));
    return drawn(std::move(more), v);
  };
  const Layer alone = draw({});
  const Layer beside = draw(scene_of(toon(cube(red), moved(-0.7, -0.35, 2) * scaled(0.05))));
  ASSERT_NE(alone.rect, beside.rect);
  for (int y = 60; y < 140; ++y) {
    for (int x = 110; x < 190; ++x) ASSERT_EQ(at(alone, x, y), at(beside, x, y)) << x << ", " << y;
  }
}

}  // namespace
}  // namespace rinkaku::test

#include "outline/fluffy/pass/fluffy_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "mesh/topology.h"
#include "outline/fluffy/fur_textures.h"
#include "pipeline/passes/holdout/holdout_pass.h"
#include "tests/outline/fluffy/frames.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::test {
namespace {

using fluffy::CutMethod;
using fluffy::FluffyOptions;
using passes::Layer;
using passes::View;

class Fluffy : public GlTest {};

FluffyOptions options_for(CutMethod method, double angle_deg = 70) {
  FluffyOptions options;
  options.cut.method = method;
  options.cut.sine = fluffy::band_sine(angle_deg * std::numbers::pi / 180);
  options.cut.regions = {.cells = 4, .shells = 2, .inner_radii = 1.5};
  options.bands = 0;
  return options;
}

fluffy::TransmissionImage fur(int layers) {
  fluffy::TransmissionOptions options;
  options.layers = layers;
  options.contrast = 0;
  return fluffy::make_transmission(fluffy::fur_texture(fluffy::FurKind::Fur), options, "test");
}

// Opaque everywhere, in one layer.
fluffy::TransmissionImage solid(const std::array<std::uint8_t, 4>& rgba = {255, 255, 255, 255}) {
  fluffy::TransmissionImage image;
  image.width_px = image.height_px = image.layers = 1;
  image.rgba.assign(rgba.begin(), rgba.end());
  return image;
}

mesh::Mesh ball(int levels, const glm::vec3& colour = {1, 1, 1}) {
  mesh::Soup soup = sphere(levels);
  soup.materials[0].base_colour = glm::vec4(colour, 1);
  return mesh::assemble(std::move(soup), 60).mesh;
}

passes::StyledObject with_fluff(const mesh::Mesh& mesh, const glm::dmat4& place, const FluffyOptions& options,
                                const fluffy::TransmissionImage& image,
                                const fluffy::FrameOptions& frame_options = {}) {
  passes::StyledObject styled = toon(mesh, place);
  const fluffy::Frame frame = fluffy::make_frame(mesh, mesh::topology(mesh), glm::dmat3(place), frame_options, "test");
  styled.passes.insert(styled.passes.begin(),
                       std::make_unique<fluffy::FluffyPass>(*styled.object, frame, image, options));
  return styled;
}

glm::dmat4 turned(double turn_rad) {
  return moved(0.1, -0.05, 5) * glm::rotate(glm::dmat4(1), turn_rad, glm::normalize(glm::dvec3(1, 3, 2)));
}

// A solid frame p times as large as a ball covers what a ball of that size covers.
TEST_F(Fluffy, SolidFrameCoversTheScaledBallsDisc) {
  const View v = view(300, 300, 600);
  FluffyOptions options = options_for(CutMethod::Exact, 150);
  options.hang = {0, 0, 0};
  options.fade_from = 0.999f;
  const Layer layer = drawn(scene_of(with_fluff(ball(6), moved(0, 0, 5), options, solid())), v);
  const double exact = seen_sphere(v.camera, {0, 0, 5}, 1.1).area_px;
  // The frame's edge is not feathered: half a pixel, either way, along 2 pi 135 px averages out to well below 1 %.
  EXPECT_NEAR(area_px(layer), exact, 0.01 * exact);
}

TEST_F(Fluffy, PictureIsTheSameHoweverTheTrianglesWereFound) {
  const View v = view(160, 160, 300);
  const mesh::Mesh mesh = ball(4);
  const auto image = fur(4);
  for (const double turn : {0.0, 0.4, 2.0}) {
    const Layer uncut = drawn(scene_of(with_fluff(mesh, turned(turn), options_for(CutMethod::None), image)), v);
    EXPECT_GT(area_px(uncut), 0);
    for (const auto method : {CutMethod::Exact, CutMethod::Regions}) {
      const Layer cut = drawn(scene_of(with_fluff(mesh, turned(turn), options_for(method), image)), v);
      EXPECT_EQ(cut.rect, uncut.rect);
      // What is left out has opacity 0, so not one value may differ.
      EXPECT_EQ(cut.rgba, uncut.rgba);
    }
  }
}

// Sum of the change of coverage from one frame to the next, most over a turn.
double largest_change_px(const View& v, const mesh::Mesh& mesh, const fluffy::TransmissionImage& image,
                         const FluffyOptions& options, int steps, double step_rad) {
  std::vector<std::uint8_t> last, now;
  double most = 0;
  const passes::PixelRect picture = picture_of(v);
  for (int i = 0; i < steps; ++i) {
    const Layer layer = drawn(scene_of(with_fluff(mesh, turned(i * step_rad), options, image)), v);
    now.assign(static_cast<std::size_t>(picture.width_px) * picture.height_px, 0);
    for (int y = 0; y < layer.rect.height_px; ++y) {
      for (int x = 0; x < layer.rect.width_px; ++x) {
        now[static_cast<std::size_t>(layer.rect.y_px + y) * picture.width_px + layer.rect.x_px + x] =
            layer.rgba[(static_cast<std::size_t>(y) * layer.rect.width_px + x) * 4 + 3];
      }
    }
    double change = 0;
    for (std::size_t k = 0; k < last.size(); ++k) change += std::abs(now[k] - last[k]);
    most = std::max(most, change / 255);
    last = now;
  }
  return most;
}

// Coverage at the rim may not change faster than that of fluff which is drawn everywhere and doesn't fade.
TEST_F(Fluffy, NothingPopsUpDuringATurn) {
  const View v = view(96, 96, 200);
  const mesh::Mesh mesh = ball(3);
  const auto image = fur(3);
  FluffyOptions uncut = options_for(CutMethod::None, 179);
  uncut.fade_from = 0.9999f;
  constexpr double half_degree = std::numbers::pi / 360;
  const double cut_px = largest_change_px(v, mesh, image, options_for(CutMethod::Regions), 40, half_degree);
  const double uncut_px = largest_change_px(v, mesh, image, uncut, 40, half_degree);
  EXPECT_GT(cut_px, 0);
  EXPECT_LE(cut_px, 1.1 * uncut_px);
}

// White fluff on a white ball: whatever is averaged, no pixel gets darker than its coverage.
TEST_F(Fluffy, HasNoDarkOrBrightFringe) {
  FluffyOptions options = options_for(CutMethod::Exact);
  options.foot_shade = 1;
  for (const double focal_px : {60.0, 300.0}) {
    const Layer layer = drawn(scene_of(with_fluff(ball(4), turned(1), options, fur(6))), view(200, 200, focal_px));
    for (std::size_t i = 0; i < layer.rgba.size(); i += 4) {
      for (int c = 0; c < 3; ++c) {
        // Each of some dozen layers is rounded to 8 bits.
        ASSERT_NEAR(layer.rgba[i + static_cast<std::size_t>(c)], layer.rgba[i + 3], 6);
      }
    }
  }
}

TEST_F(Fluffy, HasTheBodysColourOrItsOwn) {
  const auto mean = [](const Layer& layer, int channel) {
    double colour = 0, alpha = 0;
    for (std::size_t i = 0; i < layer.rgba.size(); i += 4) {
      colour += layer.rgba[i + static_cast<std::size_t>(channel)];
      alpha += layer.rgba[i + 3];
    }
    return colour / alpha;
  };
  const View v = view(200, 200, 300);
  FluffyOptions options = options_for(CutMethod::Exact);
  options.foot_shade = 1;
  const Layer body = drawn(scene_of(with_fluff(ball(3, {0.2f, 0.6f, 1}), turned(0), options, fur(4))), v);
  EXPECT_NEAR(mean(body, 0), 0.2, 0.02);
  EXPECT_NEAR(mean(body, 1), 0.6, 0.02);
  options.colour = glm::vec3(1, 0, 0);
  const Layer own = drawn(scene_of(with_fluff(ball(3, {0, 0, 1}), turned(0), options, fur(4))), v);
  EXPECT_GT(mean(own, 0), 0.1);  // the rim is a good part of what is seen
  EXPECT_EQ(at(own, 100, 100)[0], 0);
  EXPECT_EQ(at(own, 100, 100)[2], 255);
}

TEST_F(Fluffy, ShadedSideOfFluffIsDarker) {
  FluffyOptions options = options_for(CutMethod::Exact);
  options.bands = 2;
  options.light = {-1, 0, 0};
  options.shade_colour = glm::vec3(0.5f);
  options.foot_shade = 1;
  const View v = view(200, 200, 300);
  const mesh::Mesh mesh = ball(4);
  const Layer layer = drawn(scene_of(with_fluff(mesh, moved(0, 0, 5), options, solid())), v);
  // Just outside of the ball, 61.2 px from the middle, and inside of the frame, 67.6 px.
  for (const auto& [x, brightness] : {std::pair(99 - 64, 1.0), std::pair(100 + 64, 0.5)}) {
    const Rgba pixel = at(layer, x, 100);
    ASSERT_GT(pixel[3], 20);
    EXPECT_NEAR(static_cast<double>(pixel[0]) / pixel[3], brightness, 0.03);
  }
}

TEST_F(Fluffy, IsHiddenByWhatStandsBeforeItWithASoftEdge) {
  const View v = view(200, 200, 300);
  const auto holdout = [](double x, double z) {
    passes::StyledObject styled;
    const mesh::Mesh mesh = mesh::assemble(cube(), 60).mesh;
    styled.object = std::make_unique<passes::DrawnObject>(
        passes::ObjectShape(mesh, moved(x, 0, z) * glm::rotate(glm::dmat4(1), 0.1, glm::dvec3(0, 0, 1)) * scaled(0.5)));
    styled.passes.push_back(std::make_unique<passes::HoldoutPass>(*styled.object));
    return styled;
  };
  FluffyOptions options = options_for(CutMethod::Exact, 150);
  options.fade_from = 0.9f;
  const auto ball_at = [&] { return with_fluff(ball(4), moved(0, 0, 5), options, solid()); };
  const Layer free = drawn(scene_of(ball_at()), v);
  const Layer hidden = drawn(scene_of(ball_at(), holdout(0.8, 3)), v);
  const Layer before = drawn(scene_of(ball_at(), holdout(0.8, 9)), v);
  EXPECT_EQ(before.rgba, free.rgba);
  // The holdout's near side reaches from about 40 to 160 px right of the middle.
  EXPECT_GT(at(free, 165, 100)[3], 200);
  EXPECT_EQ(at(hidden, 165, 100)[3], 0);
  int soft = 0;
  for (int y = 60; y < 140; ++y) {
    for (int x = 120; x < 150; ++x) soft += at(hidden, x, y)[3] > 20 && at(hidden, x, y)[3] < 235;
  }
  EXPECT_GT(soft, 20);  // along a slanted edge of 80 px most rows have a pixel in between
}

TEST_F(Fluffy, RimLineRunsAroundTheFluffAndNotOverTheBody) {
  const View v = view(200, 200, 300);
  FluffyOptions options = options_for(CutMethod::Exact);
  options.rim.emplace();
  options.rim->colour = {1, 0, 0};
  options.rim->width_px = 3;
  options.foot_shade = 1;
  const mesh::Mesh mesh = ball(4, {0, 0, 1});
  const Layer lined = drawn(scene_of(with_fluff(mesh, turned(0), options, fur(6))), v);
  options.rim.reset();
  const Layer plain = drawn(scene_of(with_fluff(mesh, turned(0), options, fur(6))), v);
  double red = 0;
  for (std::size_t i = 0; i < lined.rgba.size(); i += 4) red += lined.rgba[i];
  // The disc is 67 px in radius; a line three wide that is seen on its outer side only.
  EXPECT_GT(red / 255, 2 * 3.14159 * 67 * 1.0);
  EXPECT_GT(area_px(lined), area_px(plain) + 2 * 3.14159 * 67 * 1.5);
  EXPECT_EQ(at(lined, 100, 100), at(plain, 100, 100));
}

TEST_F(Fluffy, StaysWithinTheReachItTells) {
  const View v = view(400, 300, 300);
  FluffyOptions options = options_for(CutMethod::Exact);
  options.hang = {0, 2, 0};  // down in the picture, far
  fluffy::FrameOptions frame_options;
  frame_options.length_m = 0.3;
  for (const glm::dvec3& place : {glm::dvec3(0, 0, 5), glm::dvec3(2.2, 1, 4), glm::dvec3(-1, 1.5, 3)}) {
    const glm::dmat4 at_place = moved(place.x, place.y, place.z);
    // A layer of the whole picture holds all that is drawn.
    std::vector<passes::StyledObject> alone = scene_of(with_fluff(ball(4), at_place, options, fur(4), frame_options));
    std::vector<passes::StyledObject> framed =
        scene_of(with_fluff(ball(4), at_place, options, fur(4), frame_options),
                 toon(ball(0), moved(-2.6, -1.9, 4) * scaled(0.05)), toon(ball(0), moved(2.6, 1.9, 4) * scaled(0.05)));
    const Layer small = drawn(std::move(alone), v), large = drawn(std::move(framed), v);
    for (int y = 20; y < 280; ++y) {
      for (int x = 30; x < 370; ++x) {
        if (x >= small.rect.x_px && x < small.rect.right_px() && y >= small.rect.y_px && y < small.rect.bottom_px()) {
          continue;
        }
        ASSERT_EQ(at(large, x, y)[3], 0) << x << ", " << y;
      }
    }
  }
}

TEST_F(Fluffy, FarAwayItFadesIntoTheBodysSizeWithoutNoise) {
  // Averaged, coverage only falls with the square of the distance: tufts below a pixel neither vanish nor swell.
  FluffyOptions options = options_for(CutMethod::Exact);
  const mesh::Mesh mesh = ball(4);
  const auto image = fur(8);
  std::vector<double> shares;
  for (const double distance : {10.0, 20.0, 40.0}) {
    const View v = view(200, 200, 600);
    const Layer layer = drawn(scene_of(with_fluff(mesh, moved(0.01, 0.02, distance), options, image)), v);
    shares.push_back(area_px(layer) / seen_sphere(v.camera, {0.01, 0.02, distance}, 1).area_px);
  }
  for (const double share : shares) {
    EXPECT_GT(share, 1.02);
    EXPECT_LT(share, 1.21);  // the whole frame
    EXPECT_NEAR(share, shares[0], 0.03) << shares[0];
  }
}

}  // namespace
}  // namespace rinkaku::test

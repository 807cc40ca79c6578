// Objects that move must look like objects that stand so.
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "mesh/moving_mesh.h"
#include "outline/pass/hull_pass.h"
#include "tests/mesh/rigs.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

class Animated : public GlTest {};

// Below the size from which on what stands still has levels of detail.
constexpr int around = 16, along = 12;

passes::ToonOptions lit() {
  passes::ToonOptions options;
  options.light = {-1, -1, -1};
  return options;
}

// The lower half red, the upper one blue.
Rigged two_coloured_cylinder() {
  mesh::Soup soup = bending_cylinder_soup(around, along);
  soup.materials.resize(2);
  soup.materials[0].base_colour = {1, 0, 0, 1};
  soup.materials[1].base_colour = {0, 0, 1, 1};
  const auto count = static_cast<std::uint32_t>(soup.triangles.size());
  const std::uint32_t half = count / 2 / (2 * around) * (2 * around);
  soup.parts = {{"lower", 0, half, 0}, {"upper", half, count - half, 1}};
  return assembled(std::move(soup));
}

// Standing upright before the camera, which has y down, seen a little from the side and above.
glm::dmat4 upright() {
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1), glm::radians(200.0), glm::dvec3(1, 0.2, 0.1));
  return moved(0.3, 0.8, 5) * turned;
}

passes::StyledObject styled(const mesh::Mesh& mesh, const glm::dmat4& place, const Rigged* moving,
                            passes::Skinning skinning = passes::Skinning::Auto) {
  passes::ObjectShape shape(mesh, place, passes::band_borders(mesh, place, lit()));
  if (moving != nullptr) shape.animate(mesh, moving->rig, {});
  passes::StyledObject styled;
  styled.object = std::make_unique<passes::DrawnObject>(std::move(shape), skinning);
  styled.passes.push_back(std::make_unique<passes::ToonPass>(*styled.object, mesh, lit()));
  outline::HullOptions line;
  line.look.width_px = 4;
  styled.passes.push_back(std::make_unique<outline::HullPass>(*styled.object, line));
  return styled;
}

View view_at(double time_s) {
  View v = view(200, 160, 200);
  v.time_s = time_s;
  return v;
}

mesh::Mesh standing_at(const Rigged& rigged, double time_s) {
  mesh::MovingMesh movement(rigged.mesh, mesh::topology(rigged.mesh), rigged.rig, {});
  movement.move_to(time_s);
  return posed(rigged.mesh, movement.skin());
}

// The sum of all channels' differences, where 1 is one channel from nothing to full in one pixel.
double difference_px(const Layer& a, const Layer& b) {
  double sum = 0;
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 200; ++x) {
      const Rgba p = at(a, x, y), q = at(b, x, y);
      for (std::size_t c = 0; c < 4; ++c) sum += std::abs(p[c] - q[c]) / 255.0;
    }
  }
  return sum;
}

void expect_alike(const Rigged& rigged, const glm::dmat4& place) {
  for (const double time_s : {0.0, 0.3, 0.6, 0.9}) {
    const Layer moving = drawn(scene_of(styled(rigged.mesh, place, &rigged)), view_at(time_s));
    const Layer still = drawn(scene_of(styled(standing_at(rigged, time_s), place, nullptr)), view_at(0));
    ASSERT_GT(area_px(still), 1500);
    // Outline normals go with the bones instead of being measured anew, which turns them by some degrees in the bend,
    // so that along the shape's 400 px the line's rim may lie some hundredths of a pixel elsewhere, in four channels.
    EXPECT_NEAR(area_px(moving), area_px(still), 12) << "at " << time_s;
    EXPECT_LT(difference_px(moving, still), 60) << "at " << time_s;
    const Layer rest = drawn(scene_of(styled(rigged.mesh, place, nullptr)), view_at(0));
    EXPECT_GT(difference_px(rest, still), time_s > 0 ? 1000 : -1) << "it must have moved for this to mean anything";
  }
}

TEST_F(Animated, LooksLikeWhatStandsSo) { expect_alike(bending_cylinder(around, along), upright()); }

TEST_F(Animated, BordersBetweenMaterialsMoveAlong) { expect_alike(two_coloured_cylinder(), upright()); }

TEST_F(Animated, UnevenlyScaledAndMirroredObjectsMoveAsWell) {
  expect_alike(two_coloured_cylinder(), upright() * glm::scale(glm::dmat4(1), glm::dvec3(-1.3, 1, 0.8)));
}

TEST_F(Animated, PiecesThatCutThroughEachOtherKeepTheirLine) {
  // A second cylinder lies across the first one's foot, and goes with it.
  mesh::Soup soup = bending_cylinder_soup(around, along - 2);
  const auto count = static_cast<std::uint32_t>(soup.positions.size());
  const mesh::Soup other = bending_cylinder_soup(around, 2);
  for (const glm::vec3& p : other.positions) {
    soup.positions.emplace_back(p.y - 1, p.x + 0.31f, p.z * 0.8f + 0.05f);
    soup.rig.bind_points.push_back(soup.positions.back());
    soup.rig.influences.push_back({0, 1.0f});
    soup.rig.first_influence.push_back(static_cast<std::uint32_t>(soup.rig.influences.size()));
  }
  for (const glm::uvec3& t : other.triangles) soup.triangles.emplace_back(count + t.x, count + t.z, count + t.y);
  soup = one_part(std::move(soup));
  soup.rig.animations = {still(0, {0.2f, 0, 0.1f}, glm::angleAxis(0.7f, glm::vec3(0, 1, 0)), glm::vec3(1))};
  const Rigged crossed = assembled(std::move(soup));
  EXPECT_TRUE(passes::ObjectShape(crossed.mesh, upright()).intersects_itself());
  const Layer moving = drawn(scene_of(styled(crossed.mesh, upright(), &crossed)), view_at(0));
  const Layer standing = drawn(scene_of(styled(standing_at(crossed, 0), upright(), nullptr)), view_at(0));
  // It moved as a whole, so everything is the same but for rounding, which may turn single pixels.
  EXPECT_LT(difference_px(moving, standing), 8);
  const Layer rest = drawn(scene_of(styled(crossed.mesh, upright(), nullptr)), view_at(0));
  EXPECT_GT(difference_px(rest, standing), 500);
}

TEST_F(Animated, PictureDependsOnTheTimeAlone) {
  const Rigged cylinder = bending_cylinder(around, along);
  passes::LayerRenderer renderer(scene_of(styled(cylinder.mesh, upright(), &cylinder)), picture_of(view_at(0)));
  Layer straight, jumping;
  renderer.draw(view_at(0.4), straight);
  for (const double time_s : {7.9, 0.1, -2.0, 0.4}) renderer.draw(view_at(time_s), jumping);
  EXPECT_EQ(straight.rgba, jumping.rgba);
}

TEST_F(Animated, PictureIsTheSameWhereverVerticesAreMade) {
  const Rigged cylinder = two_coloured_cylinder();
  const glm::dmat4 uneven = upright() * glm::scale(glm::dmat4(1), glm::dvec3(-1.3, 1, 0.8));
  for (const glm::dmat4& place : {upright(), uneven}) {
    passes::LayerRenderer by_cpu(scene_of(styled(cylinder.mesh, place, &cylinder, passes::Skinning::Cpu)),
                                 picture_of(view_at(0)));
    passes::LayerRenderer by_gpu(scene_of(styled(cylinder.mesh, place, &cylinder, passes::Skinning::Gpu)),
                                 picture_of(view_at(0)));
    for (const double time_s : {0.2, 0.7, 0.4}) {
      Layer cpu, gpu;
      by_cpu.draw(view_at(time_s), cpu);
      by_gpu.draw(view_at(time_s), gpu);
      ASSERT_GT(area_px(cpu), 1500);
      // Positions agree to the last bit, and normals to one part in 32767: that moves the border of a band of light, or
      // the rim, by some 1/32767 of a ball's size, less than one step of 255 where a pixel is covered in part, so that
      // rounding may turn single steps and nothing else.
      for (int y = 0; y < 160; ++y) {
        for (int x = 0; x < 200; ++x) {
          const Rgba p = at(cpu, x, y), q = at(gpu, x, y);
          for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(p[c], q[c], 1) << x << ", " << y << " at " << time_s;
        }
      }
    }
  }
}

TEST_F(Animated, RectangleFollowsTheShape) {
  const Rigged cylinder = bending_cylinder(around, along);
  passes::ObjectShape shape(cylinder.mesh, moved(0, -1, 5));
  shape.animate(cylinder.mesh, cylinder.rig, {});
  const View v = view_at(0), bent = view_at(0.999);
  const passes::PixelRect straight = shape.look(v, picture_of(v)).bounds;
  const passes::PixelRect turned = shape.look(bent, picture_of(v)).bounds;
  // Upright 2 m, 0.6 m wide, its nearest parts at 4.7 m and 200 px; turned by 90 degrees at its middle to -x. Bounds
  // are whole pixels and one more.
  EXPECT_NEAR(straight.height_px, 2 * 200 / 4.7 + 1, 2);
  EXPECT_NEAR(straight.width_px, 0.6 * 200 / 5.0 + 1, 3);
  EXPECT_LT(turned.x_px, straight.x_px - 20);
  EXPECT_LT(turned.height_px, straight.height_px - 20);
}

}  // namespace
}  // namespace rinkaku::test

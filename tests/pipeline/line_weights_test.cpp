// What lines weigh: widths by paint, by an image, by material and by light.
#include "pipeline/objects/line_weights.h"

#include <cmath>
#include <filesystem>

#include <unistd.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "mesh/topology.h"
#include "pipeline/frame/error.h"
#include "pipeline/objects/outline_passes.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

pipeline::ObjectScene with(const pipeline::LineWeightScene& weight) {
  pipeline::ObjectScene object;
  object.mesh = "thing.glb";
  object.outline.emplace();
  object.outline->weight = weight;
  return object;
}

TEST(LineWeights, ArePaintedOnVertices) {
  mesh::Mesh block = cube();
  for (const glm::vec3& p : block.positions) block.colours.emplace_back(0.2f, p.y > 0 ? 1.0f : 0.25f, 0.7f, 1.0f);
  pipeline::LineWeightScene weight;
  weight.paint = 1;
  const std::vector<float> found = line_weights(with(weight), block);
  ASSERT_EQ(found.size(), 8u);
  for (std::size_t v = 0; v < block.positions.size(); ++v) {
    EXPECT_FLOAT_EQ(found[block.welded[v]], block.positions[v].y > 0 ? 1.0f : 0.25f);
  }
  block.colours.clear();
  EXPECT_THROW(line_weights(with(weight), block), Error);
}

TEST(LineWeights, AreAnImagesBrightness) {
  // From black on the left to white on the right; 201 texels so that the middle one is half as bright.
  cv::Mat ramp(3, 201, CV_8UC3);
  for (int x = 0; x < 201; ++x) ramp.col(x).setTo(cv::Scalar::all(x * 255.0 / 200));
  const auto file = std::filesystem::temp_directory_path() / ("ramp" + std::to_string(::getpid()) + ".png");
  cv::imwrite(file.string(), ramp);
  mesh::Mesh leaf = square();
  leaf.uvs.clear();
  for (const glm::vec3& p : leaf.positions) leaf.uvs.emplace_back(0.5f + 0.25f * p.x, 0.5f);
  pipeline::LineWeightScene weight;
  weight.map = file;
  const std::vector<float> found = line_weights(with(weight), leaf);
  std::filesystem::remove(file);
  for (std::size_t v = 0; v < leaf.positions.size(); ++v) {
    EXPECT_NEAR(found[leaf.welded[v]], leaf.uvs[v].x, 0.01) << "8 bits, and texels of 1/201";
  }
  weight.map = "gone.png";
  EXPECT_THROW(line_weights(with(weight), leaf), Error);
}

TEST(LineWeights, AreAMaterialsAndMeetInTheMiddle) {
  mesh::Mesh two = cube();
  two.materials.push_back(two.materials[0]);
  two.materials[0].name = "sides", two.materials[1].name = "lid";
  // The cube's faces are two triangles each; those with y = 1 are its fourth.
  two.parts = {{"a", 0, 6, 0}, {"b", 6, 2, 1}, {"c", 8, 4, 0}};
  pipeline::LineWeightScene weight;
  weight.materials = {{"lid", 3}};
  const std::vector<float> found = line_weights(with(weight), two);
  for (std::size_t v = 0; v < two.positions.size(); ++v) {
    const float here = found[two.welded[v]];
    if (two.positions[v].y < 0) {
      EXPECT_FLOAT_EQ(here, 1);
    } else {
      EXPECT_GT(here, 1.2);
      EXPECT_LT(here, 2.5);
    }
  }
  weight.materials = {{"lod", 3}};
  try {
    line_weights(with(weight), two);
    FAIL() << "there is no material of that name";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'sides', 'lid'"), std::string::npos) << error.what();
  }
}

// Towards the light as wide as asked for, away from it 1 + shade times, half of that at right angles; and the same of
// an object that moves, whose points are named several times.
TEST(LineWeights, LinesAreThickerAwayFromTheLight) {
  const mesh::Mesh ball = sphere(3);
  pipeline::OutlineScene line;
  line.weight.shade = 2;
  pipeline::LineSurroundings around;
  around.world_from_object = glm::rotate(glm::dmat4(1), 0.7, {0, 0, 1});
  around.light = {0, 5, 0};
  std::vector<float> still;
  line_style(ball, line, around, still);
  const mesh::Topology topology = mesh::topology(ball);
  ASSERT_EQ(still.size(), topology.points.size());
  for (std::size_t p = 0; p < still.size(); ++p) {
    const double lit = (around.world_from_object * glm::dvec4(topology.points[p], 0)).y;
    // Outline normals of a ball of 1280 triangles are its own within a hundredth.
    EXPECT_NEAR(still[p], 1 + 2 * (1 - lit) / 2, 0.02);
  }
  around.moves = true;
  std::vector<float> none, moved(still.size(), -1.0f);
  const passes::LineStyle style = line_style(ball, line, around, none);
  EXPECT_FLOAT_EQ(style.most_factor, 3);
  for (int frame = 0; frame < 2; ++frame) {
    style.follow({topology.points, topology.outline_normals, std::vector<std::uint32_t>{5, 9, 5, 40}, moved});
    for (const std::uint32_t p : {5u, 9u, 40u}) EXPECT_FLOAT_EQ(moved[p], still[p]);
    EXPECT_EQ(moved[6], -1) << "nobody asked for it";
  }
}

// A ball of radius 1, 3 m across in the scene: half of its thickness, as rays at 20 degrees see it; at rest or moving.
TEST(LineWeights, WhatCurvatureAddsIsAPartOfTheThickness) {
  const mesh::Mesh ball = sphere(4);
  pipeline::OutlineScene line;
  line.method = pipeline::LineMethod::Curvature;
  pipeline::LineSurroundings around;
  around.world_from_object = glm::scale(glm::dmat4(1), glm::dvec3(1.5));
  std::vector<float> factors;
  for (const bool moves : {false, true}) {
    around.moves = moves;
    const passes::LineStyle style = line_style(ball, line, around, factors);
    ASSERT_EQ(style.most_added_m.size(), ball.point_count);
    // Normals lean by half a triangle, some 3 degrees: 2 % of a ray.
    for (const float added : style.most_added_m) EXPECT_NEAR(added, 1.5 * std::cos(0.349), 0.05);
  }
  line.thickness_part = 0;
  EXPECT_TRUE(line_style(ball, line, around, factors).most_added_m.empty());
  line.method = pipeline::LineMethod::Uniform, line.thickness_part = 1;
  EXPECT_TRUE(line_style(ball, line, around, factors).most_added_m.empty());
}

}  // namespace
}  // namespace rinkaku::test

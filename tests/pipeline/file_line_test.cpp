// Outlines that the mesh's own file asks for.
#include "pipeline/objects/file_line.h"

#include <fstream>

#include <gtest/gtest.h>

#include "pipeline/objects/line_weights.h"
#include "tests/pipeline/passes/shapes.h"
#include "tests/support/test_data.h"

namespace rinkaku::test {
namespace {

using mesh::MaterialLine;
using Unit = MaterialLine::Unit;

// The cube's twelve triangles: eight of skin, two of hair, two of an eye without a line.
mesh::Mesh figure(Unit unit, Unit of_hair) {
  mesh::Mesh mesh = cube();
  mesh.materials.resize(3, mesh.materials[0]);
  mesh.materials[0].name = "skin", mesh.materials[1].name = "hair", mesh.materials[2].name = "eye";
  mesh.materials[0].line = {unit, 0.01f, {0.5f, 0.25f, 0}};
  mesh.materials[1].line = {of_hair, 0.02f, {0, 0, 1}};
  mesh.materials[2].line = {Unit::None, 0, {}};
  mesh.parts = {{"a", 0, 8, 0}, {"b", 8, 2, 1}, {"c", 10, 2, 2}};
  return mesh;
}

pipeline::ObjectScene outlined() {
  pipeline::ObjectScene object;
  object.mesh = "figure.vrm";
  object.outline.emplace();
  return object;
}

TEST(FileLine, IsTakenWhereTheSceneSaysNothing) {
  const pipeline::ObjectScene object = with_file_line(outlined(), figure(Unit::Metres, Unit::Metres), 0.5, {});
  ASSERT_TRUE(object.outline->width_m);
  EXPECT_NEAR(*object.outline->width_m, 0.01, 1e-8);  // a unit of the mesh is half a metre
  ASSERT_EQ(object.outline->weight.of_file.size(), 3u);
  EXPECT_NEAR(object.outline->weight.of_file[0], 0.5, 1e-6);
  EXPECT_EQ(object.outline->weight.of_file[1], 1);
  EXPECT_EQ(object.outline->weight.of_file[2], 0);
  EXPECT_NEAR(object.outline->colour[1], 0.25, 1e-6);
}

TEST(FileLine, SceneOverridesWidthAndColour) {
  pipeline::ObjectScene object = outlined();
  object.outline->own_width = object.outline->own_colour = true;
  object.outline->width_px = 5;
  object = with_file_line(std::move(object), figure(Unit::Metres, Unit::Metres), 1, {});
  EXPECT_FALSE(object.outline->width_m);
  EXPECT_EQ(object.outline->width_px, 5);
  EXPECT_TRUE(object.outline->weight.of_file.empty());
  EXPECT_EQ(object.outline->colour, pipeline::OutlineScene{}.colour);
}

TEST(FileLine, MaterialsOfTheSceneCountBeforeTheFiles) {
  const mesh::Mesh mesh = figure(Unit::Metres, Unit::Metres);
  pipeline::ObjectScene object = outlined();
  for (const char* name : {"skin", "hair", "eye"}) object.outline->weight.materials.push_back({name, 1.5});
  object = with_file_line(std::move(object), mesh, 1, {});
  for (const float weight : line_weights(object, mesh)) EXPECT_FLOAT_EQ(weight, 1.5f);
}

TEST(FileLine, PartsOfThePictureAreItsCamerasPixels) {
  const TemporaryFolder folder;
  std::ofstream(folder / "camera.yml") << "%YAML:1.0\n---\nimage_width: 1280\nimage_height: 720\n"
                                          "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                                          "   data: [ 900., 0., 640., 0., 900., 360., 0., 0., 1. ]\n"
                                          "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
                                          "   data: [ 0., 0., 0., 0., 0. ]\n";
  const mesh::Mesh mesh = figure(Unit::PictureHeights, Unit::Metres);
  const pipeline::ObjectScene object = with_file_line(outlined(), mesh, 1, folder / "camera.yml");
  EXPECT_FALSE(object.outline->width_m);
  EXPECT_NEAR(object.outline->width_px, 7.2, 1e-4);
  EXPECT_EQ(object.outline->weight.of_file[1], 1);  // in another unit than most of the surface
}

// A texture black on the left and green on the right: the skin's width there, and nobody else's.
TEST(FileLine, WidthTextureMultipliesTheWidth) {
  mesh::Mesh mesh = figure(Unit::Metres, Unit::Metres);
  mesh.textures.push_back({2, 1, {255, 0, 0, 255, 255, 255, 0, 255}});
  for (const glm::vec3& p : mesh.positions) mesh.uvs.emplace_back(p.x < 0 ? 0.25f : 0.75f, 0.5f);
  for (std::size_t m : {0u, 1u}) mesh.materials[m].line->width = 0.01f;
  mesh.materials[2].line = mesh.materials[1].line;
  const std::vector<float> even = line_weights(with_file_line(outlined(), mesh, 1, {}), mesh);
  EXPECT_TRUE(even.empty()) << "one width for all";
  for (mesh::Material& material : mesh.materials) {
    material.line->width_texture = 0;
    material.line->width_channel = 1;
  }
  const std::vector<float> weights = line_weights(with_file_line(outlined(), mesh, 1, {}), mesh);
  ASSERT_EQ(weights.size(), mesh.point_count);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_NEAR(weights[mesh.welded[v]], mesh.positions[v].x < 0 ? 0.002f : 1, 1e-6) << "not below what can't be seen";
  }
}

TEST(FileLine, LightingMixesWithTheSurfacesColour) {
  mesh::Mesh mesh = figure(Unit::Metres, Unit::Metres);
  mesh.materials[0].base_colour = {1, 0.5f, 0, 1};
  mesh.materials[0].line->colour = {1, 1, 1};
  const auto ink = [&](float mix) {
    mesh.materials[0].line->lit = mix;
    return with_file_line(outlined(), mesh, 1, {}).outline->colour;
  };
  EXPECT_EQ(ink(0), (std::array<double, 3>{1, 1, 1}));
  EXPECT_NEAR(ink(1)[1], 0.5, 1e-6);
  EXPECT_NEAR(ink(1)[2], 0, 1e-6);
  EXPECT_NEAR(ink(0.5f)[2], 0.7354, 1e-3);  // sRGB of linear 0.5
}

TEST(FileLine, AbsurdWidthsAreThoseThatAScenesLimitsAllow) {
  mesh::Mesh mesh = figure(Unit::Metres, Unit::Metres);
  for (mesh::Material& material : mesh.materials) {
    if (material.line) material.line->width = 1e30f;
  }
  EXPECT_EQ(with_file_line(outlined(), mesh, 1, {}).outline->width_m, 1000);
}

TEST(FileLine, MeshesThatSayNothingChangeNothing) {
  mesh::Mesh mesh = figure(Unit::None, Unit::None);
  const pipeline::ObjectScene object = with_file_line(outlined(), mesh, 1, {});
  EXPECT_EQ(object.outline->width_px, 3);
  EXPECT_FALSE(object.outline->width_m);
  EXPECT_TRUE(object.outline->weight.of_file.empty());
  pipeline::ObjectScene without;
  EXPECT_FALSE(with_file_line(without, figure(Unit::Metres, Unit::Metres), 1, {}).outline);
}

}  // namespace
}  // namespace rinkaku::test

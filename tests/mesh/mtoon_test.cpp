// What a VRM's materials say about outlines.
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>

#include "mesh/import.h"
#include "tests/support/test_data.h"

namespace rinkaku::mesh {
namespace {

using Unit = MaterialLine::Unit;

// A binary glTF of three triangles, each of its own material, used in the order third, first, second.
std::string glb_of(const std::string& materials, const std::string& extensions = "{}", const std::string& views = "",
                   const std::string& pictures = "", const std::string& more_bytes = "") {
  std::string primitives;
  for (const char* material : {"2", "0", "1"}) {
    primitives +=
        std::string(primitives.empty() ? "" : ",") + R"({"attributes":{"POSITION":0},"material":)" + material + "}";
  }
  std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
                     R"("meshes":[{"primitives":[)" +
                     primitives + R"(]}],"buffers":[{"byteLength":)" + std::to_string(36 + more_bytes.size()) + "}]," +
                     pictures + R"("bufferViews":[{"buffer":0,"byteLength":36})" + views +
                     R"(],"accessors":[{"bufferView":0,)"
                     R"("componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],)"
                     R"("materials":[)" +
                     materials + R"(],"extensions":)" + extensions + "}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto number = [](std::size_t n) {
    const auto value = static_cast<std::uint32_t>(n);
    return std::string(reinterpret_cast<const char*>(&value), 4);
  };
  std::string binary = std::string(reinterpret_cast<const char*>(triangle), 36) + more_bytes;
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  return "glTF" + number(2) + number(12 + 8 + json.size() + 8 + binary.size()) + number(json.size()) + "JSON" + json +
         number(binary.size()) + std::string("BIN\0", 4) + binary;
}

class MtoonLine : public testing::Test {
 protected:
  Mesh load(const std::string& glb, const char* name = "figure.vrm") {
    std::ofstream(folder_ / name, std::ios::binary) << glb;
    return import(folder_ / name).mesh;
  }
  static const Material& named(const Mesh& mesh, const std::string& name) {
    for (const Material& material : mesh.materials) {
      if (material.name == name) return material;
    }
    ADD_FAILURE() << name;
    return mesh.materials[0];
  }
  test::TemporaryFolder folder_;
};

TEST_F(MtoonLine, OfVrm1CountsInMetresAndPictureHeightsWithLinearColours) {
  const std::string mtoon = R"("extensions":{"VRMC_materials_mtoon":{"specVersion":"1.0",)";
  const std::string file =
      glb_of(R"({"name":"skin",)" + mtoon +
             R"("outlineWidthMode":"worldCoordinates","outlineWidthFactor":0.004,"outlineColorFactor":[1,0.5,0]}}},)"
             R"({"name":"hair",)" +
             mtoon +
             R"("outlineWidthMode":"screenCoordinates","outlineWidthFactor":0.01}}},)"
             R"({"name":"eye",)" +
             mtoon + R"("outlineWidthMode":"none","outlineWidthFactor":0.02}}})");
  for (const char* name : {"figure.vrm", "figure.glb"}) {
    const Mesh mesh = load(file, name);
    const Material &skin = named(mesh, "skin"), &hair = named(mesh, "hair"), &eye = named(mesh, "eye");
    ASSERT_TRUE(skin.line && hair.line && eye.line);
    EXPECT_EQ(skin.line->unit, Unit::Metres);
    EXPECT_FLOAT_EQ(skin.line->width, 0.004f);
    EXPECT_FLOAT_EQ(skin.line->colour.r, 1);
    EXPECT_NEAR(skin.line->colour.g, 0.7354, 1e-3);  // sRGB of linear 0.5
    EXPECT_EQ(hair.line->unit, Unit::PictureHeights);
    EXPECT_FLOAT_EQ(hair.line->width, 0.01f);
    EXPECT_EQ(eye.line->unit, Unit::None);
    EXPECT_EQ(eye.line->width, 0);
  }
}

// VRM 0.x: hundredths of a metre and of half the picture's height; colours are sRGB already.
TEST_F(MtoonLine, OfVrm0IsTheSameInItsOwnUnits) {
  const auto material = [](const char* name, const char* shader, const char* values) {
    return std::string(R"({"name":")") + name + R"(","shader":")" + shader + R"(","floatProperties":{)" + values +
           R"(},"vectorProperties":{"_OutlineColor":[0.5,0.25,0,1]}})";
  };
  const Mesh mesh =
      load(glb_of(R"({"name":"skin"},{"name":"hair"},{"name":"eye"})",
                  R"({"VRM":{"materialProperties":[)" +
                      material("skin", "VRM/MToon", R"("_OutlineWidthMode":1,"_OutlineWidth":0.4)") + "," +
                      material("hair", "VRM/MToon", R"("_OutlineWidthMode":2,"_OutlineWidth":0.4)") + "," +
                      material("eye", "VRM_USE_GLTFSHADER", R"("_OutlineWidthMode":1)") + "]}}"));
  const Material &skin = named(mesh, "skin"), &hair = named(mesh, "hair");
  ASSERT_TRUE(skin.line && hair.line);
  EXPECT_EQ(skin.line->unit, Unit::Metres);
  EXPECT_FLOAT_EQ(skin.line->width, 0.004f);
  EXPECT_FLOAT_EQ(skin.line->colour.g, 0.25f);
  EXPECT_EQ(hair.line->unit, Unit::PictureHeights);
  EXPECT_FLOAT_EQ(hair.line->width, 0.002f);
  EXPECT_FALSE(named(mesh, "eye").line);
}

// A picture of 2 x 1 texels in the file's binary chunk, as a PNG: green on the left, red on the right.
TEST_F(MtoonLine, WidthTexturesAndLightingAreRead) {
  const unsigned char png[] = {0x89, 'P', 'N', 'G', 13,  10,  26,  10,  0,   0,   0,    13,   'I',  'H',
                               'D',  'R', 0,   0,   0,   2,   0,   0,   0,   1,   8,    2,    0,    0,
                               0,    123, 64,  232, 221, 0,   0,   0,   13,  'I', 'D',  'A',  'T',  120,
                               156,  99,  96,  248, 15,  132, 12,  0,   7,   255, 1,    255,  59,   199,
                               117,  235, 0,   0,   0,   0,   'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
  const std::string picture(reinterpret_cast<const char*>(png), sizeof png);
  const std::string views = R"(,{"buffer":0,"byteOffset":36,"byteLength":)" + std::to_string(picture.size()) + "}";
  const std::string pictures = R"("images":[{"bufferView":1,"mimeType":"image/png"}],"textures":[{"source":0}],)";
  const std::string wide = R"("outlineWidthMode":"worldCoordinates","outlineWidthFactor":0.004)";
  const std::string mtoon = R"("extensions":{"VRMC_materials_mtoon":{)" + wide;
  const Mesh mesh = load(
      glb_of(R"({"name":"skin",)" + mtoon +
                 R"(,"outlineWidthMultiplyTexture":{"index":0},"outlineLightingMixFactor":0.25}}},{"name":"hair",)" +
                 mtoon + R"(,"outlineWidthMultiplyTexture":{"index":7}}}},{"name":"eye",)" + mtoon + "}}}",
             R"({"VRM":{"materialProperties":[]}})", views, pictures, picture));
  const MaterialLine skin = named(mesh, "skin").line.value();
  EXPECT_FLOAT_EQ(skin.lit, 0.25f);
  EXPECT_EQ(skin.width_channel, 1);
  ASSERT_GE(skin.width_texture, 0);
  const Texture& texture = mesh.textures.at(static_cast<std::size_t>(skin.width_texture));
  EXPECT_EQ(texture.width_px, 2);
  EXPECT_EQ(texture.rgba, (std::vector<std::uint8_t>{0, 255, 0, 255, 255, 0, 0, 255}));
  EXPECT_EQ(named(mesh, "hair").line->width_texture, -1) << "there is no such texture";
  EXPECT_EQ(named(mesh, "hair").line->lit, 1) << "as VRM 1.0 has it by default";
}

// One warning each for what isn't followed; none for the picture of a material without an outline.
TEST_F(MtoonLine, WhatIsNotReadOfWidthTexturesIsSaid) {
  const auto material = [](const char* name, const char* mode, const char* texture) {
    return std::string(R"({"name":")") + name + R"(","extensions":{"VRMC_materials_mtoon":{"outlineWidthMode":")" +
           mode + R"(","outlineWidthFactor":0.004,"outlineWidthMultiplyTexture":{)" + texture + "}}}}";
  };
  const std::string glb = glb_of(
      material("skin", "worldCoordinates", R"("index":0)") + "," +
          material("hair", "worldCoordinates", R"("index":1,"texCoord":1)") + "," +
          material("eye", "none", R"("index":1)"),
      R"({"VRM":{"materialProperties":[]}})", R"(,{"buffer":0,"byteLength":36})",
      R"("images":[{"uri":"wide.png"},{"bufferView":1,"mimeType":"image/png"}],"textures":[{"source":0},{"source":1}],)");
  std::ofstream(folder_ / "figure.glb", std::ios::binary) << glb;
  const Imported read = import(folder_ / "figure.glb");
  EXPECT_TRUE(read.mesh.textures.empty());
  std::string all;
  for (const std::string& warning : read.summary.warnings) all += warning + "\n";
  EXPECT_NE(all.find("of material 'skin' is no picture within the file"), std::string::npos) << all;
  EXPECT_NE(all.find("of material 'hair' uses texture coordinates 1"), std::string::npos) << all;
  EXPECT_EQ(all.find("'eye'"), std::string::npos) << all;
  for (const char* name : {"skin", "hair", "eye"}) EXPECT_EQ(named(read.mesh, name).line->width_texture, -1) << name;
}

TEST_F(MtoonLine, ValuesThatMakeNoSenseAreNoLine) {
  const std::string mtoon = R"("extensions":{"VRMC_materials_mtoon":{"outlineWidthMode":"worldCoordinates",)";
  const Mesh mesh = load(glb_of(R"({"name":"a",)" + mtoon + R"("outlineWidthFactor":-1}}},{"name":"b",)" + mtoon +
                                    R"("outlineWidthFactor":"wide","outlineColorFactor":[2,"x"]}}},)"
                                    R"({"name":"c","extensions":{"VRMC_materials_mtoon":7}})",
                                R"({"VRM":{"materialProperties":{"a":1}}})"));
  for (const char* name : {"a", "b"}) {
    ASSERT_TRUE(named(mesh, name).line) << name;
    EXPECT_EQ(named(mesh, name).line->unit, Unit::None) << name;
  }
  EXPECT_FALSE(named(mesh, "c").line);
}

TEST_F(MtoonLine, OfSomebodyElsesFiles) {
  RINKAKU_NEEDS_DATA();
  const Mesh old = import(test::data("meshes/vrm/univrm_EmissionMigration_v0.107.0.vrm")).mesh;
  ASSERT_TRUE(named(old, "MToon_Emission_0.5").line);
  EXPECT_EQ(named(old, "MToon_Emission_0.5").line->unit, Unit::None);
  EXPECT_FALSE(named(old, "Unlit_SRGB_0.5").line);
  EXPECT_TRUE(named(import(test::data("meshes/vrm/vrmspec_mtoon_UV_Animation_Test.vrm")).mesh, "ScrollX").line);
}

}  // namespace
}  // namespace rinkaku::mesh

#include <cstring>
#include <fstream>

#include <glm/geometric.hpp>

#include "mesh/bounds.h"
#include "mesh/import.h"
#include "tests/support/test_data.h"

namespace rinkaku::mesh {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

class ImportFormats : public testing::Test {
 protected:
  Imported load(const std::string& name, const std::string& text, const ImportOptions& options = {}) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return import(folder_ / name, options);
  }
  TemporaryFolder folder_;
};

glm::vec3 face_normal(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3& t = mesh.triangles[triangle];
  return glm::normalize(
      glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
}

/// A glTF of one triangle (0 0 0, 1 0 0, 0 1 0) facing +z, with a node's transform and whatever else.
std::string gltf_triangle(const std::string& node, const std::string& attributes = "", const std::string& more = "") {
  // positions 36 bytes, normals (0 0 1) 36 bytes, linear colours (0.5 0.5 0.5) 36 bytes
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + node +
         R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0)" + attributes + R"(})" + more +
         R"(}]}],"buffers":[{"byteLength":108,"uri":"data:application/octet-stream;base64,)"
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
         "AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"
         "AAAAPwAAAD8AAAA/AAAAPwAAAD8AAAA/AAAAPwAAAD8AAAA/"
         R"("}],"bufferViews":[{"buffer":0,"byteLength":108}],"accessors":[)"
         R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
         R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"},)"
         R"({"bufferView":0,"byteOffset":72,"componentType":5126,"count":3,"type":"VEC3"}],)"
         R"("materials":[{"name":"half","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,)"
         R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,0,1,0.75]}}]})";
}

TEST_F(ImportFormats, GltfNodeTransformsAreApplied) {
  const Mesh mesh = load("a.gltf", gltf_triangle(R"(,"translation":[10,0,0],"scale":[2,2,2])")).mesh;
  const Box box = bounding_box(mesh.positions);
  EXPECT_EQ(box.min, glm::vec3(10, 0, 0));
  EXPECT_EQ(box.max, glm::vec3(12, 2, 0));
}

TEST_F(ImportFormats, MirroredNodesKeepTheirOuterSideOut) {
  for (const char* attributes : {"", R"(,"NORMAL":1)"}) {
    const Mesh plain = load("a.gltf", gltf_triangle("", attributes)).mesh;
    EXPECT_NEAR(face_normal(plain, 0).z, 1, 1e-6);
    const Mesh mirrored = load("b.gltf", gltf_triangle(R"(,"scale":[-1,1,1])", attributes)).mesh;
    EXPECT_EQ(bounding_box(mirrored.positions).min.x, -1);
    EXPECT_NEAR(face_normal(mirrored, 0).z, 1, 1e-6) << "mirrored along x it still faces +z";
    EXPECT_NEAR(mirrored.normals[0].z, 1, 1e-6);
    const Mesh flipped = load("c.gltf", gltf_triangle(R"(,"scale":[1,1,-1])", attributes)).mesh;
    EXPECT_NEAR(face_normal(flipped, 0).z, -1, 1e-6) << "mirrored along z it faces -z";
    EXPECT_NEAR(flipped.normals[0].z, -1, 1e-6);
  }
}

TEST_F(ImportFormats, GltfMaterialsAreEncodedAndComplete) {
  const Mesh mesh = load("a.gltf", gltf_triangle("", "", R"(,"material":0)")).mesh;
  const Material& material = mesh.materials.at(mesh.parts.at(0).material);
  EXPECT_EQ(material.name, "half");
  EXPECT_NEAR(material.base_colour.r, 0.7354, 1e-3) << "sRGB encoding of 0.5";
  EXPECT_EQ(material.base_colour.g, 0);
  EXPECT_NEAR(material.base_colour.b, 1, 1e-6);
  EXPECT_NEAR(material.base_colour.a, 0.75, 1e-6);
  EXPECT_TRUE(material.two_sided);
  EXPECT_EQ(material.alpha, Material::Alpha::Mask);
  EXPECT_NEAR(material.alpha_cutoff, 0.25, 1e-6);
}

TEST_F(ImportFormats, GltfVertexColoursAreEncoded) {
  const Mesh mesh = load("a.gltf", gltf_triangle("", R"(,"COLOR_0":2)")).mesh;
  ASSERT_EQ(mesh.colours.size(), 3u);
  EXPECT_NEAR(mesh.colours[0].r, 0.7354, 1e-3);
  EXPECT_NEAR(mesh.colours[0].a, 1, 1e-6);
}

TEST_F(ImportFormats, GltfLinesAndPointsAreCountedAndLeftOut) {
  const std::string strip = R"(},{"attributes":{"POSITION":0},"mode":3},{"attributes":{"POSITION":0},"mode":0)";
  const Imported imported = load("a.gltf", gltf_triangle("", "", strip));
  EXPECT_EQ(imported.mesh.triangles.size(), 1u);
  EXPECT_EQ(imported.summary.dropped_lines, 2u);
  EXPECT_EQ(imported.summary.dropped_points, 3u);
}

/// A 1x2 picture, red above blue, as an uncompressed TGA stored from the top.
std::string red_above_blue() {
  std::string tga(18, '\0');
  tga[2] = 2;
  tga[12] = 1;
  tga[14] = 2;
  tga[16] = 24;
  tga[17] = 0x20;
  return tga + std::string("\x00\x00\xff\xff\x00\x00", 6);
}

TEST_F(ImportFormats, ObjTextureCoordinatesStartAtTheTopLeft) {
  std::ofstream(folder_ / "two.tga", std::ios::binary) << red_above_blue();
  std::ofstream(folder_ / "a.mtl") << "newmtl m\nKd 0 0 0\nmap_Kd two.tga\nd 1\n";
  const Imported imported = load("a.obj",
                                 "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                 "f 1/1 2/2 3/3\n");
  const Mesh& mesh = imported.mesh;
  EXPECT_TRUE(imported.summary.warnings.empty());
  ASSERT_EQ(mesh.textures.size(), 1u);
  EXPECT_EQ(mesh.textures[0].height_px, 2);
  EXPECT_EQ(mesh.textures[0].rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 255})) << "rows from the top";
  for (std::size_t v = 0; v < 3; ++v) {
    // OBJ's t = 1 is the picture's top, so it is our 0.
    EXPECT_NEAR(mesh.uvs[v].y, 1 - mesh.positions[v].y, 1e-6);
    EXPECT_NEAR(mesh.uvs[v].x, mesh.positions[v].x, 1e-6);
  }
  EXPECT_EQ(mesh.materials[0].base_colour, glm::vec4(1)) << "a black Kd must not black the texture out";
}

TEST_F(ImportFormats, MissingMaterialLibraryIsAWarning) {
  const Imported imported = load("a.obj", "mtllib none.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_EQ(imported.summary.warnings.size(), 1u);
  EXPECT_NE(imported.summary.warnings[0].find("none.mtl"), std::string::npos);
}

TEST_F(ImportFormats, ConcavePolygonsAreCutRight) {
  // An arrowhead, whose fan from the first corner would fold over.
  const Mesh mesh = load("a.off", "OFF\n4 1 0\n0 0 0\n2 -1 0\n0.5 0 0\n2 1 0\n4 0 1 2 3\n").mesh;
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(face_normal(mesh, 0).z, 1, 1e-6);
  EXPECT_NEAR(face_normal(mesh, 1).z, 1, 1e-6);
}

TEST_F(ImportFormats, OffVariantsAreRead) {
  const char* points = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(
      load("a.off", std::string("# first a comment\nOFF # and here\n\n3 1 0\n# more\n") + points + "3 0 1 2 255 0 0\n")
          .mesh.triangles.size(),
      1u);
  EXPECT_EQ(load("b.off", std::string("OFF 3 1 0\r\n") + points + "3 0 1 2\n").mesh.triangles.size(), 1u);
  const Mesh coloured =
      load("c.off", "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 255 0 0 255\n3 0 1 2\n").mesh;
  ASSERT_EQ(coloured.colours.size(), 3u);
  EXPECT_EQ(coloured.colours[0], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(coloured.materials[0].base_colour, glm::vec4(1));
  std::string binary = "OFF BINARY\n";
  const auto put = [&](auto value) {
    char bytes[4];
    std::memcpy(bytes, &value, 4);
    std::swap(bytes[0], bytes[3]);
    std::swap(bytes[1], bytes[2]);
    binary.append(bytes, 4);
  };
  for (const int n : {3, 1, 0}) put(n);
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) put(x);
  for (const int n : {3, 0, 1, 2, 0}) put(n);
  EXPECT_EQ(bounding_box(load("d.off", binary).mesh.positions).max, glm::vec3(1, 1, 0)) << "large end first";
}

TEST_F(ImportFormats, PlyWithColoursStripsAndUnknownElementsIsRead) {
  const std::string text =
      "ply\r\nformat ascii 1.0\r\nelement camera 1\r\nproperty float f\r\nelement vertex 5\r\nproperty double x\r\n"
      "property double y\r\nproperty double z\r\nproperty uchar red\r\nproperty uchar green\r\nproperty uchar blue\r\n"
      "element tristrips 1\r\nproperty list int int vertex_indices\r\nend_header\r\n"
      "7\n0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n1 1 0 255 0 0\n0 2 0 255 0 0\n"
      "9 0 1 2 3 -1 2 3 4 -1\n";
  const Mesh mesh = load("a.ply", text).mesh;
  ASSERT_EQ(mesh.triangles.size(), 3u);
  for (std::size_t t = 0; t < 3; ++t) EXPECT_NEAR(face_normal(mesh, t).z, 1, 1e-6) << "strips alternate";
  ASSERT_EQ(mesh.colours.size(), mesh.positions.size());
  EXPECT_EQ(mesh.colours[0], glm::vec4(1, 0, 0, 1));
}

TEST_F(ImportFormats, BinaryPlyWhoseDataLookLikeBlanksIsRead) {
  std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto put = [&](auto value) { header.append(reinterpret_cast<const char*>(&value), sizeof value); };
  // 0x0a0a0a0a and 0x20202020: line feeds and blanks as floats.
  for (const std::uint32_t x : {0x0a0a0a0au, 0u, 0u, 0x3f800000u, 0x20202020u, 0u, 0u, 0x3f800000u, 0u}) put(x);
  put(std::uint8_t{3});
  for (const int i : {0, 1, 2}) put(i);
  const Imported imported = load("a.ply", header);
  EXPECT_EQ(imported.mesh.triangles.size(), 1u);
  EXPECT_EQ(bounding_box(imported.mesh.positions).max, glm::vec3(1, 1, 0));
}

TEST_F(ImportFormats, PlyTextureCoordinatesPerCornerSplitVertices) {
  std::ofstream(folder_ / "two.tga", std::ios::binary) << red_above_blue();
  const Mesh mesh = load("a.ply",
                         "ply\nformat ascii 1.0\ncomment TextureFile two.tga\nelement vertex 4\nproperty float x\n"
                         "property float y\nproperty float z\nelement face 2\n"
                         "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
                         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                         "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0.5 0 1 1 0 1\n")
                        .mesh;
  EXPECT_EQ(mesh.point_count, 4u);
  EXPECT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.textures.size(), 1u);
}

TEST_F(ImportFormats, StlIsReadAsTextAndBinaryWithZUp) {
  const Imported text = load("a.stl",
                             "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                             "endloop\nendfacet\nendsolid a\n");
  EXPECT_EQ(text.mesh.triangles.size(), 1u);
  EXPECT_EQ(text.summary.up, 'z');
  std::string binary(80, ' ');
  const auto put = [&](auto value) { binary.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::uint32_t{1});
  for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) put(x);
  put(std::uint16_t{0});
  EXPECT_EQ(load("b.stl", binary).mesh.triangles.size(), 1u);
}

TEST_F(ImportFormats, NamesWithBlanksAndOtherLettersWork) {
  EXPECT_EQ(load("輪 郭 #1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").mesh.triangles.size(), 1u);
  EXPECT_EQ(load("LOUD.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").summary.format, "OBJ");
}

}  // namespace
}  // namespace rinkaku::mesh

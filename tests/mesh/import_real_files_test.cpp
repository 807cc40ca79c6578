#include <fstream>

#include <sys/resource.h>

#include <glm/geometric.hpp>

#include "mesh/bounds.h"
#include "mesh/import.h"
#include "mesh/inspect.h"
#include "pipeline/frame/error.h"
#include "tests/support/test_data.h"

namespace rinkaku::mesh {
namespace {

namespace fs = std::filesystem;

/// What finished readers have cost this process so far; unlike the clock it does not mind a busy machine.
double readers_cpu_s() {
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(children.ru_utime) + seconds(children.ru_stime);
}

Imported load(const std::string& file) { return import(test::data("meshes/" + file)); }

void expect_whole(const Mesh& mesh) {
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(mesh.welded.size(), mesh.positions.size());
  for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-4);
  std::uint32_t next = 0;
  for (const Part& part : mesh.parts) {
    EXPECT_EQ(part.first_triangle, next);
    next += part.triangle_count;
    EXPECT_LT(part.material, mesh.materials.size());
  }
  EXPECT_EQ(next, mesh.triangles.size());
}

TEST(Import, EveryRealMeshLoadsWhole) {
  RINKAKU_NEEDS_DATA();
  int files = 0;
  for (const char* folder : {"closed", "open", "dirty", "analytic", "animated", "vrm"}) {
    for (const auto& entry : fs::recursive_directory_iterator(test::data(std::string("meshes/") + folder))) {
      const std::string ending = entry.path().extension();
      if (ending == ".bin" || ending == ".png" || ending == ".jpg" || ending == ".mtl" || ending == ".md") continue;
      if (!entry.is_regular_file()) continue;
      const std::string name = entry.path().filename();
      SCOPED_TRACE(name);
      if (name == "vrmaddon_basic_armature.vrm" || name == "vrmaddon_minimal.vrm") {
        EXPECT_THROW(import(entry.path()), Error) << "a skeleton without a mesh";
      } else {
        expect_whole(import(entry.path()).mesh);
      }
      ++files;
    }
  }
  EXPECT_GE(files, 50);
}

TEST(Import, SpotWithNormalsPerFaceIsWelded) {
  RINKAKU_NEEDS_DATA();
  const Mesh mesh = load("closed/oded_spot_23k.obj").mesh;
  EXPECT_EQ(mesh.point_count, 11533u);
  EXPECT_LT(mesh.positions.size(), 11600u) << "a few creases round the eyes and horns, no more";
  ImportOptions as_in_file;
  as_in_file.normals = ImportOptions::Normals::File;
  const Mesh faceted = import(test::data("meshes/closed/oded_spot_23k.obj"), as_in_file).mesh;
  EXPECT_EQ(faceted.point_count, 11533u);
  EXPECT_GT(faceted.positions.size(), 60000u) << "the file's normals are per face";
}

TEST(Import, CreaseAngleDecidesWhatIsHard) {
  RINKAKU_NEEDS_DATA();
  const auto vertices = [](double crease_deg) {
    ImportOptions options;
    options.crease_deg = crease_deg;
    return import(test::data("meshes/closed/pmp_fandisk_13k.off"), options).mesh.positions.size();
  };
  EXPECT_EQ(vertices(180), 6475u);
  EXPECT_GT(vertices(60), 6475u);
  EXPECT_GT(vertices(20), vertices(60));
}

TEST(Import, AnimatedFoxIsSummedUp) {
  RINKAKU_NEEDS_DATA();
  const Imported fox = load("animated/Fox.glb");
  EXPECT_EQ(fox.summary.format, "glTF");
  EXPECT_EQ(fox.summary.up, 'y');
  EXPECT_EQ(fox.summary.skins, 1u);
  EXPECT_EQ(fox.summary.bones, 24u);
  ASSERT_EQ(fox.summary.clips.size(), 3u);
  EXPECT_EQ(fox.summary.clips[0].name, "Survey");
  EXPECT_EQ(fox.summary.clips[1].name, "Walk");
  EXPECT_EQ(fox.summary.clips[2].name, "Run");
  // The accessors' own maxima in the file.
  EXPECT_NEAR(fox.summary.clips[0].duration_s, 3.4167, 1e-3);
  EXPECT_NEAR(fox.summary.clips[1].duration_s, 0.7083, 1e-3);
  EXPECT_NEAR(fox.summary.clips[2].duration_s, 1.1583, 1e-3);
  EXPECT_EQ(fox.mesh.triangles.size(), 576u);
  ASSERT_EQ(fox.mesh.textures.size(), 1u);
  EXPECT_EQ(fox.mesh.materials.size(), 1u) << "only those in use";
}

TEST(Import, SkinnedFigureStandsUpright) {
  RINKAKU_NEEDS_DATA();
  const Imported man = load("animated/CesiumMan/CesiumMan.gltf");
  const glm::dvec3 size = bounding_box(man.mesh.positions).size();
  EXPECT_NEAR(size.y, 1.507, 0.02) << "the figure's known height, y up";
  EXPECT_GT(size.y, size.x);
  EXPECT_TRUE(inspect(man).closed);
  ASSERT_EQ(man.mesh.textures.size(), 1u);
  EXPECT_EQ(man.mesh.textures[0].width_px, 1024);
}

TEST(Import, MorphTargetsAreCounted) {
  RINKAKU_NEEDS_DATA();
  EXPECT_EQ(load("animated/MorphStressTest.gltf").summary.morph_targets, 16u);
}

TEST(Import, VrmIsReadByItsContent) {
  RINKAKU_NEEDS_DATA();
  const Imported vrm = load("vrm/univrm_EmissionMigration_v0.107.0.vrm");
  EXPECT_EQ(vrm.summary.format, "VRM");
  EXPECT_EQ(vrm.mesh.triangles.size(), 4608u);
  EXPECT_EQ(load("vrm/vrmspec_mtoon_UV_Animation_Test.vrm").mesh.textures.size(), 3u);
  EXPECT_EQ(load("vrm/vrmaddon_sphere.vrm").mesh.triangles.size(), 960u);
}

TEST(Import, MissingTextureIsAWarning) {
  RINKAKU_NEEDS_DATA();
  const Imported knot = load("closed/mlab_texturedknot.obj");
  EXPECT_TRUE(knot.mesh.textures.empty());
  ASSERT_EQ(knot.summary.warnings.size(), 1u);
  EXPECT_NE(knot.summary.warnings[0].find("TextureDouble_A.png"), std::string::npos);
}

TEST(Import, SpotsTextureLiesTheRightWayUp) {
  RINKAKU_NEEDS_DATA();
  const test::TemporaryFolder folder;
  fs::copy_file(test::data("meshes/closed/spot_texture.png"), folder / "spot_texture.png");
  std::ofstream(folder / "spot.mtl") << "newmtl hide\nKd 1 1 1\nmap_Kd spot_texture.png\n";
  std::ofstream(folder / "spot.obj") << "mtllib spot.mtl\nusemtl hide\n"
                                     << std::ifstream(test::data("meshes/closed/spot_textured_5k9.obj")).rdbuf();
  const Mesh mesh = import(folder / "spot.obj").mesh;
  ASSERT_EQ(mesh.textures.size(), 1u);
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  // Spot's texture holds, besides the hide, its face: pink nostrils at its front end (smallest z), dark hooves at its
  // feet (smallest y). Upside down these lookups land elsewhere on the hide.
  const Texture& texture = mesh.textures[0];
  const auto colour_at = [&](std::size_t v) {
    const int x =
        std::clamp(static_cast<int>(mesh.uvs[v].x * static_cast<float>(texture.width_px)), 0, texture.width_px - 1);
    const int y =
        std::clamp(static_cast<int>(mesh.uvs[v].y * static_cast<float>(texture.height_px)), 0, texture.height_px - 1);
    const std::uint8_t* p = &texture.rgba[(static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width_px) +
                                           static_cast<std::size_t>(x)) *
                                          4];
    return glm::dvec3(p[0], p[1], p[2]);
  };
  const Box box = bounding_box(mesh.positions);
  glm::dvec3 hooves(0);
  int count = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.positions[v].y > box.min.y + 0.03f) continue;
    hooves += colour_at(v);
    ++count;
  }
  ASSERT_GT(count, 10);
  hooves /= count;
  RecordProperty("hooves", std::to_string(hooves.x) + " " + std::to_string(hooves.y) + " " + std::to_string(hooves.z));
  EXPECT_LT(hooves.x, 110) << "hooves are dark";
}

TEST(Import, EveryMalformedFileIsRefusedInOneLineOrLoads) {
  RINKAKU_NEEDS_DATA();
  int refused = 0;
  int loaded = 0;
  for (const auto& entry : fs::recursive_directory_iterator(test::data("malformed"))) {
    if (!entry.is_regular_file()) continue;
    SCOPED_TRACE(entry.path().string());
    const double before_s = readers_cpu_s();
    try {
      expect_whole(import(entry.path()).mesh);
      ++loaded;
    } catch (const Error& error) {
      const std::string line = error.what();
      EXPECT_EQ(error.kind(), Error::Kind::Input);
      EXPECT_EQ(line.find('\n'), std::string::npos);
      EXPECT_EQ(line.find(entry.path().string()), 0u) << line;
      EXPECT_NE(line.find("; "), std::string::npos) << "no remedy: " << line;
      EXPECT_EQ(line.find("crashed"), std::string::npos) << line;
      ++refused;
    }
    EXPECT_LT(readers_cpu_s() - before_s, 5.0);
  }
  EXPECT_GE(refused + loaded, 290);
  EXPECT_GE(refused, 250);
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  EXPECT_LT(children.ru_maxrss, 1024 * 1024) << "KiB; the largest reader so far";
}

TEST(Import, OutOfMemoryFileIsRefusedAtOnce) {
  RINKAKU_NEEDS_DATA();
  const double before_s = readers_cpu_s();
  EXPECT_THROW(import(test::data("malformed/assimp/OutOfMemory.off")), Error);
  EXPECT_LT(readers_cpu_s() - before_s, 1.0) << "it is 309 bytes that promise 353,535,235,358 points";
}

}  // namespace
}  // namespace rinkaku::mesh

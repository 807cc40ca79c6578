// Objects that are drawn by what was baked for the eye's region.
#include "pipeline/regions.h"

#include <cmath>
#include <cstring>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "mesh/import.h"
#include "mesh/topology.h"
#include "silhouette/bake.h"
#include "silhouette/region_file.h"
#include "tests/pipeline/shot_folder.h"
#include "tests/support/environment.h"

namespace rinkaku::pipeline {
namespace {

using test::ShotFolder;

// Rings of points from pole to pole, as an OBJ file.
std::string bumpy_sphere(int rings) {
  std::ostringstream text;
  text.precision(9);
  const int around = 2 * rings;
  const auto point = [&](double up, double turn) {
    const glm::dvec3 p(std::sin(up) * std::cos(turn), std::sin(up) * std::sin(turn), std::cos(up));
    const glm::dvec3 at = p * (0.5 + 0.06 * std::sin(7 * p.x) * std::sin(6 * p.y + 1) * std::sin(8 * p.z));
    text << "v " << at.x << ' ' << at.y << ' ' << at.z << '\n';
  };
  point(0, 0);
  point(M_PI, 0);
  for (int ring = 1; ring < rings; ++ring) {
    for (int i = 0; i < around; ++i) point(M_PI * ring / rings, 2 * M_PI * i / around);
  }
  const auto index = [&](int ring, int i) {
    return ring == 0 ? 1 : ring == rings ? 2 : 3 + (ring - 1) * around + i % around;
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      const int a = index(ring, i), b = index(ring + 1, i), c = index(ring + 1, i + 1), d = index(ring, i + 1);
      if (ring + 1 < rings) text << "f " << a << ' ' << b << ' ' << c << '\n';
      if (ring > 0) text << "f " << a << ' ' << c << ' ' << d << '\n';
    }
  }
  return text.str();
}

// A camera that goes round the origin, `distance_m` away, through many regions.
std::string orbit(int frames, double distance_m) {
  std::ostringstream text;
  text.precision(12);
  text << "frame,tx,ty,tz,qx,qy,qz,qw\n";
  for (int frame = 0; frame < frames; ++frame) {
    const double turn = 6.2 * frame / frames;
    const glm::dvec3 eye = distance_m * glm::dvec3(std::cos(turn) * 0.94, std::sin(turn) * 0.94, 0.34);
    const glm::dvec3 z = -glm::normalize(eye), x = glm::normalize(glm::cross(z, glm::dvec3(0, 0, 1)));
    const glm::dquat q = glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z));
    text << frame << ',' << eye.x << ',' << eye.y << ',' << eye.z << ',' << q.x << ',' << q.y << ',' << q.z << ','
         << q.w << '\n';
  }
  return text.str();
}

class RegionsInScenes : public ::testing::Test {
 protected:
  const test::TemporaryFolder cache_;
  const test::Environment cache_home_{"XDG_CACHE_HOME", cache_.path().string()};
  // Mesa keeps its own things elsewhere.
  const test::Environment shader_cache_{"MESA_SHADER_CACHE_DIR", std::filesystem::temp_directory_path().string()};
  const ShotFolder folder_{160, 120};
  std::vector<std::string> told_;
  static constexpr int frames = 8;
  static constexpr const char* ball = "[[object]]\nmesh = \"ball.obj\"\nscale = 1\nup = \"z\"\n";

  RegionsInScenes() {
    folder_.noise_clip("in.mkv", test::picture("yuv420p", 160, 120, test::bt709_limited), frames);
    folder_.write("ball.obj", bumpy_sphere(20));
    folder_.write("poses.csv", orbit(frames, 1.6));
  }
  std::vector<Frame> render(const std::string& objects, const std::string& to) {
    folder_.render(test::plate + test::poses + objects,
                   {.output = to, .codec = "ffv1", .tell = [this](const std::string& line) { told_.push_back(line); }});
    return folder_.frames(to);
  }
  void bake(const std::string& mesh, const std::string& to) const {
    const mesh::Mesh imported = mesh::import(folder_.file(mesh)).mesh;
    silhouette::BakeOptions options;
    options.space = silhouette::RegionLayout{3, 1, 1.5};
    const auto baked = silhouette::bake(silhouette::make_surface(imported, mesh::topology(imported)), options);
    std::ofstream(folder_.file(to), std::ios::binary)
        .write(reinterpret_cast<const char*>(baked->file.data()), static_cast<std::streamsize>(baked->file.size()));
  }
};

// Where the whole mesh is in doubt, regions only say what is known: the picture is the same to the last bit.
TEST_F(RegionsInScenes, ShadedAndOutlinedObjectsLookTheSame) {
  const std::string looks = "outline = { width_px = 2 }\n";
  const auto whole = render(ball + looks, "whole.mkv");
  const auto by_region = render(ball + looks + "regions = true\n", "regions.mkv");
  ASSERT_EQ(whole.size(), static_cast<std::size_t>(frames));
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(test::samples(by_region[i]), test::samples(whole[i])) << i;
}

TEST_F(RegionsInScenes, AreBakedOnFirstUseWhichIsTold) {
  render(std::string(ball) + "regions = true\n", "first.mkv");
  ASSERT_EQ(told_.size(), 1u);
  EXPECT_EQ(told_[0], "ball.obj: its regions are baked, once, into " + (cache_ / "rinkaku" / "regions").string());
  render(std::string(ball) + "regions = true\n", "second.mkv");
  EXPECT_EQ(told_.size(), 1u) << "the second time they are there";
  render(std::string(ball) + "regions = \"ball.rgn\"\nposition_m = [0, 0, 0.1]\n", "third.mkv");
  EXPECT_EQ(told_.size(), 1u) << "a file that isn't there is looked for in the cache";
}

TEST_F(RegionsInScenes, FileOfAnotherMeshIsRefused) {
  folder_.write("other.obj", bumpy_sphere(10));
  bake("other.obj", "other.rgn");
  try {
    render(std::string(ball) + "regions = \"other.rgn\"\n", "out.mkv");
    FAIL() << "was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_status(), 2);
    EXPECT_NE(std::string(error.what()).find("other.rgn: was baked from another mesh"), std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.file("out.mkv")));
}

// A holdout before a wall. Its matte's triangles cover the same; feathers along the contour, drawn half a pixel to
// either side, may lie a hair differently before others' depth.
TEST_F(RegionsInScenes, HoldoutsHideTheSameByTheirMattes) {
  folder_.write("ball.obj", bumpy_sphere(10));  // so small a mesh has no coarser levels
  const std::string wall =
      "[[object]]\nmesh = \"cube.obj\"\nscale = [0.1, 6, 6]\nup = \"z\"\nposition_m = [-3, -3, -3]\n"
      "toon = false\n";
  const auto whole = render(wall + ball + "holdout = true\n", "whole.mkv");
  const auto by_region = render(wall + ball + "holdout = true\nregions = true\n", "regions.mkv");
  const auto no_holdout = render(wall, "wall.mkv");
  int hidden = 0, different = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const int w = test::sample(whole[i], 0, x, y);
        hidden += w != test::sample(no_holdout[i], 0, x, y) ? 1 : 0;
        different += std::abs(w - test::sample(by_region[i], 0, x, y)) > 2 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(hidden, 8'000) << "the ball hides the wall";
  EXPECT_LE(different, hidden / 2000);
}

TEST_F(RegionsInScenes, WhatTouchesOthersNeedsListsThatKeepItsDepth) {
  bake("ball.obj", "ball.rgn");
  const std::string near_by = "[[object]]\nmesh = \"cube.obj\"\nheight_m = 0.3\nposition_m = [0.4, 0, 0]\n";
  const std::string holdout = std::string(ball) + "holdout = true\nregions = \"ball.rgn\"\n";
  render(near_by + holdout, "touches.mkv");
  ASSERT_EQ(told_.size(), 1u);
  EXPECT_NE(told_[0].find("ball.rgn: has no lists for depth"), std::string::npos) << told_[0];
  const std::string far_off = "[[object]]\nmesh = \"cube.obj\"\nheight_m = 0.3\nposition_m = [-2, 0, 0]\n";
  render(far_off + holdout, "apart.mkv");
  EXPECT_EQ(told_.size(), 1u);
}

TEST(AreApart, BoxesWithAPlaneBetweenThem) {
  const mesh::Box unit{{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}};
  const auto at = [&](const glm::dvec3& place, double turn = 0) {
    return PlacedBox{unit, glm::rotate(glm::translate(glm::dmat4(1), place), turn, glm::dvec3(0, 0, 1))};
  };
  EXPECT_TRUE(are_apart(at({0, 0, 0}), at({1.1, 0, 0})));
  EXPECT_FALSE(are_apart(at({0, 0, 0}), at({0.9, 0, 0})));
  EXPECT_FALSE(are_apart(at({0, 0, 0}), at({1.01, 0, 0}))) << "nearly touching";
  // Turned by 45 degrees, a square reaches 0.707: along a diagonal two of them are apart from 1 on, of which only a
  // plane askew to the world's axes tells.
  const double eighth = std::atan(1.0);
  EXPECT_FALSE(are_apart(at({0, 0, 0}, eighth), at({1.3, 0, 0}, eighth)));
  EXPECT_TRUE(are_apart(at({0, 0, 0}, eighth), at({0.8, 0.8, 0}, eighth)));
  EXPECT_TRUE(are_apart(at({0, 0, 0}, eighth), at({0.8, -0.8, 0}, eighth)));
  EXPECT_FALSE(are_apart(at({0, 0, 0}), at({0, 0, 0})));
}

}  // namespace
}  // namespace rinkaku::pipeline

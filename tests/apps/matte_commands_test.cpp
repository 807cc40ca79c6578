// bake, matte, verify and score, as a user calls them, one on the other's output.
#include "tests/apps/cli_tools.h"

namespace rinkaku {
namespace {

using test::contains;

// A ball of 16 x 12 quads around the origin. `first`: the number of its first point.
std::string ball(double radius = 1, int first = 1) {
  std::string text;
  constexpr int around = 16, rings = 11;
  for (int ring = 1; ring <= rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      const double a = 2 * M_PI * i / around, b = M_PI * ring / (rings + 1);
      text += "v " + std::to_string(radius * std::sin(b) * std::cos(a)) + " " + std::to_string(radius * std::cos(b)) +
              " " + std::to_string(-radius * std::sin(b) * std::sin(a)) + "\n";
    }
  }
  const auto at = [first](int ring, int i) { return std::to_string(first + ring * around + i % around) + " "; };
  const std::string top = at(rings, 0), bottom = at(rings, 1);
  text += "v 0 " + std::to_string(radius) + " 0\nv 0 " + std::to_string(-radius) + " 0\n";
  for (int i = 0; i < around; ++i) {
    text += "f " + top + at(0, i) + at(0, i + 1) + "\nf " + bottom + at(rings - 1, i + 1) + at(rings - 1, i) + "\n";
    for (int ring = 0; ring + 1 < rings; ++ring) {
      text += "f " + at(ring, i) + at(ring + 1, i) + at(ring + 1, i + 1) + at(ring, i + 1) + "\n";
    }
  }
  return text;
}

TEST(MatteCommands, HiddenTrianglesAreDroppedOnlyIfAsked) {
  const test::ShotFolder folder;
  constexpr int points = 16 * 11 + 2;
  folder.write("balls.obj", ball() + ball(1.0 / 3, points + 1));
  const auto kept = test::json_of(test::run_rinkaku(folder, "bake balls.obj -o kept.rgn --cells 4 --json").out);
  const auto dropped =
      test::json_of(test::run_rinkaku(folder, "bake balls.obj -o dropped.rgn --cells 4 --drop-hidden --json").out);
  EXPECT_EQ(kept.at("hidden_gain"), 0);
  EXPECT_GT(dropped.at("hidden_gain"), 0.1);
  EXPECT_LT(dropped.at("triangles_mean_ratio"), kept.at("triangles_mean_ratio"));
  const test::CliResult verify =
      test::run_rinkaku(folder, "verify dropped.rgn --mesh balls.obj --eyes 20 --size 320x240");
  EXPECT_EQ(verify.status, 0) << verify.err;
}

TEST(MatteCommands, RegionMatteEqualsTheWholeMeshs) {
  const test::ShotFolder folder;
  folder.write("ball.obj", ball());
  const test::CliResult bake = test::run_rinkaku(folder, "bake ball.obj -o ball.rgn --cells 2 --json");
  ASSERT_EQ(bake.status, 0) << bake.err;
  const auto baked = test::json_of(bake.out);
  EXPECT_EQ(baked.at("regions"), 24);
  EXPECT_EQ(baked.at("triangles_full"), 16 * 22);
  EXPECT_EQ(baked.at("bytes"), std::filesystem::file_size(folder / "ball.rgn"));
  EXPECT_LT(baked.at("triangles_mean_ratio"), 0.9);
  EXPECT_LE(baked.at("triangles_mean_ratio"), baked.at("triangles_max_ratio"));

  const test::CliResult verify =
      test::run_rinkaku(folder, "verify ball.rgn --mesh ball.obj --eyes 20 --size 320x240 --json");
  EXPECT_EQ(verify.status, 0) << verify.err;
  const auto verified = test::json_of(verify.out);
  EXPECT_EQ(verified.at("eyes"), 20);
  EXPECT_EQ(verified.at("mismatch_px_total"), 0);
  EXPECT_EQ(verified.at("mismatch_px_max"), 0);
  EXPECT_GT(verified.at("draw_ms_full"), 0);
  EXPECT_GT(verified.at("draw_ms_region"), 0);

  const std::string view = "--eye 1,2,3 --target 0,0,0 --size 320x240 --json";
  const auto full = test::json_of(test::run_rinkaku(folder, "matte ball.obj -o full.png " + view).out);
  for (const std::string method : {"region", "cones", "meshopt", "quadric"}) {
    const test::CliResult got = test::run_rinkaku(
        folder, "matte ball.obj --regions ball.rgn --method " + method + " -o " + method + ".png " + view);
    ASSERT_EQ(got.status, 0) << got.err;
    EXPECT_LE(test::json_of(got.out).at("triangles"), full.at("triangles"));
    const auto score = test::json_of(test::run_rinkaku(folder, "score " + method + ".png full.png --json").out);
    if (method == "region" || method == "cones") {
      EXPECT_EQ(score.at("mismatch_px"), 0) << method;
      EXPECT_EQ(score.at("iou"), 1) << method;
    } else {
      EXPECT_GT(score.at("mismatch_px"), 0) << method << " knows nothing of the eye";
      EXPECT_GT(score.at("iou"), 0.8) << method;
    }
  }
  // The ball's circle: seen under asin(1 / distance), with 40 degrees over 240 pixels; less, as it is a polyhedron.
  const double radius_px = 120 / std::tan(M_PI / 9) * std::tan(std::asin(1 / std::sqrt(14.0)));
  EXPECT_NEAR(full.at("covered_px"), M_PI * radius_px * radius_px, 0.06 * M_PI * radius_px * radius_px);
}

TEST(MatteCommands, RegionFileOfAnotherMeshIsRefused) {
  const test::ShotFolder folder;
  folder.write("ball.obj", ball());
  folder.write("cone.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  ASSERT_EQ(test::run_rinkaku(folder, "bake ball.obj -o ball.rgn --cells 1").status, 0);
  const test::CliResult got = test::run_rinkaku(folder, "verify ball.rgn --mesh cone.obj");
  EXPECT_EQ(got.status, 2);
  EXPECT_TRUE(contains(got.err, "ball.rgn")) << got.err;
  EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
}

TEST(MatteCommands, InterruptedBakeLeavesNothing) {
  const test::ShotFolder folder;
  folder.write("ball.obj", ball());
  const auto before = test::contents(folder.path());
  // Until it hears: a shell starts what runs beside it with interrupts ignored, and a busy machine starts late.
  const test::CliResult got = test::run_shell(folder.path(),
                                              "\"$RINKAKU\" bake ball.obj -o ball.rgn --cells 64 --shells 16 & "
                                              "sleep 1; while kill -INT $! 2>/dev/null; do sleep 1; done; wait $!");
  EXPECT_NE(got.status, 0);
  EXPECT_TRUE(got.err.empty() || contains(got.err, "interrupted")) << got.err;
  EXPECT_TRUE(test::contents(folder.path()) == before);
}

TEST(MatteCommands, MattesOfTwoSizesAreNotScored) {
  const test::ShotFolder folder;
  folder.write("ball.obj", ball());
  const std::string view = "--eye 0,0,4 --target 0,0,0 ";
  ASSERT_EQ(test::run_rinkaku(folder, "matte ball.obj -o a.png --size 32x24 " + view).status, 0);
  ASSERT_EQ(test::run_rinkaku(folder, "matte ball.obj -o b.png --size 24x32 " + view).status, 0);
  const test::CliResult got = test::run_rinkaku(folder, "score a.png b.png");
  EXPECT_EQ(got.status, 2);
  EXPECT_TRUE(contains(got.err, "32x24")) << got.err;
}

}  // namespace
}  // namespace rinkaku

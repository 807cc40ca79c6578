#include <cmath>
#include <sstream>

#include "tests/apps/cli_tools.h"

namespace rinkaku {
namespace {

namespace fs = std::filesystem;
using test::contains;

// A ball of radius 2 by rings and columns, its poles at the ends.
std::string ball_obj() {
  constexpr int rings = 24, columns = 48;
  const double pi = std::acos(-1.0);
  std::ostringstream obj;
  obj << "v 0 2 0\nv 0 -2 0\n";
  for (int ring = 1; ring < rings; ++ring) {
    for (int column = 0; column < columns; ++column) {
      const double down = pi * ring / rings, around = 2 * pi * column / columns;
      obj << "v " << 2 * std::sin(down) * std::sin(around) << ' ' << 2 * std::cos(down) << ' '
          << 2 * std::sin(down) * std::cos(around) << '\n';
    }
  }
  const auto at = [](int ring, int column) { return 3 + (ring - 1) * columns + column % columns; };
  for (int column = 0; column < columns; ++column) {
    obj << "f 1 " << at(1, column) << ' ' << at(1, column + 1) << '\n';
    obj << "f 2 " << at(rings - 1, column + 1) << ' ' << at(rings - 1, column) << '\n';
    for (int ring = 1; ring + 1 < rings; ++ring) {
      obj << "f " << at(ring, column) << ' ' << at(ring + 1, column) << ' ' << at(ring + 1, column + 1) << ' '
          << at(ring, column + 1) << '\n';
    }
  }
  return obj.str();
}

struct Row {
  double number, x, y, z, mean, gauss, k1, k2;
};
std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "vertex,x,y,z,mean,gauss,k1,k2");
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    Row r{};
    EXPECT_TRUE(fields >> r.number >> r.x >> r.y >> r.z >> r.mean >> r.gauss >> r.k1 >> r.k2) << line;
    rows.push_back(r);
  }
  return rows;
}

TEST(CurvatureCommand, TableHoldsABallsCurvature) {
  const test::ShotFolder folder;
  folder.write("ball.obj", ball_obj());
  for (const char* method : {"meyer", "icnc", "quadric", "auto"}) {
    const std::string call = std::string("curvature ball.obj --force -o ball.csv --method ") + method;
    const test::CliResult got = test::run_rinkaku(folder, call);
    ASSERT_EQ(got.status, 0) << got.err;
    const std::vector<Row> rows = rows_of(test::text_of(folder / "ball.csv"));
    ASSERT_EQ(rows.size(), 2u + 23 * 48);  // each place once
    for (const Row& r : rows) {
      EXPECT_NEAR(std::hypot(r.x, r.y, r.z), 2, 1e-4);  // the OBJ has six digits
      // Quads 0.13 rad wide, and a fan of 48 slivers at each pole.
      ASSERT_NEAR(r.mean, 0.5, 0.02) << method << " at " << r.y;
      ASSERT_NEAR(r.gauss, 0.25, 0.03) << method << " at " << r.y;
      ASSERT_GE(r.k1, r.k2);
    }
  }
}

TEST(CurvatureCommand, JsonTellsWhatWasMeasured) {
  const test::ShotFolder folder;
  folder.write("ball.obj", ball_obj());
  const test::CliResult got = test::run_rinkaku(folder, "curvature ball.obj -o ball.csv --json");
  ASSERT_EQ(got.status, 0) << got.err;
  const auto found = test::json_of(got.out);
  EXPECT_EQ(found.at("method"), "icnc");
  EXPECT_EQ(found.at("vertices"), 2 + 23 * 48);
  EXPECT_NEAR(found.at("k95").get<double>(), 0.5, 0.001);
  EXPECT_EQ(found.at("output"), "ball.csv");
}

TEST(CurvatureCommand, DrawsAPicture) {
  const test::ShotFolder folder;
  folder.write("ball.obj", ball_obj());
  const test::CliResult got = test::run_rinkaku(folder, "curvature ball.obj --picture ball.png");
  ASSERT_EQ(got.status, 0) << got.err;
  const std::vector<Frame> frames = folder.frames("ball.png");
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].format.width_px, 1024);
  // A ball is as curved everywhere: all red.
  const Plane& plane = frames[0].planes[0];
  const std::uint8_t* middle =
      plane.data + 512 * plane.stride_bytes + 512 * frames[0].format.pixels.component[0].step_bytes;
  EXPECT_GT(middle[0], 100);
  EXPECT_LT(middle[2], 60);
}

TEST(CurvatureCommand, BadCallsSayOneLineAndWriteNothing) {
  const test::ShotFolder folder;
  folder.write("kept.csv", "kept");
  folder.write("kept.png", "kept");
  folder.write("points.obj", "v 0 0 0\nv 1 0 0\n");
  const auto before = test::contents(folder.path());
  const std::pair<const char*, const char*> calls[] = {
      {"curvature cube.obj", "-o FILE.csv"},
      {"curvature cube.obj -o new.csv --method fancy", "fancy"},
      {"curvature cube.obj -o kept.csv", "kept.csv"},
      {"curvature cube.obj -o new.csv --picture kept.png", "kept.png"},
      {"curvature cube.obj -o new.csv --picture new.jpg", "new.jpg"},
      {"curvature cube.obj -o new.csv --picture %d.png", "%d.png"},
      {"curvature cube.obj -o same.png --picture same.png", "same.png"},
      {"curvature cube.obj --force -o ./cube.obj", "cube.obj: is the input itself"},
      {"curvature gone.obj -o new.csv", "gone.obj"},
      {"curvature points.obj -o new.csv --picture new.png", "points.obj"},
      {"curvature cube.obj -o nowhere/new.csv", "nowhere/new.csv"},
  };
  for (const auto& [call, culprit] : calls) {
    const test::CliResult got = test::run_rinkaku(folder, call);
    EXPECT_EQ(got.status, 2) << call;
    EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << call << ": " << got.err;
    EXPECT_TRUE(contains(got.err, culprit)) << call << ": " << got.err;
    EXPECT_EQ(got.out, "") << call;
  }
  EXPECT_EQ(test::contents(folder.path()), before);
}

}  // namespace
}  // namespace rinkaku

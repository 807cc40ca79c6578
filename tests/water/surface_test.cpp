#include "water/surface.h"

#include <limits>

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"
#include "tests/water/waters.h"
#include "water/triangulate.h"

namespace rinkaku::test {
namespace {

using water::Surface;
using water::SurfaceOutline;

TEST(Surface, CoordinatesGoToTheWorldAndBack) {
  const Surface s("test", {{{0, 0, 1}, {4, 0, 3}, {4, 3, 3}, {0, 3, 1}}, {}, {}}, {0, 0, 10});
  for (const glm::dvec3& p : {glm::dvec3(0, 0, 1), glm::dvec3(2, 1, 2), glm::dvec3(4, 3, 3)}) {
    EXPECT_LT(glm::distance(s.to_world(s.from_world(p)), p), 1e-12);
    EXPECT_NEAR(s.height_m(p), 0, 1e-12);
  }
  EXPECT_GT(s.normal().z, 0);
  EXPECT_NEAR(s.height_m(glm::dvec3(2, 1, 2) + s.normal() * 0.7), 0.7, 1e-12);
}

TEST(Surface, AnUprightOneFacesTheEye) {
  const SurfaceOutline fall{{{0, 0, 0}, {2, 0, 0}, {2, 0, 3}, {0, 0, 3}}, {}, {}};
  EXPECT_LT(Surface("test", fall, {1, -5, 1}).normal().y, -0.99);
  EXPECT_GT(Surface("test", fall, {1, 5, 1}).normal().y, 0.99);
}

TEST(Surface, OpenEdgesStayThemselvesWhicheverWayTheCornersRun) {
  const std::vector<glm::dvec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const bool turned : {false, true}) {
    SurfaceOutline o{square, {0}, {}};  // the edge at y = 0
    if (turned) o = {{square[1], square[0], square[3], square[2]}, {0}, {}};
    const Surface s = flat(o);
    for (const water::BorderEdge& e : s.edges()) {
      const bool lower = s.to_world(e.a).y < 0.5 && s.to_world(e.b).y < 0.5;
      EXPECT_EQ(e.open, lower);
    }
  }
}

TEST(Surface, AreaIsTheOutlineLessItsObstacles) {
  SurfaceOutline o = rectangle(4, 3);
  o.obstacles = {{{-1, -1, 0}, {0, -1, 0}, {0, 0, 0}, {-1, 0, 0}}, {{1, 0.5, 0}, {1.5, 0.5, 0}, {1, 1, 0}}};
  const Surface s = flat(o);
  EXPECT_NEAR(s.area_m2(), 12 - 1 - 0.125, 1e-9);  // the triangles fill it without gaps or overlaps
  EXPECT_TRUE(s.contains(s.from_world({1.8, -1.2, 0})));
  EXPECT_FALSE(s.contains(s.from_world({-0.5, -0.5, 0})));
  EXPECT_FALSE(s.contains(s.from_world({2.1, 0, 0})));
}

TEST(Surface, AHollowOutlineIsFilledExactly) {
  const std::vector<glm::dvec3> letter{{0, 0, 0}, {5, 0, 0}, {5, 1, 0}, {1, 1, 0},
                                       {1, 2, 0}, {4, 2, 0}, {4, 3, 0}, {0, 3, 0}};
  EXPECT_NEAR(flat({letter, {}, {}}).area_m2(), 5 + 1 + 4, 1e-9);
}

TEST(Surface, TellsWhatIsWrongWithAnOutline) {
  const auto message = [](const SurfaceOutline& o) -> std::string {
    try {
      flat(o);
    } catch (const Error& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_NE(message({{{0, 0, 0}, {1, 0, 0}}, {}, {}}).find("three corners"), std::string::npos);
  EXPECT_NE(message({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}, {}}).find("on a line"), std::string::npos);
  EXPECT_NE(message({{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}, {}}).find("on a line"), std::string::npos);
  EXPECT_NE(message({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}}, {}, {}}).find("plane"), std::string::npos);
  EXPECT_NE(message({{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1.5, 0}, {3, 1.5, 0}}, {}, {}}).find("crosses itself"),
            std::string::npos);
  EXPECT_NE(message(rectangle(1, 1, {4})).find("no edge 4"), std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message({{{0, 0, 0}, {1, nan, 0}, {1, 1, 0}}, {}, {}}).find("finite"), std::string::npos);
  SurfaceOutline o = rectangle(2, 2);
  o.obstacles = {{{0.5, 0, 0}, {3, 0, 0}, {0.5, 0.5, 0}}};
  EXPECT_NE(message(o).find("obstacle crosses"), std::string::npos);
}

TEST(Surface, ATinyOneIsASurface) { EXPECT_NEAR(flat(rectangle(1e-3, 1e-3)).area_m2(), 1e-6, 1e-12); }

}  // namespace
}  // namespace rinkaku::test

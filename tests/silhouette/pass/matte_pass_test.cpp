#include "silhouette/pass/matte_pass.h"

#include <algorithm>
#include <random>

#include "pipeline/gl/target.h"
#include "silhouette/verify/matte_comparison.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::silhouette {
namespace {

class MattePassTest : public test::GlTest {
 protected:
  // Pixels of 16 x 16 before a camera at the origin, a pixel wide at a distance of 1.
  static std::vector<std::uint8_t> drawn(const std::vector<glm::vec3>& points, const std::vector<std::uint32_t>& list,
                                         const glm::dmat4& camera_from_object = glm::dmat4(1)) {
    CameraModel camera;
    camera.width_px = camera.height_px = 16;
    camera.fx_px = camera.fy_px = 1;
    camera.cx_px = camera.cy_px = 7.5;
    MattePass pass(points);
    pass.set_triangles(list);
    gl::Target target(gl::Target::Kind::Matte);
    target.begin(16, 16);
    pass.draw(passes::clip_from_camera(camera, {0, 0, 16, 16}) * camera_from_object);
    std::vector<std::uint8_t> matte(16 * 16);
    target.read(16, 16, matte.data());
    return matte;
  }
  static auto covered(const std::vector<std::uint8_t>& matte) { return std::count(matte.begin(), matte.end(), 255); }
};

// Faces the camera: anticlockwise for an eye that looks along +z with y down.
const std::vector<glm::vec3> quad{{-2, -1, 1}, {3, -1, 1}, {3, 4, 1}, {-2, 4, 1}};
const std::vector<std::uint32_t> facing{0, 3, 2, 0, 2, 1}, away{0, 1, 2, 0, 2, 3};

glm::dmat4 moved(const glm::dvec3& by) {
  glm::dmat4 m(1);
  m[3] = glm::dvec4(by, 1);
  return m;
}

TEST_F(MattePassTest, CoversThePixelsWhoseCentresLieInside) {
  const auto matte = drawn(quad, facing);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool inside = x >= 6 && x < 11 && y >= 7 && y < 12;  // centres at x - 7.5
      EXPECT_EQ(matte[static_cast<std::size_t>(y * 16 + x)], inside ? 255 : 0) << x << "," << y;
    }
  }
}

TEST_F(MattePassTest, LeavesBackFacesOut) { EXPECT_EQ(covered(drawn(quad, away)), 0); }

TEST_F(MattePassTest, FrontStaysFrontUnderMirroringAndTurning) {
  glm::dmat4 mirrored(1);
  mirrored[0][0] = -1;
  // A mirror turns the quad's back to the eye: in the object's own frame the eye has not moved.
  EXPECT_EQ(covered(drawn(quad, facing, mirrored)), 25);
  EXPECT_EQ(covered(drawn(quad, away, mirrored)), 0);
  // Seen from behind it is the other way round.
  glm::dmat4 turned(1);  // half a turn about y, at a distance of 2
  turned[0][0] = turned[2][2] = -1;
  turned[3][2] = 2;
  EXPECT_EQ(covered(drawn(quad, facing, turned)), 0);
  EXPECT_EQ(covered(drawn(quad, away, turned)), 25);
}

TEST_F(MattePassTest, NearPlaneCutsNothing) {
  // Size and distance shrink alike: nearer than near_m, and straddling it.
  for (const double scale : {passes::near_m * 0.5, passes::near_m * 1e-3}) {
    glm::dmat4 small(scale);
    small[3][3] = 1;
    EXPECT_EQ(covered(drawn(quad, facing, small)), 25) << scale;
  }
  std::vector<glm::vec3> tilted = quad;
  tilted[2].z = tilted[3].z = 0.0005f;
  tilted[2] *= glm::vec3(0.0005f, 0.0005f, 1);
  tilted[3] *= glm::vec3(0.0005f, 0.0005f, 1);
  EXPECT_EQ(covered(drawn(tilted, facing)), 25);
}

TEST_F(MattePassTest, CutsAtTheEyesPlane) {
  // From 1 before the eye to 1 behind it, below it: covers everything under the horizon in its width.
  const std::vector<glm::vec3> floor{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}};
  const auto matte = drawn(floor, {0, 3, 2, 0, 2, 1});
  const auto below = drawn(floor, {0, 1, 2, 0, 2, 3});
  EXPECT_GT(covered(matte) + covered(below), 0);
  for (int x = 0; x < 16; ++x) EXPECT_EQ(matte[static_cast<std::size_t>(8 * 16 + x)], 0) << "nearer than y/z = 1 only";
}

TEST_F(MattePassTest, MeshFarFromItsOwnOriginLosesNothing) {
  // 2^20 + whole numbers are floats; placed back, the picture is the same to the last pixel.
  const glm::dvec3 far(1 << 20, -(1 << 20), 1 << 20);
  std::vector<glm::vec3> points = quad;
  for (glm::vec3& p : points) p += glm::vec3(far);
  EXPECT_EQ(drawn(points, facing, moved(-far)), drawn(quad, facing));
  // And both placed far away with the camera beside them.
  const glm::dmat4 there = moved({1e5, 1e5, 1e5}), back = moved({-1e5, -1e5, -1e5});
  EXPECT_EQ(drawn(quad, facing, back * there), drawn(quad, facing));
}

TEST_F(MattePassTest, NewListReplacesTheOld) {
  MattePass pass(quad);
  gl::Target target(gl::Target::Kind::Matte);
  CameraModel camera = camera_of({32, 32}, 2.6);
  std::vector<std::uint8_t> matte(32 * 32);
  for (const auto& [list, expected] : {std::pair(facing, true), std::pair(away, false), std::pair(facing, true)}) {
    pass.set_triangles(list);
    target.begin(32, 32);
    pass.draw(passes::clip_from_camera(camera, {0, 0, 32, 32}));
    target.read(32, 32, matte.data());
    EXPECT_EQ(covered(matte) > 0, expected);
  }
}

// Slivers so thin that snapping to the pixel grid turns many of them over; a driver that culls them elsewhere when
// something near them in the list is clipped must not draw another picture then.
TEST_F(MattePassTest, CullingDoesNotDependOnWhatElseIsDrawn) {
  constexpr int width = 640, height = 480;
  const CameraModel camera = camera_of({width, height}, 1.0);
  std::mt19937 engine(1);
  const auto unit = [&engine] { return static_cast<double>(engine() >> 8) * 0x1p-24; };
  std::vector<glm::vec3> points;
  std::vector<std::uint32_t> slivers;
  const auto add = [&](double x_px, double y_px) {
    const glm::dvec2 n = to_normalised(camera, {x_px, y_px});
    points.emplace_back(n.x, n.y, 1);
    slivers.push_back(static_cast<std::uint32_t>(points.size() - 1));
  };
  for (int i = 0; i < 4000; ++i) {
    const double x = 10 + 600 * unit(), y = 10 + 200 * unit(), dx = 6 + 8 * unit(), dy = 6 * unit() - 3;
    const double off = 0.006 * unit() - 0.003, along = 0.2 + 0.6 * unit();
    add(x, y);
    add(x + dx, y + dy);
    add(x + along * dx, y + along * dy + off);
  }
  std::vector<std::uint32_t> with_clipped = slivers;
  points.insert(points.end(), {{-0.1f, 0.3f, 1}, {0.1f, 0.3f, 1}, {0, 9, 1}});  // reaches out below
  const auto n = static_cast<std::uint32_t>(points.size());
  for (std::size_t at = 0; at < with_clipped.size(); at += 300) {
    with_clipped.insert(with_clipped.begin() + static_cast<std::ptrdiff_t>(at), {n - 3, n - 2, n - 1});
  }
  MattePass pass(points);
  gl::Target target(gl::Target::Kind::Matte);
  const auto upper_half = [&](const std::vector<std::uint32_t>& list) {
    std::vector<std::uint8_t> matte(width * height);
    pass.set_triangles(list);
    target.begin(width, height);
    pass.draw(passes::clip_from_camera(camera, {0, 0, width, height}));
    target.read(width, height, matte.data());
    matte.resize(width * height / 2);
    return matte;
  };
  const auto alone = upper_half(slivers);
  EXPECT_GT(covered(alone), 5) << "some slivers cover a pixel's centre";
  EXPECT_EQ(alone, upper_half(with_clipped));
}

TEST_F(MattePassTest, PictureLargerThanTheDriverDrawsIsRefused) {
  gl::Target target(gl::Target::Kind::Matte);
  EXPECT_THROW(target.begin(1 << 20, 16), Error);
  target.begin(16, 16);  // and it still works
}

}  // namespace
}  // namespace rinkaku::silhouette

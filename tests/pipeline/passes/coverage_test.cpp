// How exactly the drawn CG covers its pixels: areas, positions and edges against analytic truth.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

class Coverage : public GlTest {};

// 20,480 triangles: their chords lie 1.4e-4 of the radius inside the sphere, 0.03 % of its area.
const mesh::Mesh& fine_sphere() {
  static const mesh::Mesh mesh = sphere(5);
  return mesh;
}

Layer draw_sphere(const View& v, const glm::dvec3& centre, double radius) {
  return drawn(scene_of(toon(fine_sphere(), moved(centre.x, centre.y, centre.z) * scaled(radius))), v);
}

TEST_F(Coverage, SphereHasItsProjectedArea) {
  const View v = view(640, 480, 500);
  double worst = 0;
  for (double radius_m : {0.1, 0.3, 0.6}) {
    for (const glm::dvec3& centre : {glm::dvec3(0, 0, 3), {0.6, -0.4, 3}, {-0.9, 0.5, 2.6}, {0.013, 0.007, 2.1}}) {
      const SeenSphere truth = seen_sphere(v.camera, centre, radius_m);
      const double area = area_px(draw_sphere(v, centre, radius_m));
      worst = std::max(worst, std::abs(area / truth.area_px - 1));
      // Chords: 0.03 %. The edge is at most a fiftieth of a pixel off on average, 0.25 % for the smallest (17 pixels).
      EXPECT_NEAR(area / truth.area_px, 1, 0.004) << radius_m << " m at " << centre.x << ", " << centre.y;
    }
  }
  RecordProperty("worst_area_error_percent", std::to_string(worst * 100));
}

TEST_F(Coverage, SphereLiesAtItsProjectedPlace) {
  const View v = view(641, 479, 500);
  double worst = 0;
  for (const glm::dvec3& centre : {glm::dvec3(0, 0, 3), {0.6, -0.4, 3}, {-0.9, 0.5, 2.6}, {0.017, -0.003, 2.1}}) {
    const glm::dvec2 miss = centroid_px(draw_sphere(v, centre, 0.4)) - seen_sphere(v.camera, centre, 0.4).centre_px;
    worst = std::max(worst, glm::length(miss));
    // The mean of 400 or more edge pixels, each right to some hundredths.
    EXPECT_LT(glm::length(miss), 0.02) << centre.x << ", " << centre.y;
  }
  RecordProperty("worst_centroid_error_px", std::to_string(worst));
}

// The coverage of a pixel by a disc, by 16x16 samples.
double disc_coverage(glm::dvec2 pixel, glm::dvec2 centre, double radius) {
  int inside = 0;
  for (int s = 0; s < 256; ++s) {
    const glm::dvec2 at = pixel + glm::dvec2(s % 16 - 7.5, s / 16 - 7.5) / 16.0;
    if (glm::length(at - centre) < radius) ++inside;
  }
  return inside / 256.0;
}

TEST_F(Coverage, EdgePixelsAreCoveredAsABoxFilterWould) {
  const View v = view(400, 400, 600);
  double worst_mean = 0, worst_single = 0;
  for (double radius_px : {5.0, 20.3, 60.1, 90.7}) {
    const double d = 2, radius_m = d * radius_px / std::hypot(radius_px, v.camera.fx_px);
    for (double shift_px : {0.0, 0.37}) {
      const glm::dvec2 centre(v.camera.cx_px + shift_px, v.camera.cy_px - 0.6 * shift_px);
      const Layer layer =
          draw_sphere(v, {shift_px * d / v.camera.fx_px, -0.6 * shift_px * d / v.camera.fx_px, d}, radius_m);
      double sum = 0, single = 0;
      int edge_pixels = 0;
      for (int y = 0; y < 400; ++y) {
        for (int x = 0; x < 400; ++x) {
          const double wish = disc_coverage({x, y}, centre, radius_px);
          const double error = std::abs(at(layer, x, y)[3] / 255.0 - wish);
          single = std::max(single, error);
          if (wish > 0 && wish < 1) sum += error, ++edge_pixels;
        }
      }
      // The feather is a ramp one pixel wide across the edge. A box filter's ramp is wider where the edge runs
      // diagonally: 0.043 apart at most, 0.015 on average over all directions, which is what small balls show. On large
      // ones the mesh's own contour shows: its vertices lie up to half an edge beside the ball's, 0.03 pixels inside.
      EXPECT_LT(sum / edge_pixels, 0.022) << radius_px;
      EXPECT_LT(single, 0.085) << radius_px;
      worst_mean = std::max(worst_mean, sum / edge_pixels);
      worst_single = std::max(worst_single, single);
    }
  }
  RecordProperty("worst_mean_edge_error", std::to_string(worst_mean));
  RecordProperty("worst_pixel_error", std::to_string(worst_single));
}

TEST_F(Coverage, MovingByTenthsOfAPixelChangesTheAreaSmoothly) {
  const View v = view(200, 160, 400);
  const double d = 2, step_m = 0.1 * d / v.camera.fx_px;
  double last = 0, least = 1e9, most = 0, worst = 0;
  for (int i = 0; i < 40; ++i) {
    const double area = area_px(draw_sphere(v, {i * step_m, i * step_m * 0.3, d}, 0.2));  // a radius of 40.2 pixels
    if (i > 0) worst = std::max(worst, std::abs(area - last));
    last = area;
    least = std::min(least, area);
    most = std::max(most, area);
  }
  // An edge that popped from pixel to pixel would change by up to 25 of its 253 pixels a step. The ramp one pixel wide,
  // applied to the exact circle and summed (the method's own limit, where edges run diagonally), steps by 0.89 at most
  // on this way and stays within 2.2.
  EXPECT_LT(worst, 1.0);
  EXPECT_LT(most - least, 2.5);
  RecordProperty("worst_area_step_px", std::to_string(worst));
}

TEST_F(Coverage, TurningCubeHasTheAreaOfItsProjectedCorners) {
  const View v = view(320, 320, 500);
  const mesh::Mesh mesh = cube();
  double worst = 0, bias = 0;
  for (int i = 0; i < 24; ++i) {
    const glm::dmat4 place = moved(0.05, -0.03, 2.5) * glm::rotate(glm::dmat4(1), 0.15 + i * 0.27, {0.2, 1, 0.1}) *
                             glm::rotate(glm::dmat4(1), i * 0.13, {1, 0, 0}) * scaled(0.3);
    std::vector<glm::dvec2> corners;
    for (const glm::vec3& p : mesh.positions) {
      const glm::dvec3 at = place * glm::dvec4(p, 1);
      corners.push_back(to_pixels(v.camera, {at.x / at.z, at.y / at.z}));
    }
    const double error = area_px(drawn(scene_of(toon(mesh, place)), v)) / hull_area_px(corners) - 1;
    worst = std::max(worst, std::abs(error));
    bias += error / 24;
    // A corner's points move along one normal for three faces, so the edges beside it are up to 0.2 pixels off there:
    // a fortieth of the contour's 500 pixels' area at most, of 15,000.
    EXPECT_LT(std::abs(error), 0.01) << i;
  }
  RecordProperty("worst_cube_area_error_percent", std::to_string(worst * 100));
  RecordProperty("mean_cube_area_error_percent", std::to_string(bias * 100));
}

TEST_F(Coverage, CubesEdgePixelsAreNearlyCoveredAsABoxFilterWould) {
  const View v = view(200, 200, 300);
  const mesh::Mesh mesh = cube();
  double sum = 0, single = 0;
  int edge_pixels = 0;
  for (int i = 0; i < 10; ++i) {
    const glm::dmat4 place =
        moved(0.05, -0.03, 2.5) * glm::rotate(glm::dmat4(1), 0.15 + i * 0.57, {0.2, 1, 0.1}) * scaled(0.3);
    const Layer layer = drawn(scene_of(toon(mesh, place)), v);
    const glm::dmat3 object_from_ray = glm::inverse(glm::dmat3(place));
    const glm::dvec3 eye = glm::dvec3(glm::inverse(place) * glm::dvec4(0, 0, 0, 1));
    // Whether a ray through the picture meets the cube: the slabs' intervals overlap.
    const auto meets = [&](double x, double y) {
      const glm::dvec3 ray = object_from_ray * glm::dvec3(to_normalised(v.camera, {x, y}), 1);
      double from = 0, to = 1e9;
      for (int k = 0; k < 3; ++k) {
        const double a = (-1 - eye[k]) / ray[k], b = (1 - eye[k]) / ray[k];
        from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
      }
      return from < to;
    };
    for (int y = 40; y < 160; ++y) {
      for (int x = 40; x < 170; ++x) {
        int inside = 0;
        for (int s = 0; s < 256; ++s) inside += meets(x + (s % 16 - 7.5) / 16, y + (s / 16 - 7.5) / 16);
        const double error = std::abs(at(layer, x, y)[3] / 255.0 - inside / 256.0);
        single = std::max(single, error);
        if (inside > 0 && inside < 256) sum += error, ++edge_pixels;
      }
    }
  }
  // As for balls, and more: a corner's points move along one normal for all its faces, so beside it a feather starts
  // and ends up to 0.2 pixels off, and a pixel at the very corner gets what its feathers leave. As measured: a mean of
  // 0.064, and 0.244 for the worst pixel.
  EXPECT_LT(sum / edge_pixels, 0.07);
  EXPECT_LT(single, 0.26);
  RecordProperty("mean_cube_edge_error", std::to_string(sum / edge_pixels));
  RecordProperty("worst_cube_pixel_error", std::to_string(single));
}

TEST_F(Coverage, ColoursArePremultiplied) {
  const View v = view(200, 160, 400);
  const Layer layer = drawn(scene_of(toon(sphere(3, {1, 0.5, 0.25, 1}), moved(0.01, 0.02, 2) * scaled(0.2))), v);
  int edge_pixels = 0;
  for (std::size_t i = 0; i < layer.rgba.size(); i += 4) {
    const int a = layer.rgba[i + 3];
    edge_pixels += a > 0 && a < 255;
    // Rounded to 8 bits once in the surface, once in the feather's blend.
    ASSERT_NEAR(layer.rgba[i], a, 1);
    ASSERT_NEAR(layer.rgba[i + 1], a * 0.5, 1.5);
    ASSERT_NEAR(layer.rgba[i + 2], a * 0.25, 1.5);
  }
  EXPECT_GT(edge_pixels, 100);
}

// No dark or light seams between triangles, parts or feathers: inside the contour everything is opaque.
TEST_F(Coverage, InsideIsOpaqueWithoutHoles) {
  const View v = view(400, 400, 600);
  for (int levels : {0, 1, 2, 5}) {
    const Layer layer = drawn(scene_of(toon(sphere(levels), moved(0.003, 0.002, 2) * scaled(0.5))), v);
    // Inside the icosahedron's inscribed sphere (0.795 of the circumscribed one) less two pixels.
    const double inner_px = v.camera.fx_px * 0.5 * 0.79 / 2 - 2;
    for (int y = 0; y < 400; ++y) {
      for (int x = 0; x < 400; ++x) {
        if (std::hypot(x - v.camera.cx_px - 0.9, y - v.camera.cy_px - 0.6) > inner_px) continue;
        ASSERT_EQ(at(layer, x, y)[3], 255) << levels << ": " << x << ", " << y;
      }
    }
  }
}

TEST_F(Coverage, SpikyTetrahedronStaysNearItsOutline) {
  const View v = view(320, 320, 500);
  const mesh::Mesh mesh = tetrahedron();
  for (int i = 0; i < 12; ++i) {
    const glm::dmat4 place = moved(0, 0, 2.5) * glm::rotate(glm::dmat4(1), i * 0.5, {0.3, 1, 0.2}) * scaled(0.5);
    std::vector<glm::dvec2> corners;
    for (const glm::vec3& p : mesh.positions) {
      const glm::dvec3 at = place * glm::dvec4(p, 1);
      corners.push_back(to_pixels(v.camera, {at.x / at.z, at.y / at.z}));
    }
    // A perimeter of some 500 pixels, 12,000 of area; corners are sharper than the cube's.
    EXPECT_NEAR(area_px(drawn(scene_of(toon(mesh, place)), v)) / hull_area_px(corners), 1, 0.015) << i;
  }
}

// Bars thinner than a pixel neither vanish nor grow: their two feathers meet in the middle.
TEST_F(Coverage, ThinBarsKeepTheirWidth) {
  const View v = view(200, 200, 400);
  const double px = 2 / v.camera.fx_px;  // in metres, at the bar's distance
  for (double width_px : {0.2, 0.5, 0.8, 1.0, 1.5, 2.0, 5.0}) {
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
      const glm::dmat4 place = moved(0.1 * i * px, 0, 2) * glm::rotate(glm::dmat4(1), 0.1 + i * 0.2, {0, 0, 1}) *
                               glm::scale(glm::dmat4(1), glm::dvec3(width_px / 2 * px, 60 * px, width_px / 2 * px));
      sum += area_px(drawn(scene_of(toon(cube(), place)), v)) / 8;
    }
    // Its ends are a few tenths of a pixel off, of 120; 0.03 pixels for 8 bits of coverage at a pixel or two across and
    // for what the surface reaches over the feather at hard edges. Under a pixel the feathers of its two sides lie over
    // one another, and it can't be fainter than they are (docs/decisions/0002-feathered-contours.md).
    const double tolerance_px = width_px >= 1 ? 0.03 + 0.012 * width_px : 0.65;
    EXPECT_NEAR(sum / 120, width_px, tolerance_px) << width_px;
  }
}

}  // namespace
}  // namespace rinkaku::test

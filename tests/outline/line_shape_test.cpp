#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "pipeline/passes/composite/lens_map.h"
#include "tests/outline/lined.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

// The line's width and wholeness, measured across contours that are known otherwise: those of convex shapes are the
// convex hulls of their points in the picture.
namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

constexpr int kSide_px = 360;
// The most that is off near corners, where miters of one edge begin on another's strip; half a pixel is allowed.
constexpr double kWidthError_px = 0.4;

class LineShape : public GlTest {};

// Anticlockwise with y up, so clockwise in the picture.
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  std::sort(points.begin(), points.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  std::vector<glm::dvec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const glm::dvec2& p : points) {
      const auto turns_in = [&] {
        const glm::dvec2 a = hull[hull.size() - 2], b = hull.back();
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) <= 0;
      };
      while (hull.size() >= start + 2 && turns_in()) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::vector<glm::dvec2> seen_hull(const View& v, const mesh::Mesh& mesh, const glm::dmat4& place) {
  std::vector<glm::dvec2> points;
  for (const glm::vec3& position : mesh.positions) {
    const glm::dvec3 p(place * glm::dvec4(position, 1));
    points.push_back(to_pixels(v.camera, glm::dvec2(p.x / p.z, p.y / p.z)));
  }
  return convex_hull(std::move(points));
}

// How far alpha reaches beyond a contour point, across the contour.
double reach_px(const Layer& layer, const glm::dvec2& contour, const glm::dvec2& outwards, double width_px) {
  constexpr double inside = 4, step = 0.1;
  double sum = 0;
  for (double r = -inside; r < 3 * width_px + 4; r += step) sum += alpha_at(layer, contour + outwards * r) * step;
  return sum - inside;
}

struct Extremes {
  double least = 1e9, most = -1e9;
  int count = 0;
  void add(double value) { least = std::min(least, value), most = std::max(most, value), ++count; }
};

// Widths along a polygon that runs as convex_hull() gives it, at most one a pixel and not where a corner's own shape
// begins. `seen` takes points of the pinhole picture to the layer's.
template <typename Seen>
Extremes widths(const Layer& layer, const std::vector<glm::dvec2>& hull, double width_px, Seen seen) {
  Extremes found;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const glm::dvec2 a = hull[i], b = hull[(i + 1) % hull.size()];
    const double length = glm::length(b - a);
    if (length < 0.25) continue;
    const glm::dvec2 along = (b - a) / length;
    const int steps = std::max(1, static_cast<int>(length / 4));
    for (int k = 0; k < steps; ++k) {
      const glm::dvec2 p = a + along * (length * (k + 0.5) / steps);
      const glm::dvec2 here = seen(p), way = glm::normalize(seen(p + along * 0.1) - here);
      const double margin_px = width_px + 6;
      if (std::min(here.x, here.y) < margin_px || std::max(here.x, here.y) > kSide_px - margin_px) continue;
      found.add(reach_px(layer, here, {way.y, -way.x}, width_px));
    }
  }
  return found;
}

View view_of(double fov_deg) { return view(360, 360, 180 / std::tan(fov_deg / 2 * std::numbers::pi / 180)); }

// Fills about half the picture, off its middle.
glm::dmat4 tilted(const View& v, int i) {
  const double distance = 2, half_px = 60;
  const double size = half_px / v.camera.fx_px * distance / std::sqrt(3.0);
  const double off = 45 / v.camera.fx_px * distance;
  return moved(off * std::sin(i * 1.7), off * std::cos(i * 1.7), distance) *
         glm::rotate(glm::dmat4(1), 0.05 + i * 0.37, {0.4, 1, 0.2}) * scaled(size);
}

TEST_F(LineShape, WidthIsRightForAnyFieldOfView) {
  Extremes all;
  for (double fov_deg : {10.0, 40.0, 75.0, 110.0}) {
    const View v = view_of(fov_deg);
    for (const mesh::Mesh& mesh : {sphere(4), cube(), cylinder(48), tetrahedron()}) {
      for (int i = 0; i < 4; ++i) {
        for (double width_px : {2.0, 5.0}) {
          const glm::dmat4 place = tilted(v, i);
          const Layer layer = drawn(scene_of(lined(mesh, place, width_px)), v);
          const Extremes found =
              widths(layer, seen_hull(v, mesh, place), width_px, [](const glm::dvec2& p) { return p; });
          EXPECT_GT(found.count, 20);
          all.add(found.least - width_px), all.add(found.most - width_px);
          EXPECT_NEAR(found.least, width_px, kWidthError_px)
              << fov_deg << " deg, " << mesh.triangles.size() << " triangles, turn " << i;
          EXPECT_NEAR(found.most, width_px, kWidthError_px)
              << fov_deg << " deg, " << mesh.triangles.size() << " triangles, turn " << i;
        }
      }
    }
  }
  RecordProperty("least_error_px", std::to_string(all.least));
  RecordProperty("most_error_px", std::to_string(all.most));
}

TEST_F(LineShape, WidthIsRightThroughALens) {
  Extremes all;
  for (double k1 : {-0.25, 0.2}) {
    View v = view_of(75);
    v.camera.distortion[0] = k1;
    v.camera.distortion[4] = k1 < 0 ? 0.03 : 0;
    const passes::LensMap lens(v.camera);
    for (const mesh::Mesh& mesh : {sphere(4), cube()}) {
      for (int i = 0; i < 4; ++i) {
        constexpr double width_px = 5;
        const glm::dmat4 place = moved(0.4 * std::sin(i * 1.7), 0.4 * std::cos(i * 1.7), 0) * tilted(v, i);
        passes::LayerRenderer renderer(scene_of(lined(mesh, place, width_px)), lens.pinhole_rect());
        Layer pinhole, plate;
        renderer.draw(v, pinhole);
        lens.distort(pinhole, plate);
        const Extremes found = widths(plate, seen_hull(v, mesh, place), width_px, [&](const glm::dvec2& p) {
          return to_pixels(v.camera, distort(v.camera, to_normalised(v.camera, p)));
        });
        EXPECT_GT(found.count, 20);
        all.add(found.least - width_px), all.add(found.most - width_px);
        EXPECT_NEAR(found.least, width_px, kWidthError_px)
            << k1 << ", " << mesh.triangles.size() << " triangles, turn " << i;
        EXPECT_NEAR(found.most, width_px, kWidthError_px)
            << k1 << ", " << mesh.triangles.size() << " triangles, turn " << i;
      }
    }
  }
  RecordProperty("least_error_px", std::to_string(all.least));
  RecordProperty("most_error_px", std::to_string(all.most));
}

}  // namespace
}  // namespace rinkaku::test

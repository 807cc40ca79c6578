#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "outline/curvature.h"
#include "outline/line_width.h"
#include "pipeline/passes/composite/lens_map.h"
#include "tests/outline/lined.h"
#include "tests/outline/surfaces.h"
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
constexpr double kWidthError_px = 0.3;

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

// A cylinder whose line is `factor` times as thick at its upper rim as at its lower one.
TEST_F(LineShape, FactorsSetTheWidthAtEachPoint) {
  const View v = view(240, 240, 400);
  const mesh::Mesh mesh = cylinder(48);
  std::vector<float> factors(mesh.point_count, 1.0f);
  std::fill(factors.begin(), factors.begin() + 48, 3.0f);
  outline::HullOptions options;
  options.look.width_px = 2;
  options.style.factors = factors;
  // Seen from the side, 80 px from rim to rim.
  const Layer layer = drawn(scene_of(lined(mesh, moved(0.003, 0.002, 10), options)), v);
  const double axis = v.camera.cx_px + 0.003 * 40, left = 400 / std::sqrt(100.0 - 1);
  for (double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const glm::dvec2 contour(axis - left, v.camera.cy_px + 0.002 * 40 - 40 + 80 * t);
    // y runs downwards and the points of the first rim have y = 1.
    EXPECT_NEAR(reach_px(layer, contour, {-1, 0}, 6), 2 + 4 * t, 0.15) << t;
  }
}

// Red along a row from inside the square (white) to the wall (blue), or to nothing: what is neither.
double ink_beside_px(const Layer& layer, int row) {
  double ink_px = 0;
  for (int x = 120; x < 240; ++x) {
    const auto c = at(layer, x, row);
    ink_px += (255.0 - c[2]) / 255.0;
  }
  return ink_px;
}

// A square before a wall: its line has all of its width where the wall is far behind; close before the wall, it is as
// wide as a pixel and a half and, by `lean` = 3, a third of the step; with no lean it is never thinner.
TEST_F(LineShape, LeansBackOverWhatLiesCloseBehind) {
  const View v = view(240, 240, 400);
  const mesh::Mesh leaf = square(), wall = square({0, 0, 1, 1});
  constexpr double distance = 10, pixel_m = distance / 400;
  struct At {
    double step_px;  // the wall's depth behind the square in the square's pixels
    float factor, lean;
    double width_px;
  };
  for (const At& now : {At{400, 5, 3, 10}, At{12, 5, 3, 5.5}, At{6, 5, 3, 3.5}, At{0.6, 5, 3, 1.7}, At{400, 1, 3, 2},
                        At{0.9, 1, 3, 1.8}, At{0.6, 1, 3, 1.7}, At{0.3, 1, 1, 1.8}, At{0.3, 1, 0, 2}, At{6, 5, 0, 10},
                        At{0.6, 0.25f, 3, 0.5}}) {
    const std::vector<float> factors(leaf.point_count, now.factor);
    outline::HullOptions options;
    options.look.width_px = 2;
    options.look.colour = {1, 0, 0};
    options.style.factors = factors;
    options.lean = now.lean;
    std::vector<passes::StyledObject> objects = scene_of(lined(leaf, moved(0.001, 0.002, distance), options));
    objects.push_back(toon(wall, moved(0, 0, distance + now.step_px * pixel_m) * scaled(30)));
    // Edges within some hundredths of a pixel.
    EXPECT_NEAR(ink_beside_px(drawn(std::move(objects), v), 120), now.width_px, 0.15)
        << "step " << now.step_px << " px, factor " << now.factor << ", lean " << now.lean;
  }
}

// Over a wall that comes nearer to the line's end, the width follows it, and does not tremble with the pose.
TEST_F(LineShape, LeansBackSteadily) {
  const View v = view(240, 240, 400);
  // One long edge: that it is cut into pieces is what the width follows.
  const mesh::Mesh leaf = square();
  const mesh::Mesh wall = square({0, 0, 1, 1});
  outline::HullOptions options;
  options.look.width_px = 6;
  options.look.colour = {1, 0, 0};
  constexpr double distance = 10, pixel_m = distance / 400;
  // The wall leans: from 0 px behind the leaf's one end (row 80) to 24 px behind its other (row 160).
  const glm::dmat4 lean = moved(0, 0, distance + 12 * pixel_m) * glm::rotate(glm::dmat4(1), std::atan(0.3), {1, 0, 0});
  std::vector<passes::StyledObject> objects = scene_of(lined(leaf, moved(0.001, 0.002, distance), options));
  objects.push_back(toon(wall, lean * scaled(30)));
  passes::LayerRenderer renderer(std::move(objects), picture_of(v));
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 1);
  std::vector<double> sums(240), squares(240);
  constexpr int frames = 60;
  for (int frame = 0; frame < frames; ++frame) {
    View from = v;
    from.camera_from_world.translation_m = {0.3 * pixel_m * noise(random), 0.3 * pixel_m * noise(random), 0};
    Layer layer;
    ASSERT_TRUE(renderer.draw(from, layer));
    for (std::size_t row = 90; row < 150; ++row) {
      const double ink_px = ink_beside_px(layer, static_cast<int>(row));
      sums[row] += ink_px / frames, squares[row] += ink_px * ink_px / frames;
    }
  }
  const auto variance = [&](std::size_t row) { return squares[row] - sums[row] * sums[row]; };
  // An upright edge's coverage trembles by itself: as where the line has all of its width.
  const double edge = variance(140);
  for (std::size_t row = 90; row < 150; ++row) {
    const double behind_px = 0.3 * std::abs(static_cast<double>(row) + 0.5 - 80);
    EXPECT_NEAR(sums[row], std::min(1.5 + behind_px / 3, 6.0), 0.3) << row;
    // 0.3 px along the wall are 0.03 px of width; pixels of depth are a tenth of a pixel of width apart.
    EXPECT_LT(std::sqrt(std::max(variance(row) - edge, 0.0)), 0.1) << row;
  }
}

// A slice of depth ends where no wall is: a line that comes close to the cut keeps its width.
TEST_F(LineShape, DoesNotLeanBackFromACut) {
  const View v = view(240, 240, 400);
  constexpr double distance = 10, pixel_m = distance / 400;
  passes::LayerRenderer renderer(scene_of(lined(square(), moved(0.001, 0.002, distance), 6)), picture_of(v));
  const double cuts_m[] = {distance + 0.5 * pixel_m};
  std::array<Layer, 2> layers;
  ASSERT_TRUE(renderer.draw(v, cuts_m, layers));
  Layer whole;
  ASSERT_TRUE(renderer.draw(v, whole));
  EXPECT_EQ(layers[0].rgba, whole.rgba);
}

// More vertices than before, and the same as of a renderer that saw nothing else.
TEST_F(LineShape, LeansBackAsEverAfterComingNearer) {
  const View v = view(240, 240, 400);
  const mesh::Mesh wall = square({0, 0, 1, 1});
  const auto scene = [&] {
    std::vector<passes::StyledObject> objects = scene_of(lined(sphere(4), scaled(0.5), 6));
    objects.push_back(toon(wall, moved(0, 0, 0.2) * scaled(30)));
    return objects;
  };
  const auto from = [&v](double distance) {
    View seen = v;
    seen.camera_from_world.translation_m = {0, 0, distance};
    return seen;
  };
  passes::LayerRenderer moving(scene(), picture_of(v)), fresh(scene(), picture_of(v));
  Layer near, expected;
  ASSERT_TRUE(moving.draw(from(60), near));
  ASSERT_TRUE(moving.draw(from(2), near));
  ASSERT_TRUE(fresh.draw(from(2), expected));
  EXPECT_EQ(near.rgba, expected.rgba);
}

// How wide a line is must not tremble when the pose does: by 0.3 px and what turns the object by as much.
TEST_F(LineShape, WidthIsSteadyUnderAPoseThatTrembles) {
  const View v = view(240, 240, 300);
  const mesh::Mesh mesh = sphere(4);
  const mesh::Topology topology = mesh::topology(mesh);
  outline::HullOptions options;
  options.look.width_px = 3;
  options.look.colour = {1, 0, 0};
  // Half of the ball's line is twice as thick, with a slope between.
  std::vector<float> factors;
  for (const glm::vec3& p : topology.points) factors.push_back(1.5f + 0.5f * p.y);
  options.style.factors = factors;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 1);
  constexpr double distance = 3, radius_px = 80, pixel_m = distance / 300;
  passes::LayerRenderer renderer(scene_of(lined(mesh, scaled(radius_px * pixel_m), options)), picture_of(v));
  std::vector<double> widths_px;
  for (int frame = 0; frame < 60; ++frame) {
    View from = v;
    from.camera_from_world.translation_m = {0.3 * pixel_m * noise(random), 0.3 * pixel_m * noise(random),
                                            distance + 0.3 * pixel_m * noise(random)};
    const double turn = 0.3 / radius_px * noise(random);
    from.camera_from_world.rotation = glm::angleAxis(turn, glm::normalize(glm::dvec3(1, 0.4, 0.7)));
    Layer layer;
    ASSERT_TRUE(renderer.draw(from, layer));
    widths_px.push_back((area_px(layer) - channel_px(layer, 1)) / (2 * std::numbers::pi * radius_px));
  }
  double mean = 0, squares = 0;
  for (double w : widths_px) mean += w / 60;
  for (double w : widths_px) squares += (w - mean) * (w - mean) / 60;
  EXPECT_NEAR(mean, 4.5, 0.5);  // the ring's outer half is longer than its inner one
  EXPECT_LT(std::sqrt(squares), 0.1);
  RecordProperty("width_deviation_px", std::to_string(std::sqrt(squares)));
}

TEST_F(LineShape, WidthInMetresFollowsDepthBetweenItsLimits) {
  const View v = view(240, 240, 400);
  const mesh::Mesh ball = sphere(5);
  outline::HullOptions options;
  options.look.width_m = 0.02f;
  options.look.least_px = 1.5f;
  options.look.most_px = 6;
  options.look.colour = {1, 0, 0};
  struct At {
    double distance_m, width_px;
  };
  // 400 px * 0.02 m / distance, where the contour of a ball 60 px large lies: nearer than its middle by 1 - cos^2.
  for (const At& at : {At{1, 6}, At{2, 4}, At{4, 2}, At{20, 1.5}}) {
    const double radius_px = 60, sine = radius_px / std::hypot(radius_px, 400);
    const glm::dmat4 place = moved(0, 0, at.distance_m) * scaled(at.distance_m * sine);
    const Layer layer = drawn(scene_of(lined(ball, place, options)), v);
    const double ring = area_px(layer) - channel_px(layer, 1), pi = std::numbers::pi;
    const double nearer = at.width_px == 6 || at.width_px == 1.5 ? 1 : 1 / (1 - sine * sine);
    const double width_px = at.width_px * nearer;
    // As for other rings, edges within some hundredths of a pixel.
    EXPECT_NEAR(ring / (pi * (std::pow(radius_px + width_px, 2) - radius_px * radius_px)), 1, 0.03) << at.distance_m;
  }
}

// A cube's far edges have lines under a pixel, its near ones over: each is as faint as it is thin.
TEST_F(LineShape, ThinLinesFadeAtEachPointByItself) {
  const View v = view(240, 240, 300);
  outline::HullOptions options;
  options.look.width_m = 0.01f;
  options.look.colour = {1, 0, 0};
  // A square that leans away: its left side 2 m away, its right side 10 m.
  const glm::dmat4 place = moved(0.5, 0, 6) * glm::rotate(glm::dmat4(1), -std::atan2(4.0, 1.0), {0, 1, 0}) *
                           glm::scale(glm::dmat4(1), {std::hypot(4.0, 1.0), 0.5, 1});
  const mesh::Mesh leaf = square();
  const Layer layer = drawn(scene_of(lined(leaf, place, options)), v);
  for (int side : {-1, 1}) {
    const glm::dvec3 middle(place * glm::dvec4(side, 0, 0, 1));
    const glm::dvec2 seen = to_pixels(v.camera, {middle.x / middle.z, middle.y / middle.z});
    double ink = 0;
    for (int x = static_cast<int>(seen.x) - 6; x <= static_cast<int>(seen.x) + 6; ++x) {
      ink += (at(layer, x, 120)[3] - at(layer, x, 120)[1]) / 255.0;
    }
    // The body's own soft edge covers up to a tenth of a pixel of it.
    EXPECT_NEAR(ink, 300 * 0.01 / middle.z, 0.12) << middle.z;
  }
}

// A torus with bumps: closed, with saddles, contours that end, and parts that hide others.
mesh::Mesh bumpy_torus() {
  return grid_mesh({72, 36, true, true}, [](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
    const double r = 0.3 + 0.06 * std::cos(5 * a) * std::cos(3 * b);
    return glm::dvec3((0.7 + r * std::cos(b)) * std::cos(a), (0.7 + r * std::cos(b)) * std::sin(a), r * std::sin(b));
  });
}

// Walks all body pixels: none may lie beside a pixel that nothing covers, as the line is between them.
int gaps(const Layer& layer) {
  int found = 0;
  for (int y = layer.rect.y_px; y < layer.rect.bottom_px(); ++y) {
    for (int x = layer.rect.x_px; x < layer.rect.right_px(); ++x) {
      if (at(layer, x, y)[1] < 200) continue;
      bool open = false;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) open = open || at(layer, x + dx, y + dy)[3] < 128;
      }
      found += open;
    }
  }
  return found;
}

TEST_F(LineShape, IsClosedAroundClosedMeshes) {
  const View v = view(200, 200, 300);
  for (const mesh::Mesh& mesh : {sphere(2), cube(), tetrahedron(), cylinder(24), bumpy_torus()}) {
    for (double exaggeration : {0.0, 4.0}) {
      const mesh::Topology topology = mesh::topology(mesh);
      const outline::Curvature curvature = outline::curvature(topology);
      outline::WidthOptions width;
      width.exaggeration = static_cast<float>(exaggeration);
      const std::vector<float> factors =
          outline::line_width_factors(topology, curvature, outline::k95(curvature), width);
      for (int i = 0; i < 30; ++i) {
        outline::HullOptions options;
        options.style.factors = factors;
        options.look.colour = {1, 0, 0};
        const glm::dmat4 place = moved(0.01, -0.02, 4) * glm::rotate(glm::dmat4(1), 0.2 + i * 0.53, {0.5, 1, 0.3}) *
                                 glm::rotate(glm::dmat4(1), i * 1.1, {1, 0, 0}) * scaled(0.7);
        EXPECT_EQ(gaps(drawn(scene_of(lined(mesh, place, options)), v)), 0)
            << mesh.triangles.size() << " triangles, exaggeration " << exaggeration << ", view " << i;
      }
    }
  }
}

// From near to far, the line's ink changes by small steps and never by more than the way asks for.
TEST_F(LineShape, InkChangesSmoothlyInADolly) {
  const View v = view(240, 240, 300);
  const mesh::Mesh mesh = bumpy_torus();
  outline::HullOptions options;
  options.look.width_m = 0.03f;
  options.look.colour = {1, 0, 0};
  passes::LayerRenderer renderer(scene_of(lined(mesh, glm::rotate(glm::dmat4(1), 0.7, {1, 0.3, 0}), options)),
                                 picture_of(v));
  constexpr double step = 1.01;
  double before = 0, worst = 0;
  Layer layer;
  for (double distance = 3; distance < 40; distance *= step) {
    View from = v;
    from.camera_from_world.translation_m = {0, 0, distance};
    ASSERT_TRUE(renderer.draw(from, layer));
    const double ink = area_px(layer) - channel_px(layer, 1);
    // Length and width of the line go with 1 / distance: 2 % a step. Contours also appear and vanish as the eye moves.
    if (before > 0) worst = std::max(worst, std::abs(ink / before - 1));
    before = ink;
  }
  EXPECT_LT(worst, 0.05);
  RecordProperty("worst_ink_step_percent", std::to_string(worst * 100));
}

}  // namespace
}  // namespace rinkaku::test

// Lines of every style around a ball, whose picture is known.
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "outline/styles/facing_pass.h"
#include "outline/styles/inverted_hull_pass.h"
#include "outline/styles/picture_lines_pass.h"
#include "outline/styles/stroke_pass.h"
#include "tests/outline/lined.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::outline {
namespace {

using namespace test;
using passes::Layer;
using passes::ObjectPass;
using passes::View;

constexpr double pi = std::numbers::pi;
const glm::vec3 red(1, 0, 0);

class Styles : public GlTest {};

// A ball of a given radius in pixels in the middle of the picture, at a distance, not on the pixel grid's own symmetry.
glm::dmat4 ball_place(const View& v, double radius_px, double distance_m) {
  const double px = distance_m / v.camera.fx_px;
  return moved(0.23 * px, -0.31 * px, distance_m) *
         scaled(distance_m * radius_px / std::hypot(radius_px, v.camera.fx_px));
}

LineLook look(double width_px) {
  LineLook l;
  l.width_px = static_cast<float>(width_px);
  l.colour = red;
  return l;
}

passes::StyledObject hulled(const mesh::Mesh& mesh, const glm::dmat4& place, const LineLook& l) {
  passes::StyledObject styled = toon(mesh, place);
  styled.passes.push_back(std::make_unique<InvertedHullPass>(*styled.object, mesh, l));
  return styled;
}

passes::StyledObject pictured(const mesh::Mesh& mesh, const glm::dmat4& place, const PictureLinesOptions& options) {
  passes::StyledObject styled = toon(mesh, place);
  auto pass = std::make_unique<PictureLinesPass>(*styled.object, *styled.passes[0], options);
  const bool under = options.method == PictureLinesOptions::Method::Silhouette;
  styled.passes.insert(under ? styled.passes.end() : styled.passes.begin(), std::move(pass));
  return styled;
}

passes::StyledObject stroked(const mesh::Mesh& mesh, const glm::dmat4& place, const StrokeOptions& options) {
  passes::StyledObject styled = toon(mesh, place);
  auto pass = std::make_unique<StrokePass>(*styled.object, mesh, mesh::topology(mesh), options);
  styled.passes.insert(options.outside ? styled.passes.end() : styled.passes.begin(), std::move(pass));
  return styled;
}

double red_px(const Layer& layer) { return area_px(layer) - channel_px(layer, 1); }  // green is the body's alone

TEST_F(Styles, InvertedHullHasItsWidth) {
  const View v = view(400, 400, 800);
  const mesh::Mesh ball = sphere(5);
  for (double radius_px : {45.0, 110.0}) {
    for (double width_px : {1.0, 3.0, 8.0}) {
      const Layer layer = drawn(scene_of(hulled(ball, ball_place(v, radius_px, 2), look(width_px))), v);
      const double wish = pi * ((radius_px + width_px) * (radius_px + width_px) - radius_px * radius_px);
      // As HullPass, but for perspective: a ball's hull is a ball, seen from a little nearer.
      EXPECT_NEAR(red_px(layer) / wish, 1, 0.04) << radius_px << " px, line " << width_px;
    }
  }
}

TEST_F(Styles, InvertedHullIsThinAtHardEdgesAndTheStripsAreNot) {
  // A cube seen from the front: its corners' normals point at the eye's side by 55 degrees, so the published hull is
  // thinner than asked for along its edges, by the factor that the normal has across them: 1 / sqrt(3).
  const View v = view(240, 240, 2000);
  const glm::dmat4 place = moved(0.0003, 0.0002, 20) * scaled(0.8);
  const double edges_px = 4 * 2 * 0.8 / (20 - 0.8) * 2000;
  const Layer published = drawn(scene_of(hulled(cube(), place, look(6))), v);
  const Layer strips = drawn(scene_of(lined(cube(), place, 6)), v);
  EXPECT_NEAR(red_px(published) / edges_px, 6 / std::sqrt(3.0), 0.4);
  EXPECT_NEAR(red_px(strips) / edges_px, 6, 0.4);  // corners add (2 * 6)^2 / edges
}

TEST_F(Styles, FacingIsLineWhereTheSurfaceStandsOnEdge) {
  const View v = view(400, 400, 8000);
  const mesh::Mesh ball = sphere(5);
  for (float threshold : {0.2f, 0.5f}) {
    passes::StyledObject styled = toon(ball, ball_place(v, 150, 20));
    styled.passes.push_back(std::make_unique<FacingPass>(*styled.object, FacingOptions{threshold, red}));
    const Layer layer = drawn(scene_of(std::move(styled)), v);
    // On a ball seen from afar N . V is sqrt(1 - (r / R)^2): line is a part of threshold^2 of its picture.
    EXPECT_NEAR(red_px(layer) / (pi * 150 * 150), threshold * threshold, 0.005) << threshold;
  }
}

TEST_F(Styles, DepthAndNormalsGiveALineAcrossTheEdge) {
  const View v = view(400, 400, 800);
  const mesh::Mesh ball = sphere(5);
  for (double width_px : {2.0, 4.0, 7.0}) {
    PictureLinesOptions options;
    options.look = look(width_px);
    options.depth_step_m = 0.05f;
    const Layer layer = drawn(scene_of(pictured(ball, ball_place(v, 110, 2), options)), v);
    const double r = 110, h = width_px / 2;
    const double wish = pi * ((r + h) * (r + h) - (r - h) * (r - h));
    // Edges are known to a quarter pixel and near the limb there are two beside each other: half a pixel of width.
    EXPECT_NEAR(red_px(layer) / wish, 1, 0.5 / width_px) << width_px;
    EXPECT_NEAR(area_px(layer) / (pi * (r + h) * (r + h)), 1, 0.01) << "half of it lies outside";
  }
}

TEST_F(Styles, SilhouetteLiesOutsideAndNowhereElse) {
  const View v = view(400, 400, 800);
  mesh::Mesh two = sphere(5);
  append(two, sphere(5), {0.3f, 0.1f, -1.5f});  // before the first one, from the camera's side
  for (double width_px : {2.0, 5.0}) {
    PictureLinesOptions options;
    options.method = PictureLinesOptions::Method::Silhouette;
    options.look = look(width_px);
    const Layer one = drawn(scene_of(pictured(sphere(5), ball_place(v, 110, 2), options)), v);
    const double wish = pi * ((110 + width_px) * (110 + width_px) - 110.0 * 110.0);
    EXPECT_NEAR(red_px(one) / wish, 1, 0.5 / width_px) << width_px;
    // Within the picture of two balls, of which one hides the other, there is no line.
    const Layer both = drawn(scene_of(pictured(two, ball_place(v, 80, 2), options)), v);
    EXPECT_EQ(at(both, 199 + 25, 199 + 8), (Rgba{255, 255, 255, 255}));
    int inside = 0;
    for (int y = 170; y < 230; ++y) {
      for (int x = 170; x < 250; ++x) inside += at(both, x, y) != Rgba{255, 255, 255, 255} ? 1 : 0;
    }
    EXPECT_EQ(inside, 0);
  }
}

TEST_F(Styles, LaplacianFindsBordersOfColour) {
  // A square of two colours, without a crease or a step in depth.
  mesh::Mesh mesh = square();
  mesh.parts = {mesh.parts[0], mesh.parts[0]};
  mesh.parts[0].triangle_count = mesh.parts[1].triangle_count = mesh.parts[1].first_triangle = 1;
  mesh.parts[1].material = 1;
  mesh.materials.push_back(mesh.materials[0]);
  mesh.materials[1].base_colour = glm::vec4(1, 1, 0, 1);
  const View v = view(200, 200, 300);
  const glm::dmat4 place = moved(0, 0, 3) * scaled(0.5);
  const auto line_in_the_middle = [&](PictureLinesOptions::Method method) {
    PictureLinesOptions options;
    options.method = method;
    options.look = look(4);
    const Layer layer = drawn(scene_of(pictured(mesh, place, options)), v);
    return at(layer, 99, 99)[1] < 80 || at(layer, 100, 99)[1] < 80;  // on the diagonal
  };
  EXPECT_TRUE(line_in_the_middle(PictureLinesOptions::Method::Laplacian));
  EXPECT_FALSE(line_in_the_middle(PictureLinesOptions::Method::DepthNormals));
}

TEST_F(Styles, StrokesHaveTheirWidthAndCloseTheRing) {
  const View v = view(400, 400, 800);
  const mesh::Mesh ball = sphere(5);
  for (const bool outside : {false, true}) {
    for (double width_px : {0.5, 3.0, 8.0}) {
      StrokeOptions options;
      options.look = look(width_px);
      options.outside = outside;
      const double r = 110;
      const Layer layer = drawn(scene_of(stroked(ball, ball_place(v, r, 2), options)), v);
      const double wish = outside ? pi * ((r + width_px) * (r + width_px) - r * r) : 2 * pi * r * width_px;
      // The contour zigzags over the triangles' edges within some tenths of a pixel.
      EXPECT_NEAR(red_px(layer) / wish, 1, std::max(0.04, 0.2 / width_px)) << width_px << (outside ? " outside" : "");
    }
  }
}

TEST_F(Styles, IsophoteIsAsWideAsTheSurfaceTurnsSlowly) {
  const View v = view(500, 500, 4000);
  const mesh::Mesh ball = sphere(5);
  for (double r : {60.0, 180.0}) {
    StrokeOptions options;
    options.look = look(4);
    options.outside = true;
    options.isophote = 0.3f;
    options.most_factor = 5;
    const Layer layer = drawn(scene_of(stroked(ball, ball_place(v, r, 10), options)), v);
    // From the contour, where N . V is 0, to where it is 0.3: R (1 - sqrt(1 - 0.3^2)).
    const double width = r * (1 - std::sqrt(1 - 0.09));
    const double wish = pi * ((r + width) * (r + width) - r * r);
    EXPECT_NEAR(red_px(layer) / wish, 1, 0.06) << r;
  }
}

TEST_F(Styles, OnlyHiddenLinesAreDrawnOverWhatHidesThem) {
  const View v = view(200, 200, 600);
  const glm::dmat4 place = moved(0.01, 0.02, 6) * glm::rotate(glm::dmat4(1), 0.5, {1, 0.8, 0}) * scaled(0.5);
  StrokeOptions options;
  options.look = look(2);
  options.lines = StrokeOptions::Lines::All;
  options.only_hidden = true;
  const Layer hidden = drawn(scene_of(stroked(cube(), place, options)), v);
  options.only_hidden = false;
  const Layer seen = drawn(scene_of(stroked(cube(), place, options)), v);
  const Layer none = drawn(scene_of(toon(cube(), place)), v);
  // Of a cube's twelve edges nine are seen, three of them within its picture, and three hidden.
  const double hidden_px = red_px(hidden) - red_px(none), seen_px = red_px(seen) - red_px(none);
  EXPECT_GT(hidden_px, 50);
  EXPECT_GT(seen_px, 4 * hidden_px);
  EXPECT_NEAR(area_px(hidden), area_px(none), 12) << "what is hidden lies within";
}

TEST_F(Styles, InnerLinesAreHiddenByOtherObjects) {
  const View v = view(200, 200, 600);
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.5, {1, 0.8, 0});
  StrokeOptions options;
  options.look = look(3);
  options.lines = StrokeOptions::Lines::Inner;
  const auto scene = [&](double distance_of_the_screen) {
    return scene_of(stroked(cube(), moved(0, 0, 6) * turn * scaled(0.5), options),
                    toon(square(glm::vec4(0, 0, 1, 1)), moved(0, 0, distance_of_the_screen)));
  };
  const Layer before = drawn(scene(3), v), behind = drawn(scene(9), v);
  EXPECT_EQ(channel_px(before, 0), 0) << "a screen before the cube hides all";
  EXPECT_GT(red_px(behind), 100);
}

TEST_F(Styles, LayerHoldsTheWholeLine) {
  const View v = view(240, 240, 400);
  std::vector<std::function<passes::StyledObject(const mesh::Mesh&, const glm::dmat4&)>> styles;
  styles.push_back([](const mesh::Mesh& m, const glm::dmat4& p) { return hulled(m, p, look(7)); });
  for (const auto method : {PictureLinesOptions::Method::DepthNormals, PictureLinesOptions::Method::Silhouette,
                            PictureLinesOptions::Method::Laplacian}) {
    styles.push_back([method](const mesh::Mesh& m, const glm::dmat4& p) {
      PictureLinesOptions options;
      options.method = method;
      options.look = look(7);
      return pictured(m, p, options);
    });
  }
  for (const bool outside : {false, true}) {
    styles.push_back([outside](const mesh::Mesh& m, const glm::dmat4& p) {
      StrokeOptions options;
      options.outside = outside;
      options.look = look(7);
      options.wobble = 0.8f;
      return stroked(m, p, options);
    });
  }
  for (std::size_t i = 0; i < styles.size(); ++i) {
    for (const mesh::Mesh& mesh : {sphere(3), cube(), tetrahedron()}) {
      const Layer layer = drawn(scene_of(styles[i](mesh, moved(0.01, 0, 2) * scaled(0.2))), v);
      const passes::PixelRect& r = layer.rect;
      int outermost = 0;
      for (int x = r.x_px; x < r.right_px(); ++x) {
        outermost += at(layer, x, r.y_px)[3] + at(layer, x, r.bottom_px() - 1)[3];
      }
      for (int y = r.y_px; y < r.bottom_px(); ++y) {
        outermost += at(layer, r.x_px, y)[3] + at(layer, r.right_px() - 1, y)[3];
      }
      EXPECT_EQ(outermost, 0) << "style " << i << ", " << mesh.triangles.size() << " triangles";
    }
  }
}

TEST_F(Styles, NearPlaneAndEyeInsideAreNoTrouble) {
  const View v = view(64, 48, 50);
  for (const mesh::Mesh& mesh : {sphere(3), cube(), square()}) {
    for (const glm::dmat4& place : {scaled(3), moved(0.1, 0.1, 0.2) * scaled(0.5), moved(0, 0.2, 0) * scaled(40),
                                    moved(0.2, 0, 0.001) * scaled(0.1)}) {
      StrokeOptions strokes;
      strokes.lines = StrokeOptions::Lines::All;
      strokes.isophote = 0.3f;
      std::vector<passes::StyledObject> objects =
          scene_of(hulled(mesh, place, look(3)), pictured(mesh, place, {}), stroked(mesh, place, strokes));
      for (passes::StyledObject& object : objects) {
        const Layer layer = drawn(scene_of(std::move(object)), v);
        EXPECT_EQ(layer.rect, intersection(layer.rect, picture_of(v)));
      }
    }
  }
}

TEST_F(Styles, TargetsAreMadeOnlyForThoseThatNeedThem) {
  const mesh::Mesh mesh = cube();
  const auto targets_of = [](const std::function<passes::StyledObject()>& make) {
    const int before = gl::made().targets;
    const passes::StyledObject made = make();
    return gl::made().targets - before;
  };
  const glm::dmat4 place(1);
  EXPECT_EQ(targets_of([&] { return lined(mesh, place, 3); }), 0);
  EXPECT_EQ(targets_of([&] { return hulled(mesh, place, look(3)); }), 0);
  EXPECT_EQ(targets_of([&] { return pictured(mesh, place, {}); }), 2);  // the surface, its edges
  EXPECT_EQ(targets_of([&] { return stroked(mesh, place, {}); }), 1);   // the surface's depth
}

}  // namespace
}  // namespace rinkaku::outline

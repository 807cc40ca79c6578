// The views in which mattes are compared: without GL.
#include "silhouette/verify/check_views.h"

#include <set>

#include <glm/geometric.hpp>

namespace rinkaku::silhouette {
namespace {

ViewRegion cube() {
  ViewRegion region;
  for (int i = 0; i < 8; ++i) region.hull.emplace_back(i & 1 ? 3 : 2, i & 2 ? 1 : -1, i & 4 ? 1 : -1, 1);
  return region;
}

TEST(HullFaces, OfACube) {
  const HullFaces found = hull_faces(cube());
  ASSERT_EQ(found.faces.size(), 6u);
  for (const auto& face : found.faces) EXPECT_EQ(face.size(), 4u);
  EXPECT_EQ(found.edges.size(), 12u);
}

TEST(HullFaces, OfATetrahedronWithAnInnerVertex) {
  ViewRegion region;
  region.hull = {{2, 0, 0, 1}, {4, 0, 0, 1}, {3, 2, 0, 1}, {3, 1, 2, 1}, {3, 0.6, 0.4, 1}};
  const HullFaces found = hull_faces(region);
  EXPECT_EQ(found.faces.size(), 4u);
  EXPECT_EQ(found.edges.size(), 6u) << "the inner vertex bounds nothing";
}

TEST(HullFaces, ReachToInfinity) {
  ViewRegion region = cube();
  for (glm::dvec4& vertex : region.hull) {
    if (vertex.x == 3) vertex = {glm::dvec3(vertex), 0};
  }
  const HullFaces found = hull_faces(region);
  EXPECT_EQ(found.edges.size(), 12u) << "a cut pyramid, its base in infinity";
}

// The eye in the unit frame, back from what is drawn.
glm::dvec3 eye_of(const CheckView& view, const UnitFrame& frame) {
  const glm::dvec3 in_world = inverse(view.view.camera_from_world).translation_m;
  return frame.to_unit(glm::dvec3(glm::inverse(view.world_from_object) * glm::dvec4(in_world, 1)));
}

// How far the eye lies outside the region's hull at most, as a part of its own distance.
double outside(const glm::dvec3& eye, const ViewRegion& region) {
  glm::dvec4 middle(0);
  for (const glm::dvec4& vertex : region.hull) middle += vertex;
  double most = 0;
  for (const auto& face : hull_faces(region).faces) {
    // The plane's equation from three vertices of the face, as cross products in the three finite coordinates.
    const glm::dvec4 &a = region.hull[face[0]], &b = region.hull[face[1]], &c = region.hull[face[2]];
    const auto way = [](const glm::dvec4& from, const glm::dvec4& to) {
      return glm::normalize(glm::dvec3(to) * (from.w > 0 ? from.w : 1.0) - glm::dvec3(from) * to.w);
    };
    const glm::dvec4& finite = a.w > 0 ? a : b.w > 0 ? b : c;
    if (finite.w == 0) continue;  // the plane in infinity
    const glm::dvec4& p = &finite == &a ? b : a;
    const glm::dvec4& q = &finite == &c ? b : c;
    glm::dvec3 normal = glm::normalize(glm::cross(way(finite, p), way(finite, q)));
    const glm::dvec3 foot = glm::dvec3(finite) / finite.w;
    if (glm::dot(normal, glm::dvec3(middle) - foot * middle.w) > 0) normal = -normal;
    most = std::max(most, glm::dot(normal, eye - foot));
  }
  return most / glm::length(eye);
}

TEST(CheckViews, EyesLieInTheRegionTheyName) {
  const ViewSpace spaces[] = {RegionLayout{}, RegionLayout{4, 3, 1.2}, cube()};
  const UnitFrame frame{{7, -3, 2}, 4};
  for (const ViewSpace& space : spaces) {
    CheckViews views(space, frame);
    for (std::uint64_t n = 0; n < 300; ++n) {
      const CheckView view = views.view(n);
      // Eyes go through the placement and back in double, of objects of 1 m placed 1e5 m away: 1e-11 and some more.
      // Those at borders are in the hull by the finder's word, whose planes are of hulls pushed out by less.
      EXPECT_LT(outside(eye_of(view, frame), view_region(space, view.region)), 1e-8) << view.description;
    }
  }
}

TEST(CheckViews, AreTheSameForOneSeedOnly) {
  CheckViews one(RegionLayout{}, {}), again(RegionLayout{}, {});
  CheckViews other(RegionLayout{}, {}, {.seed = 2, .size_px = {}});
  EXPECT_EQ(one.view(5).description, again.view(5).description);
  one.view(3);
  EXPECT_EQ(one.view(7).description, again.view(7).description) << "whatever was asked for before";
  EXPECT_NE(one.view(5).description, other.view(5).description);
}

TEST(CheckViews, AreOfEveryKind) {
  CheckViews views(RegionLayout{}, {});
  std::string all;
  double narrowest = 180, widest = 0;
  std::set<int> heights;
  for (std::uint64_t n = 0; n < 500; ++n) {
    const CheckView view = views.view(n);
    all += view.description + "\n";
    const CameraModel& camera = view.view.camera;
    const double fov_deg = 2 * std::atan(camera.height_px / 2.0 / camera.fy_px) * 180 / M_PI;
    narrowest = std::min(narrowest, fov_deg);
    widest = std::max(widest, fov_deg);
    heights.insert(camera.height_px);
  }
  for (const char* kind : {"hull vertex", "hull edge", "hull face", "inside", "border", "1e-4 large", "1e4 large",
                           "1e5 away", "uneven", "mirrored", "near plane", "eye's plane"}) {
    EXPECT_NE(all.find(kind), std::string::npos) << kind;
  }
  EXPECT_LT(narrowest, 6);
  EXPECT_GT(widest, 115);
  EXPECT_EQ(heights, (std::set<int>{480, 720, 1080, 1200, 2160}));
}

TEST(CheckViews, LookingAtPutsTheTargetIntoTheMiddleAndUpUp) {
  const RigidTransform camera = looking_at({1, 2, 3}, {-4, 0, 5});
  const glm::dvec3 target = camera * glm::dvec3(-4, 0, 5);
  EXPECT_NEAR(target.x, 0, 1e-12);
  EXPECT_NEAR(target.y, 0, 1e-12);
  EXPECT_GT(target.z, 0);
  EXPECT_LT((camera * glm::dvec3(-4, 1, 5)).y, 0) << "y points down in the camera's frame";
}

}  // namespace
}  // namespace rinkaku::silhouette

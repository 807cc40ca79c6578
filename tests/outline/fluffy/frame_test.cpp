#include "outline/fluffy/frame.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "outline/fluffy/texture_coordinates.h"
#include "pipeline/frame/error.h"
#include "tests/outline/fluffy/frames.h"

namespace rinkaku::test {
namespace {

using fluffy::Frame;
using fluffy::FrameOptions;

mesh::Soup moved(mesh::Soup soup, const glm::vec3& by) {
  for (glm::vec3& p : soup.positions) p += by;
  return soup;
}

std::string error_of(const mesh::Soup& soup, const FrameOptions& options) {
  try {
    frame_of(soup, options);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(FluffyFrame, ScaledFrameIsTheShapeScaledAboutItsOwnCentre) {
  FrameOptions options;
  options.growth = fluffy::Growth::Scaled;
  options.scale = 1.25;
  const glm::vec3 centre(10, -4, 3);
  const Frame frame = frame_of(moved(cube(), centre), options);
  for (std::size_t p = 0; p < frame.points.size(); ++p) {
    const glm::vec3 scaled = centre + 1.25f * (frame.points[p] - centre);
    EXPECT_LT(glm::length(frame.points[p] + frame.growth[p] - scaled), 1e-5f);  // float at 10
  }
  EXPECT_NEAR(frame.longest_m, 0.25 * std::sqrt(3.0), 1e-5);
}

TEST(FluffyFrame, AlongNormalsASphereGrowsToTheSameSizeAsScaled) {
  FrameOptions options;
  options.scale = 1.1;
  const Frame frame = frame_of(sphere(4), options);
  for (std::size_t p = 0; p < frame.points.size(); ++p) {
    // The mean distance of the facets' middles from the centre is 0.2 % below 1 at this subdivision.
    EXPECT_NEAR(glm::length(frame.points[p] + frame.growth[p]), 1.1, 5e-4);
    // An octahedron's subdivision is uneven: its faces' normals average to within a degree.
    EXPECT_LT(glm::length(frame.normals[p] - frame.points[p]), 0.0175f);
  }
}

TEST(FluffyFrame, UnevenAndMirroringScalesKeepNormalsOutwardsAndLengthsInMetres) {
  FrameOptions options;
  options.length_m = 0.05;
  const glm::dmat3 place(-2, 0, 0, 0, 0.5, 0, 0, 0, 1);
  const Frame frame = frame_of(sphere(4), options, place);
  for (std::size_t p = 0; p < frame.points.size(); ++p) {
    // The ellipsoid's normal is the gradient of x^2 / 4 + 4 y^2 + z^2.
    const glm::vec3& x = frame.points[p];
    const glm::vec3 exact = glm::normalize(glm::vec3(x.x / 4, 4 * x.y, x.z));
    EXPECT_GT(glm::dot(frame.normals[p], exact), 0.99f);
    EXPECT_NEAR(glm::length(frame.growth[p]), 0.05, 1e-6);
  }
}

TEST(FluffyFrame, PartsAreChosenByMaterialOrGroupWithWildcards) {
  mesh::Soup soup = sphere(1);  // 32 triangles
  soup.materials = {{}, {}};
  soup.materials[0].name = "skin";
  soup.materials[1].name = "mane";
  soup.parts = {{"head", 0, 20, 0}, {"neck", 20, 12, 1}};
  FrameOptions options;
  options.selection.names = {"ma*"};
  EXPECT_EQ(frame_of(soup, options).triangles.size(), 12u);
  options.selection.names = {"head"};
  EXPECT_EQ(frame_of(soup, options).triangles.size(), 20u);
  options.selection.names = {"skin", "neck"};
  EXPECT_EQ(frame_of(soup, options).triangles.size(), 32u);
  options.selection.names = {"tail"};
  const std::string message = error_of(soup, options);
  EXPECT_NE(message.find("'tail'"), std::string::npos);
  EXPECT_NE(message.find("'mane'"), std::string::npos);
}

TEST(FluffyFrame, VertexPaintSaysHowLongFluffIs) {
  mesh::Soup soup = sphere(2);
  for (const glm::vec3& p : soup.positions) soup.colours.emplace_back(std::max(p.z, 0.0f), 0, 0, 1);
  FrameOptions options;
  options.length_m = 0.1;
  options.selection.painted_channel = 0;
  const Frame frame = frame_of(soup, options);
  for (std::size_t p = 0; p < frame.points.size(); ++p) {
    EXPECT_NEAR(glm::length(frame.growth[p]), 0.1f * std::max(frame.points[p].z, 0.0f), 1e-6);
  }
  EXPECT_LT(frame.triangles.size(), 128u * 5 / 8);  // none where all corners are bare
  options.selection.painted_channel = 1;
  EXPECT_NE(error_of(soup, options).find("vertex paint is 0"), std::string::npos);
  EXPECT_NE(error_of(sphere(1), options).find("no vertex colours"), std::string::npos);
}

TEST(FluffyFrame, CurvedPlacesGrowLongerIfAsked) {
  mesh::Soup soup = sphere(4);
  for (glm::vec3& p : soup.positions) p.z *= 3;  // pointed at the poles
  FrameOptions options;
  options.length_m = 0.1;
  options.exaggeration = 1;
  const Frame frame = frame_of(soup, options);
  float at_pole = 0, at_waist = 1;
  for (std::size_t p = 0; p < frame.points.size(); ++p) {
    const float length = glm::length(frame.growth[p]);
    EXPECT_GE(length, 0.1f - 1e-6f);
    EXPECT_LE(length, 0.2f + 1e-6f);
    if (std::abs(frame.points[p].z) > 2.95f) at_pole = std::max(at_pole, length);
    if (std::abs(frame.points[p].z) < 0.1f) at_waist = std::min(at_waist, length);
  }
  EXPECT_GT(at_pole, 1.2f * at_waist);
}

TEST(FluffyFrame, CoarserFrameStaysNearTheMeshAndClosed) {
  FrameOptions options;
  options.length_m = 0.1;
  options.coarseness = 0.2;
  const Frame frame = frame_of(sphere(5), options);  // 8,192 triangles
  EXPECT_LT(frame.triangles.size(), 1000u);
  double volume = 0;
  for (const glm::uvec3& t : frame.corners) {
    const glm::dvec3 a = frame.points[t.x], b = frame.points[t.y], c = frame.points[t.z];
    const glm::dvec3 middle = (a + b + c) / 3.0;
    // Quadrics count the mean over planes, so allow twice what was asked for.
    EXPECT_GT(glm::length(middle), 1 - 2 * 0.2 * 0.1);
    volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
  // All of the sphere is still there: an inscribed body at most 4 % inside has at least 0.96^3 of its volume.
  EXPECT_GT(volume, 0.88 * 4.18879);
}

TEST(FluffyFrame, GeneratedCoordinatesStretchTheTextureLittle) {
  FrameOptions options;
  options.tile_m = 0.5;
  const Frame frame = frame_of(sphere(4), options);
  double sum = 0, least = 1e9;
  for (std::size_t t = 0; t < frame.triangles.size(); ++t) {
    const auto corner = [&](int k) { return glm::dvec3(frame.points[frame.corners[t][k]]); };
    const auto uv = [&](int k) { return glm::dvec2(frame.vertices[frame.triangles[t][k]].uv) * 0.5; };
    const double area = glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    const glm::dvec2 u = uv(1) - uv(0), v = uv(2) - uv(0);
    const double share = std::abs(u.x * v.y - u.y * v.x) / area;
    sum += share;
    least = std::min(least, share);
    EXPECT_LE(share, 1 + 1e-4);  // laid on, never squeezed
  }
  // Where three axes meet a plane is seen at 1 / sqrt(3); charts whose borders run along triangles miss it a little.
  EXPECT_GT(least, 0.5);
  EXPECT_GT(sum / static_cast<double>(frame.triangles.size()), 0.75);
}

TEST(FluffyFrame, MeshCoordinatesAreTheMeshsOwnOrRefused) {
  mesh::Soup soup = square();
  FrameOptions options;
  options.coordinates = fluffy::Coordinates::Mesh;
  EXPECT_NE(error_of(soup, options).find("no texture coordinates"), std::string::npos);
  for (const glm::vec3& p : soup.positions) soup.uvs.emplace_back(p.x * 0.5f, p.y);
  options.repeat = 3;
  const Frame frame = frame_of(soup, options);
  for (const fluffy::FrameVertex& v : frame.vertices) {
    const glm::vec3& p = frame.points[v.point];
    EXPECT_NEAR(v.uv.x, 1.5f * p.x, 1e-6);
    EXPECT_NEAR(v.uv.y, 3 * p.y, 1e-6);
  }
}

TEST(FluffyFrame, ColoursAreTheBodys) {
  mesh::Soup soup = square();
  soup.materials[0].base_colour = {0.5, 1, 0, 1};
  soup.materials[0].texture = 0;
  soup.textures = {{2, 1, {255, 0, 255, 255, 255, 255, 255, 255}}};  // magenta, white
  soup.uvs = {{0, 0}, {0.49, 0}, {0.49, 1}, {0, 1}};                 // all on the left half
  const Frame frame = frame_of(soup);
  for (const fluffy::FrameVertex& v : frame.vertices) {
    EXPECT_EQ(v.colour[0], 128);
    EXPECT_EQ(v.colour[1], 0);
    EXPECT_EQ(v.colour[2], 0);
  }
}

}  // namespace
}  // namespace rinkaku::test

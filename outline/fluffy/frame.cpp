#include "outline/fluffy/frame.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "outline/curvature.h"
#include "outline/fluffy/body_colours.h"
#include "outline/fluffy/selection.h"
#include "outline/fluffy/texture_coordinates.h"
#include "outline/line_width.h"
#include "pipeline/frame/error.h"

namespace rinkaku::fluffy {
namespace {

// Per point of the whole mesh, in the frame's axes: the mean of its faces' normals weighted by their angle there. All
// faces count, also those that are not chosen, so that normals run on over the border of what is fluffy.
std::vector<glm::dvec3> point_normals(const std::vector<glm::dvec3>& points, const mesh::Topology& topology,
                                      bool mirrored) {
  std::vector<glm::dvec3> sums(points.size(), glm::dvec3(0));
  for (std::size_t f = 0; f < topology.faces.size(); ++f) {
    const glm::uvec3& face = topology.faces[f];
    const glm::dvec3 a = points[face.x], b = points[face.y], c = points[face.z];
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double twice_area = glm::length(cross);
    if (!(twice_area > 0)) continue;
    const bool inwards = mirrored != (topology.turned[f] != 0);
    const glm::dvec3 normal = cross * ((inwards ? -1.0 : 1.0) / twice_area);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 at = points[face[k]];
      const glm::dvec3 one = glm::normalize(points[face[(k + 1) % 3]] - at);
      const glm::dvec3 other = glm::normalize(points[face[(k + 2) % 3]] - at);
      sums[face[k]] += normal * std::acos(std::clamp(glm::dot(one, other), -1.0, 1.0));
    }
  }
  for (glm::dvec3& n : sums) n = glm::length(n) > 0 ? glm::normalize(n) : glm::dvec3(0, 0, 1);
  return sums;
}

struct Centre {
  glm::dvec3 place{0};
  double mean_radius_m = 0;
};

// Of the chosen triangles' area.
Centre centre_of(const std::vector<glm::dvec3>& points, const mesh::Topology& topology,
                 const std::vector<std::uint32_t>& chosen) {
  double area = 0;
  const auto sum_over = [&](auto value) {
    decltype(value(glm::dvec3())) sum(0);
    area = 0;
    for (std::uint32_t f : chosen) {
      const glm::uvec3& face = topology.faces[f];
      const glm::dvec3 a = points[face.x], b = points[face.y], c = points[face.z];
      const double twice_area = glm::length(glm::cross(b - a, c - a));
      sum += value((a + b + c) / 3.0) * twice_area;
      area += twice_area;
    }
    return area > 0 ? sum / area : value(points[topology.faces[chosen.front()].x]);
  };
  Centre centre;
  centre.place = sum_over([](const glm::dvec3& p) { return p; });
  centre.mean_radius_m = sum_over([&](const glm::dvec3& p) { return glm::length(p - centre.place); });
  return centre;
}

std::vector<float> curvature_factors(const mesh::Topology& topology, double exaggeration) {
  if (exaggeration <= 0) return std::vector<float>(topology.points.size(), 1.0f);
  outline::WidthOptions options;
  options.exaggeration = static_cast<float>(exaggeration);
  const outline::Curvature found = outline::curvature(topology);
  return outline::line_width_factors(topology, found, outline::k95(found), options);
}

std::array<std::uint8_t, 4> unorm(const glm::vec4& colour) {
  std::array<std::uint8_t, 4> out{};
  for (int c = 0; c < 4; ++c) {
    out[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(std::clamp(colour[c], 0.0f, 1.0f) * 255));
  }
  return out;
}

// Gives the chosen triangles points and vertices of their own.
class FrameMaker {
 public:
  FrameMaker(const mesh::Mesh& mesh, const FrameOptions& options)
      : mesh_(mesh), options_(options), colours_(body_colours(mesh)), point_of_(mesh.point_count, mesh::kNone) {}

  // Numbers the points; returns which of the mesh's points they are.
  std::vector<std::uint32_t> add_points(const std::vector<std::uint32_t>& chosen) {
    std::vector<std::uint32_t> from;
    for (std::uint32_t f : chosen) {
      glm::uvec3 corners;
      for (int k = 0; k < 3; ++k) {
        std::uint32_t& point = point_of_[mesh_.welded[mesh_.triangles[f][k]]];
        if (point == mesh::kNone) {
          point = static_cast<std::uint32_t>(from.size());
          from.push_back(mesh_.welded[mesh_.triangles[f][k]]);
        }
        corners[k] = point;
      }
      frame.corners.push_back(corners);
      frame.source.push_back(f);
    }
    return from;
  }

  void add_vertices(double tile_m) {
    const bool generated = options_.coordinates == Coordinates::Generated;
    std::vector<std::uint8_t> axes;
    if (generated) axes = chart_axes(frame.points, frame.corners);
    for (std::size_t t = 0; t < frame.corners.size(); ++t) {
      glm::uvec3 triangle;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh_.triangles[frame.source[t]][k];
        const std::uint8_t axis = generated ? axes[t] : 0;
        const auto [at, fresh] = known_.try_emplace({vertex, axis}, frame.vertices.size());
        if (fresh) {
          const std::uint32_t point = frame.corners[t][k];
          const glm::vec2 uv = generated ? chart_uv(frame.points[point], axis, tile_m)
                                         : mesh_.uvs[vertex] * static_cast<float>(options_.repeat);
          frame.vertices.push_back({point, uv, unorm(colours_[vertex])});
        }
        triangle[k] = static_cast<std::uint32_t>(at->second);
      }
      frame.triangles.push_back(triangle);
    }
  }

  Frame frame;

 private:
  const mesh::Mesh& mesh_;
  const FrameOptions& options_;
  std::vector<glm::vec4> colours_;
  std::vector<std::uint32_t> point_of_;
  std::map<std::pair<std::uint32_t, std::uint8_t>, std::size_t> known_;
};

}  // namespace

double base_length_m(const FrameOptions& options, double mean_radius_m) {
  return options.length_m.value_or((options.scale - 1) * mean_radius_m);
}

Frame make_frame(const mesh::Mesh& mesh, const mesh::Topology& topology, const glm::dmat3& world_from_object,
                 const FrameOptions& options, const char* where) {
  if (options.coordinates == Coordinates::Mesh && mesh.uvs.empty()) {
    throw input_error(where, "the mesh has no texture coordinates", "give coordinates = \"generated\"");
  }
  const Chosen chosen = choose(mesh, options.selection, where);
  std::vector<glm::dvec3> points;
  for (const glm::vec3& p : topology.points) points.push_back(world_from_object * glm::dvec3(p));
  const bool mirrored = glm::determinant(world_from_object) < 0;
  const std::vector<glm::dvec3> normals = point_normals(points, topology, mirrored);
  const std::vector<float> factors = curvature_factors(topology, options.exaggeration);
  const Centre centre = centre_of(points, topology, chosen.triangles);
  std::vector<float> weights(topology.points.size(), 0.0f);
  for (std::size_t v = 0; v < mesh.welded.size(); ++v) {
    weights[mesh.welded[v]] = std::max(weights[mesh.welded[v]], chosen.weights[v]);
  }

  FrameMaker maker(mesh, options);
  const double length_m = base_length_m(options, centre.mean_radius_m);
  for (const std::uint32_t p : maker.add_points(chosen.triangles)) {
    const double share = static_cast<double>(weights[p] * factors[p]);
    const glm::dvec3 growth =
        options.growth == Growth::Scaled ? (options.scale - 1) * (points[p] - centre.place) : length_m * normals[p];
    maker.frame.points.emplace_back(points[p]);
    maker.frame.normals.emplace_back(normals[p]);
    maker.frame.growth.emplace_back(growth * share);
    maker.frame.longest_m = std::max(maker.frame.longest_m, static_cast<float>(glm::length(growth) * share));
  }
  maker.add_vertices(options.tile_m.value_or(options.tile_lengths * length_m));
  return std::move(maker.frame);
}

}  // namespace rinkaku::fluffy

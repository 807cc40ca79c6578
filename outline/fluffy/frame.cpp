#include "outline/fluffy/frame.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <meshoptimizer.h>

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

// The triangles that the frame is made of, as the mesh's vertices.
std::vector<glm::uvec3> chosen_triangles(const mesh::Mesh& mesh, const std::vector<std::uint32_t>& chosen,
                                         bool welded) {
  // Where the mesh's texture coordinates aren't needed, one vertex stands for all of its point.
  std::vector<std::uint32_t> stand_in(mesh.point_count, mesh::kNone);
  std::vector<glm::uvec3> triangles;
  for (const std::uint32_t f : chosen) {
    glm::uvec3 triangle = mesh.triangles[f];
    for (int k = 0; welded && k < 3; ++k) {
      std::uint32_t& vertex = stand_in[mesh.welded[triangle[k]]];
      if (vertex == mesh::kNone) vertex = triangle[k];
      triangle[k] = vertex;
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

// Fewer triangles over the same vertices, within `error_m` of where they were (by quadrics).
void make_coarser(std::vector<glm::uvec3>& triangles, const mesh::Mesh& mesh, const std::vector<glm::dvec3>& points,
                  double error_m) {
  std::vector<glm::vec3> places;
  for (const std::uint32_t point : mesh.welded) places.emplace_back(points[point]);
  std::vector<unsigned> indices;
  for (const glm::uvec3& t : triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
  const float extent = meshopt_simplifyScale(&places[0].x, places.size(), sizeof(glm::vec3));
  const auto error = static_cast<float>(error_m) / extent;
  const std::size_t left = meshopt_simplify(indices.data(), indices.data(), indices.size(), &places[0].x, places.size(),
                                            sizeof(glm::vec3), 0, error, 0, nullptr);
  triangles.clear();
  for (std::size_t i = 0; i + 2 < left; i += 3) triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
}

// Numbers the points of the triangles; returns which of the mesh's points they are.
std::vector<std::uint32_t> add_points(Frame& frame, const mesh::Mesh& mesh, const std::vector<glm::uvec3>& triangles) {
  std::vector<std::uint32_t> number_of(mesh.point_count, mesh::kNone), from;
  for (const glm::uvec3& triangle : triangles) {
    glm::uvec3 corners;
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& number = number_of[mesh.welded[triangle[k]]];
      if (number == mesh::kNone) {
        number = static_cast<std::uint32_t>(from.size());
        from.push_back(mesh.welded[triangle[k]]);
      }
      corners[k] = number;
    }
    frame.corners.push_back(corners);
  }
  return from;
}

void add_vertices(Frame& frame, const mesh::Mesh& mesh, const std::vector<glm::uvec3>& triangles,
                  const FrameOptions& options, double tile_m) {
  const std::vector<glm::vec4> colours = body_colours(mesh);
  const bool generated = options.coordinates == Coordinates::Generated;
  std::vector<std::uint8_t> axes;
  if (generated) axes = chart_axes(frame.points, frame.corners);
  std::map<std::pair<std::uint32_t, std::uint8_t>, std::size_t> known;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    glm::uvec3 corners;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = triangles[t][k];
      const std::uint8_t axis = generated ? axes[t] : 0;
      const auto [at, fresh] = known.try_emplace({vertex, axis}, frame.vertices.size());
      if (fresh) {
        const std::uint32_t point = frame.corners[t][k];
        const glm::vec2 uv = generated ? chart_uv(frame.points[point], axis, tile_m)
                                       : mesh.uvs[vertex] * static_cast<float>(options.repeat);
        frame.vertices.push_back({point, uv, unorm(colours[vertex])});
      }
      corners[k] = static_cast<std::uint32_t>(at->second);
    }
    frame.triangles.push_back(corners);
  }
}

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

  const double length_m = base_length_m(options, centre.mean_radius_m);
  std::vector<glm::uvec3> triangles =
      chosen_triangles(mesh, chosen.triangles, options.coordinates == Coordinates::Generated);
  if (options.coarseness > 0) make_coarser(triangles, mesh, points, options.coarseness * length_m);
  Frame frame;
  for (const std::uint32_t p : add_points(frame, mesh, triangles)) {
    const double share = static_cast<double>(weights[p] * factors[p]);
    const glm::dvec3 growth =
        options.growth == Growth::Scaled ? (options.scale - 1) * (points[p] - centre.place) : length_m * normals[p];
    frame.points.emplace_back(points[p]);
    frame.normals.emplace_back(normals[p]);
    frame.growth.emplace_back(growth * share);
    frame.longest_m = std::max(frame.longest_m, static_cast<float>(glm::length(growth) * share));
  }
  add_vertices(frame, mesh, triangles, options, options.tile_m.value_or(options.tile_lengths * length_m));
  return frame;
}

}  // namespace rinkaku::fluffy

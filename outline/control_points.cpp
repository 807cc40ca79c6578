#include "outline/control_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "mesh/bounds.h"

namespace rinkaku::outline {
namespace {

/// A right-angled frame on a face, scaled as the face is; the identity's directions where it has no area.
glm::dmat3 frame_of(const glm::uvec3& face, std::span<const glm::vec3> points) {
  const glm::dvec3 a(points[face.x]), along = glm::dvec3(points[face.y]) - a;
  const glm::dvec3 cross = glm::cross(along, glm::dvec3(points[face.z]) - a);
  const double size = std::sqrt(glm::length(cross));
  if (!(size > 0)) return glm::dmat3(0);
  const glm::dvec3 x = glm::normalize(along), z = glm::normalize(cross);
  return glm::dmat3(x, glm::cross(z, x), z) * size;
}

}  // namespace

std::vector<glm::vec3> control_points_on_sphere(const mesh::Topology& topology, int count, double distance) {
  const mesh::Box box = mesh::bounding_box(topology.points);
  const double radius = glm::length(box.size()) / 2 * (1 + distance);
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<glm::vec3> controls;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count, across = std::sqrt(1 - z * z);
    controls.emplace_back(box.centre() +
                          radius * glm::dvec3(across * std::cos(golden * i), across * std::sin(golden * i), z));
  }
  return controls;
}

std::vector<glm::vec3> control_points_along(const mesh::Topology& topology, int count, double distance) {
  const double above = glm::length(mesh::bounding_box(topology.points).size()) / 2 * distance;
  std::vector<glm::vec3> controls;
  std::vector<float> farness(topology.points.size(), std::numeric_limits<float>::max());
  std::size_t next = 0;
  for (int i = 0; i < count && next < topology.points.size(); ++i) {
    const glm::vec3 chosen = topology.points[next];
    controls.emplace_back(glm::dvec3(chosen) + above * glm::dvec3(topology.outline_normals[next]));
    for (std::size_t p = 0; p < farness.size(); ++p) {
      const glm::vec3 way = topology.points[p] - chosen;
      farness[p] = std::min(farness[p], glm::dot(way, way));
    }
    next = static_cast<std::size_t>(std::max_element(farness.begin(), farness.end()) - farness.begin());
    if (!(farness[next] > 0)) break;
  }
  return controls;
}

ControlWidths::ControlWidths(const mesh::Topology& rest, double k95, std::span<const glm::vec3> controls,
                             const ControlOptions& options)
    : options_(options),
      features_(rest, k95, options.features),
      smoothing_(rest, options.smoothing),
      nearest_(rest.points.size(), 0),
      controls_(controls.begin(), controls.end()),
      factors_(rest.points.size(), 1.0f) {
  if (controls_.empty()) return;
  for (std::size_t p = 0; p < nearest_.size(); ++p) {
    float least = std::numeric_limits<float>::max();
    for (std::uint32_t c = 0; c < controls_.size(); ++c) {
      const glm::vec3 way = controls_[c] - rest.points[p];
      const float squared = glm::dot(way, way);
      if (squared < least) least = squared, nearest_[p] = c;
    }
  }
  attach(rest, controls);
  if (options_.reach > 0) return;
  const std::span<const std::uint32_t> all = smoothing_.everywhere();
  const std::span<const FeaturePoints::Kind> kinds = features_.find(rest.points, all);
  std::vector<double> distances;
  for (const std::uint32_t p : all) {
    if (kinds[p] != FeaturePoints::Kind::None) distances.push_back(distance(rest.points[p], controls_[nearest_[p]]));
  }
  if (distances.empty()) return;
  const auto tenth = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 10);
  std::nth_element(distances.begin(), tenth, distances.end());
  options_.reach = *tenth;
}

void ControlWidths::attach(const mesh::Topology& rest, std::span<const glm::vec3> controls) {
  anchors_.resize(controls.size());
  for (std::size_t c = 0; c < controls.size(); ++c) {
    float least = std::numeric_limits<float>::max();
    for (const glm::uvec3& face : rest.faces) {
      const glm::vec3 way = controls[c] - (rest.points[face.x] + rest.points[face.y] + rest.points[face.z]) / 3.0f;
      const float squared = glm::dot(way, way);
      if (squared >= least || glm::determinant(frame_of(face, rest.points)) == 0) continue;
      least = squared;
      anchors_[c].face = face;
    }
    if (least == std::numeric_limits<float>::max()) continue;  // no face has area: it stays
    const glm::dvec3 from_corner = glm::dvec3(controls[c]) - glm::dvec3(rest.points[anchors_[c].face.x]);
    anchors_[c].place = glm::inverse(frame_of(anchors_[c].face, rest.points)) * from_corner;
  }
}

std::span<const glm::vec3> ControlWidths::controls(std::span<const glm::vec3> points) {
  for (std::size_t c = 0; c < anchors_.size(); ++c) {
    const Anchor& anchor = anchors_[c];
    if (anchor.face == glm::uvec3(0)) continue;
    controls_[c] = glm::vec3(glm::dvec3(points[anchor.face.x]) + frame_of(anchor.face, points) * anchor.place);
  }
  return controls_;
}

double ControlWidths::distance(const glm::vec3& point, const glm::vec3& control) const {
  if (options_.distance == ControlOptions::Distance::Apart)
    return glm::distance(glm::dvec3(point), glm::dvec3(control));
  return std::abs(glm::length(glm::dvec3(point)) - glm::length(glm::dvec3(control)));
}

void ControlWidths::find(std::span<const glm::vec3> points, std::span<const std::uint32_t> needed) {
  controls(points);
  const std::span<const FeaturePoints::Kind> kinds = features_.find(points, needed);
  for (const std::uint32_t p : needed) {
    factors_[p] = 1;
    if (controls_.empty() || kinds[p] == FeaturePoints::Kind::None) continue;
    const double d = distance(points[p], controls_[nearest_[p]]);
    const double part = d > options_.reach ? options_.reach / d : 1.0;
    factors_[p] = static_cast<float>(1 + options_.exaggeration * part * part);
  }
  smoothing_.smooth(factors_);
}

std::span<const float> ControlWidths::at(std::span<const glm::vec3> points) {
  find(points, smoothing_.everywhere());
  return factors_;
}

void ControlWidths::at(std::span<const glm::vec3> points, std::span<const std::uint32_t> wanted,
                       std::span<float> factors) {
  find(points, smoothing_.around(wanted));
  for (const std::uint32_t p : wanted) factors[p] = factors_[p];
}

}  // namespace rinkaku::outline

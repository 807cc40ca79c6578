#include "water/surface.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "pipeline/frame/error.h"
#include "water/triangulate.h"

namespace rinkaku::water {
namespace {

glm::dvec2 nearest_on(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 d = b - a;
  const double length2 = glm::dot(d, d);
  return length2 > 0 ? a + d * std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : a;
}

bool in_ring(std::span<const glm::dvec2> ring, glm::dvec2 p) {
  bool in = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) in = !in;
  }
  return in;
}

}  // namespace

Surface::Surface(std::string_view where, const SurfaceOutline& outline, const glm::dvec3& seen_from) {
  set_plane(where, outline, seen_from);
  add_ring(where, outline.corners, outline.open_edges, false);
  for (const auto& obstacle : outline.obstacles) add_ring(where, obstacle, {}, true);
  triangles_ = triangulate(outline_, holes_);
  for (std::size_t i = 0; i + 2 < triangles_.size(); i += 3) {
    area_m2_ += cross(triangles_[i], triangles_[i + 1], triangles_[i + 2]) / 2;
  }
}

void Surface::set_plane(std::string_view where, const SurfaceOutline& outline, const glm::dvec3& seen_from) {
  const auto& corners = outline.corners;
  if (corners.size() < 3) throw input_error(where, "a water surface needs at least three corners", "add more");
  glm::dvec3 sum(0);
  for (const glm::dvec3& c : corners) {
    if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z)) {
      throw input_error(where, "a corner of the water isn't finite", "give numbers");
    }
    sum += c;
  }
  origin_ = sum / static_cast<double>(corners.size());
  glm::dvec3 area(0);  // Newell's normal
  double reach = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    area += glm::cross(corners[i] - origin_, corners[(i + 1) % corners.size()] - origin_);
    reach = std::max(reach, glm::distance(corners[i], origin_));
  }
  if (!(glm::length(area) > 1e-6 * reach * reach) || reach < 1e-6) {
    throw input_error(where, "the water's corners enclose nothing: they lie on a line or in a point, or cross over",
                      "move them apart, in order around the water");
  }
  normal_ = glm::normalize(area);
  const bool upright = std::abs(normal_.z) < 0.1;
  if (upright ? glm::dot(normal_, seen_from - origin_) < 0 : normal_.z < 0) normal_ = -normal_;
  for (const glm::dvec3& c : corners) {
    if (std::abs(height_m(c)) > 0.01 * reach) {
      throw input_error(where, "the water's corners don't lie in a plane",
                        "move them into one, or make two surfaces of them");
    }
  }
  const glm::dvec3 along = std::abs(normal_.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  axis_x_ = glm::normalize(along - normal_ * glm::dot(along, normal_));
  axis_y_ = glm::cross(normal_, axis_x_);
}

void Surface::add_ring(std::string_view where, std::span<const glm::dvec3> corners, std::span<const int> open,
                       bool hole) {
  const std::size_t n = corners.size();
  if (n < 3) throw input_error(where, "an obstacle needs at least three corners", "add more");
  std::vector<glm::dvec2> ring;
  for (const glm::dvec3& c : corners) ring.push_back(from_world(c));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (segments_cross(ring[i], ring[(i + 1) % n], ring[j], ring[(j + 1) % n])) {
        throw input_error(where, "the water's outline crosses itself", "give its corners in order around it");
      }
    }
    for (const BorderEdge& e : edges_) {
      if (segments_cross(ring[i], ring[(i + 1) % n], e.a, e.b)) {
        throw input_error(where, "an obstacle crosses the outline or another obstacle",
                          "move it inside, or draw the outline around it");
      }
    }
  }
  std::vector<char> is_open(n, 0);
  for (const int edge : open) {
    if (edge < 0 || static_cast<std::size_t>(edge) >= n) {
      throw input_error(where, "there is no edge " + std::to_string(edge) + " to be open",
                        "edges count from 0 to " + std::to_string(n - 1));
    }
    is_open[static_cast<std::size_t>(edge)] = 1;
  }
  if (hole ? signed_area(ring) > 0 : signed_area(ring) < 0) {  // water to the left
    std::reverse(ring.begin(), ring.end());
    std::reverse(is_open.begin(), is_open.end() - 1);
  }
  for (std::size_t i = 0; i < n; ++i) edges_.push_back({ring[i], ring[(i + 1) % n], is_open[i] != 0});
  if (hole) {
    holes_.push_back(std::move(ring));
    return;
  }
  least_ = most_ = ring[0];
  for (const glm::dvec2& p : ring) {
    least_ = {std::min(least_.x, p.x), std::min(least_.y, p.y)};
    most_ = {std::max(most_.x, p.x), std::max(most_.y, p.y)};
  }
  outline_ = std::move(ring);
}

glm::dvec2 Surface::direction_from_world(const glm::dvec3& d) const {
  return {glm::dot(d, axis_x_), glm::dot(d, axis_y_)};
}

glm::dvec2 Surface::from_world(const glm::dvec3& point) const { return direction_from_world(point - origin_); }

double Surface::height_m(const glm::dvec3& point) const { return glm::dot(point - origin_, normal_); }

bool Surface::contains(glm::dvec2 p) const {
  if (p.x < least_.x || p.y < least_.y || p.x > most_.x || p.y > most_.y || !in_ring(outline_, p)) return false;
  return std::none_of(holes_.begin(), holes_.end(), [p](const auto& hole) { return in_ring(hole, p); });
}

Surface::Nearest Surface::nearest_border(glm::dvec2 p, bool shores_only) const {
  Nearest best;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (shores_only && edges_[i].open) continue;
    const glm::dvec2 q = nearest_on(p, edges_[i].a, edges_[i].b);
    const double d = glm::distance(p, q);
    if (!best.found || d < best.distance_m) best = {q, d, i, true};
  }
  return best;
}

Surface::Nearest Surface::crossed_shore(glm::dvec2 a, glm::dvec2 b) const {
  Nearest first;
  double at = 2;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const BorderEdge& e = edges_[i];
    if (e.open) continue;
    const double from = cross(e.a, e.b, a), to = cross(e.a, e.b, b);
    if (from < 0 || to >= 0) continue;  // only out of the water
    const double s = from / (from - to);
    const glm::dvec2 p = a + (b - a) * s;
    const glm::dvec2 d = e.b - e.a;
    const double along = glm::dot(p - e.a, d);
    if (along < 0 || along > glm::dot(d, d) || s >= at) continue;
    at = s;
    first = {p, glm::distance(a, p), i, true};
  }
  return first;
}

}  // namespace rinkaku::water

#include "outline/verify/line_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace rinkaku::outline {
namespace {

constexpr double kNothing = std::numeric_limits<double>::max();
constexpr std::size_t kMostNoted = 16;

struct Seen {
  int green = 0, alpha = 0;  // the body is white, its line red
};

Seen seen_at(const passes::Layer& layer, const glm::ivec2& pixel) {
  const int x = pixel.x - layer.rect.x_px, y = pixel.y - layer.rect.y_px;
  if (x < 0 || y < 0 || x >= layer.rect.width_px || y >= layer.rect.height_px) return {};
  const std::size_t at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(layer.rect.width_px) + static_cast<std::size_t>(x)) * 4;
  return {layer.rgba[at + 1], layer.rgba[at + 3]};
}

bool is_ink(const Seen& seen) { return seen.alpha - seen.green >= 128; }

glm::ivec2 nearest(const glm::dvec2& p) {
  return {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))};
}

void note(WalkedLine& walked, const glm::ivec2& pixel) {
  if (walked.where.size() < kMostNoted) walked.where.push_back(pixel);
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

WalkedLine LineWalker::walk(const passes::View& view, const glm::dmat4& world_from_mesh, const passes::Layer& layer) {
  place_points(view, world_from_mesh);
  fill_depths();
  WalkedLine walked;
  walk_border(layer, walked);
  walk_edges(layer, walked);
  return walked;
}

void LineWalker::place_points(const passes::View& view, const glm::dmat4& world_from_mesh) {
  width_px_ = view.camera.width_px, height_px_ = view.camera.height_px;
  points_.clear();
  pixels_.clear();
  for (const glm::vec3& point : topology_.points) {
    const glm::dvec3 world(world_from_mesh * glm::dvec4(point, 1));
    const glm::dvec3 seen = view.camera_from_world.rotation * world + view.camera_from_world.translation_m;
    points_.push_back(seen);
    pixels_.emplace_back(view.camera.fx_px * seen.x / seen.z + view.camera.cx_px,
                         view.camera.fy_px * seen.y / seen.z + view.camera.cy_px);
  }
  facing_.clear();
  for (const glm::uvec3& face : topology_.faces) {
    const glm::dvec3 &a = points_[face.x], &b = points_[face.y], &c = points_[face.z];
    facing_.push_back(glm::dot(glm::cross(b - a, c - a), a) < 0 ? 1 : 0);
  }
}

void LineWalker::fill_depths() {
  depths_.assign(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_), kNothing);
  for (const glm::uvec3& face : topology_.faces) {
    const glm::dvec2 &a = pixels_[face.x], &b = pixels_[face.y], &c = pixels_[face.z];
    const double area = cross(b - a, c - a);
    if (area == 0) continue;
    const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    const int left = std::max(0, static_cast<int>(std::ceil(low.x)));
    const int right = std::min(width_px_ - 1, static_cast<int>(std::floor(high.x)));
    const int top = std::max(0, static_cast<int>(std::ceil(low.y)));
    const int bottom = std::min(height_px_ - 1, static_cast<int>(std::floor(high.y)));
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const glm::dvec2 p(x, y);
        const double u = cross(c - b, p - b) / area, v = cross(a - c, p - c) / area, w = 1 - u - v;
        if (u < 0 || v < 0 || w < 0) continue;
        const double depth = 1 / (u / points_[face.x].z + v / points_[face.y].z + w / points_[face.z].z);
        double& nearest = depths_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_) + x];
        nearest = std::min(nearest, depth);
      }
    }
  }
}

void LineWalker::walk_border(const passes::Layer& layer, WalkedLine& walked) const {
  for (int y = 1; y + 1 < height_px_; ++y) {
    for (int x = 1; x + 1 < width_px_; ++x) {
      if (depth_at(x, y) == kNothing) continue;
      bool border = false, open = false;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (depth_at(x + dx, y + dy) != kNothing) continue;
          border = true;
          open = open || seen_at(layer, {x + dx, y + dy}).alpha < 128;
        }
      }
      walked.border += border ? 1 : 0;
      if (!open) continue;
      ++walked.border_gaps;
      note(walked, {x, y});
    }
  }
}

void LineWalker::walk_edges(const passes::Layer& layer, WalkedLine& walked) {
  contour_.clear();
  lines_at_.assign(points_.size(), 0);
  pieces_at_.resize(points_.size());
  for (const mesh::Edge& edge : topology_.edges) {
    if (edge.face1 == mesh::kNone || facing_[edge.face0] == facing_[edge.face1]) continue;
    const std::uint32_t front = facing_[edge.face0] != 0 ? edge.face0 : edge.face1;
    // In a hollow, what faces away lies before the contour.
    const glm::uvec3& f = topology_.faces[front];
    const glm::dvec3 normal = glm::cross(points_[f.y] - points_[f.x], points_[f.z] - points_[f.x]);
    const std::uint32_t beyond = mesh::opposite_point(topology_, edge, front == edge.face0 ? edge.face1 : edge.face0);
    if (glm::dot(normal, points_[beyond] - points_[edge.a]) > 0) continue;
    const auto number = static_cast<std::uint32_t>(contour_.size());
    contour_.push_back({&edge, front, outwards_of(edge, front)});
    for (const std::uint32_t p : {edge.a, edge.b}) {
      const std::uint32_t before = lines_at_[p]++;
      if (before < 2) pieces_at_[p][before] = number;
    }
  }
  ends_px_.clear();
  for (std::uint32_t p = 0; p < lines_at_.size(); ++p) {
    if (lines_at_[p] == 1 || (lines_at_[p] == 2 && folds_behind(p))) ends_px_.push_back(pixels_[p]);
  }
  for (const Piece& piece : contour_) walk_edge(piece, layer, walked);
}

bool LineWalker::is_end(const glm::dvec2& pixel) const {
  constexpr double last_px = 2.5;  // 2, and what rounding to pixels takes
  return std::any_of(ends_px_.begin(), ends_px_.end(),
                     [&](const glm::dvec2& end) { return glm::length(end - pixel) < last_px; });
}

// Across the screen, away from the face that is seen; 0 for an edge that is seen end on.
glm::dvec2 LineWalker::outwards_of(const mesh::Edge& edge, std::uint32_t front) const {
  const glm::dvec2 a = pixels_[edge.a], b = pixels_[edge.b];
  const double length_px = glm::length(b - a);
  constexpr double least_px = 1e-6;
  if (length_px < least_px) return glm::dvec2(0);
  const glm::dvec2 outwards = glm::dvec2(b.y - a.y, a.x - b.x) / length_px;
  const std::uint32_t opposite = mesh::opposite_point(topology_, edge, front);
  return glm::dot(pixels_[opposite] - a, outwards) > 0 ? -outwards : outwards;
}

// Whether the contour turns back sharply at a point and one of its two pieces there is hidden: a cusp, as it has where
// it passes from sight behind a smooth surface. At the tip of a spike, both are seen.
bool LineWalker::folds_behind(std::uint32_t point) const {
  const Piece &first = contour_[pieces_at_[point][0]], &second = contour_[pieces_at_[point][1]];
  if (glm::dot(first.outwards, second.outwards) >= 0) return false;
  const auto hidden = [&](const Piece& piece) {
    const std::uint32_t other = piece.edge->a == point ? piece.edge->b : piece.edge->a;
    const double length_px = glm::length(pixels_[other] - pixels_[point]);
    const double t = 0.5 / std::max(std::ceil(length_px), 1.0);  // the first place along it
    const double depth = 1 / ((1 - t) / points_[point].z + t / points_[other].z);
    return !is_open(nearest(glm::mix(pixels_[point], pixels_[other], t) + piece.outwards * across_px_), depth);
  };
  return hidden(first) != hidden(second);
}

void LineWalker::walk_edge(const Piece& piece, const passes::Layer& layer, WalkedLine& walked) const {
  const mesh::Edge& edge = *piece.edge;
  const glm::dvec2 a = pixels_[edge.a], b = pixels_[edge.b], outwards = piece.outwards;
  if (outwards == glm::dvec2(0)) return;
  const double length_px = glm::length(b - a);
  const int steps = static_cast<int>(std::ceil(length_px));
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps;
    const double depth = 1 / ((1 - t) / points_[edge.a].z + t / points_[edge.b].z);
    const glm::dvec2 on = a + (b - a) * t, at = on + outwards * across_px_;
    const glm::ivec2 pixel = nearest(at);
    if (!is_open(pixel, depth)) continue;
    ++walked.places;
    if (is_ink(seen_at(layer, pixel)) || is_end(on)) continue;
    ++walked.place_thin;
    if (is_ink(seen_at(layer, nearest(on + outwards * (across_px_ / 3)))) ||
        is_ink(seen_at(layer, nearest(on + outwards * (across_px_ * 2 / 3))))) {
      continue;
    }
    ++walked.place_gaps;
    note(walked, pixel);
  }
}

// Whether nothing as near as `depth`, or nearly so, lies around a pixel.
bool LineWalker::is_open(const glm::ivec2& pixel, double depth) const {
  constexpr double clear = 1.002;
  if (pixel.x < 1 || pixel.y < 1 || pixel.x + 1 >= width_px_ || pixel.y + 1 >= height_px_) return false;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (depth_at(pixel.x + dx, pixel.y + dy) < depth * clear) return false;
    }
  }
  return true;
}

}  // namespace rinkaku::outline

#include "outline/strokes/drawn_lines.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rinkaku::outline {
namespace {

// Where a line's next place lies so many times farther from the last than a step at right angles to the line of sight
// is long, the line has jumped to another part.
constexpr double kJump = 12;

struct Follower {
  const mesh::Mesh& mesh;
  glm::dvec3 eye;
  std::vector<DrawnLine> parts{};
  DrawnLine open{};
  glm::dvec3 last{0};

  void close() {
    if (open.size() > 1) parts.push_back(std::move(open));
    open.clear();
  }
  // `step` is how far rays are apart at a distance of one.
  void meet(const std::optional<SurfaceHit>& hit, const glm::dvec3& direction, double step) {
    if (!hit) {
      close();
      return;
    }
    const glm::dvec3 here = eye + hit->distance * direction;
    const double distance = hit->distance * glm::length(direction);
    if (!open.empty() && glm::length(here - last) > kJump * step * distance) close();
    open.push_back(hit->place);
    last = here;
  }
};

}  // namespace

std::optional<SurfaceHit> first_hit(const mesh::Mesh& mesh, const glm::dvec3& eye, const glm::dvec3& direction) {
  std::optional<SurfaceHit> first;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& v = mesh.triangles[t];
    const glm::dvec3 a(mesh.positions[v.x]);
    const glm::dvec3 ab = glm::dvec3(mesh.positions[v.y]) - a, ac = glm::dvec3(mesh.positions[v.z]) - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) continue;
    const glm::dvec3 from_a = eye - a;
    const double b = glm::dot(from_a, p) / determinant;
    if (!(b >= 0 && b <= 1)) continue;
    const glm::dvec3 q = glm::cross(from_a, ab);
    const double c = glm::dot(direction, q) / determinant;
    if (!(c >= 0 && b + c <= 1)) continue;
    const double distance = glm::dot(ac, q) / determinant;
    if (distance > 0 && (!first || distance < first->distance)) {
      first = SurfaceHit{{t, static_cast<float>(b), static_cast<float>(c)}, distance};
    }
  }
  return first;
}

std::vector<DrawnLine> lay_onto(const mesh::Mesh& mesh, std::span<const std::vector<glm::dvec2>> lines_px,
                                const glm::dvec3& eye,
                                const std::function<std::optional<glm::dvec3>(const glm::dvec2&)>& ray) {
  constexpr double step_px = 2;
  Follower follower{mesh, eye};
  for (const std::vector<glm::dvec2>& line : lines_px) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const int count = std::max(static_cast<int>(std::ceil(glm::length(line[i] - line[i - 1]) / step_px)), 1);
      for (int k = i == 1 ? 0 : 1; k <= count; ++k) {
        const glm::dvec2 px = glm::mix(line[i - 1], line[i], static_cast<double>(k) / count);
        const auto direction = ray(px), beside = ray(px + glm::dvec2(step_px, 0));
        if (!direction || !beside) {
          follower.close();
          continue;
        }
        const double step = glm::length(glm::normalize(*beside) - glm::normalize(*direction));
        follower.meet(first_hit(mesh, eye, *direction), *direction, step);
      }
    }
    follower.close();
  }
  return std::move(follower.parts);
}

}  // namespace rinkaku::outline

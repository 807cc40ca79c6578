#include "mesh/contour.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace rinkaku::mesh {

ContourFinder::ContourFinder(const Mesh& mesh, const Topology& topology, const ContourOptions& options)
    : options_(options),
      triangles_(mesh.triangles),
      non_manifold_faces_(topology.non_manifold_faces),
      non_manifold_first_(topology.non_manifold_first) {
  const Sphere sphere = bounding_sphere(mesh.positions);
  origin_ = sphere.centre;
  radius_ = sphere.radius;

  const std::size_t count = mesh.triangles.size();
  for (auto* component : {&nx_, &ny_, &nz_, &offset_}) component->resize(count);
  for (std::size_t f = 0; f < count; ++f) {
    const glm::uvec3& face = topology.faces[f];
    const glm::dvec3 a = glm::dvec3(topology.points[face.x]);
    glm::dvec3 normal = glm::cross(glm::dvec3(topology.points[face.y]) - a, glm::dvec3(topology.points[face.z]) - a);
    const double length = glm::length(normal);
    // The topology knows which faces have no area of their own; their plane is their neighbour's.
    const glm::dvec3 stored(topology.face_normals[f]);
    normal = length > 0 && glm::dot(normal, stored) > 0.5 * length ? normal / length : stored;
    nx_[f] = static_cast<float>(normal.x);
    ny_[f] = static_cast<float>(normal.y);
    nz_[f] = static_cast<float>(normal.z);
    offset_[f] = static_cast<float>(glm::dot(normal, a - origin_));
  }

  two_sided_.resize(count);
  for (const Part& part : mesh.parts) {
    parts_.push_back({part.first_triangle, part.triangle_count});
    const bool material = mesh.materials[part.material].two_sided;
    for (std::uint32_t f = part.first_triangle; f < part.first_triangle + part.triangle_count; ++f) {
      two_sided_[f] = material || topology.component_two_sided[topology.component[f]] != 0;
    }
  }
  const std::uint32_t two_faced = topology.consistent_edges + topology.inconsistent_edges;
  for (std::uint32_t e = 0; e < two_faced; ++e) {
    const Edge& edge = topology.edges[e];
    (e < topology.consistent_edges ? consistent_ : inconsistent_).push_back({edge.face0, edge.face1});
  }
  first_non_manifold_ = two_faced + topology.boundary_edges;

  for (auto* flags : {&front_, &seen_front_, &flat_}) flags->resize(count);
  flat_faces_.reserve(count);
  // Lists are written without branches, one entry past the last kept one.
  front_indices_.resize(count * 3 + 3);
  contour_.resize(topology.edges.size() + 1);
  front_parts_.resize(parts_.size());
}

void ContourFinder::move(std::span<const glm::uvec3> faces, std::span<const glm::vec3> points, const Box& box) {
  origin_ = box.centre();
  radius_ = glm::distance(glm::dvec3(box.max), origin_);
  moved_faces_ = faces;
  moved_points_ = points;
}

// Until the next time.
void ContourFinder::set_normal(std::uint32_t f, const glm::vec3& normal) {
  lent_.push_back({f, {nx_[f], ny_[f], nz_[f]}});
  nx_[f] = normal.x;
  ny_[f] = normal.y;
  nz_[f] = normal.z;
}

// From neighbour to neighbour, some faces far; those further inside a squeezed part have the normal they have at rest.
void ContourFinder::borrow_normals() {
  constexpr int most_steps = 8;
  for (; !lent_.empty(); lent_.pop_back()) {
    const auto& [f, normal] = lent_.back();
    nx_[f] = normal.x, ny_[f] = normal.y, nz_[f] = normal.z;
  }
  for (const std::uint32_t f : flat_faces_) flat_[f] = 2;
  for (int step = 0; step < most_steps; ++step) {
    bool any = false;
    for (const EdgeFaces& edge : consistent_) {
      if ((flat_[edge.face0] == 2) == (flat_[edge.face1] == 2)) continue;
      const std::uint32_t to = flat_[edge.face0] == 2 ? edge.face0 : edge.face1;
      const std::uint32_t from = flat_[edge.face0] == 2 ? edge.face1 : edge.face0;
      if (flat_[from] == 0) {
        const glm::vec3& corner = moved_points_[moved_faces_[from].x];
        const glm::vec3 u = moved_points_[moved_faces_[from].y] - corner;
        const glm::vec3 v = moved_points_[moved_faces_[from].z] - corner;
        set_normal(to, glm::normalize(glm::cross(u, v)));
      } else {
        set_normal(to, {nx_[from], ny_[from], nz_[from]});
      }
      flat_[to] = 1;
      any = true;
    }
    if (!any) break;
  }
  const glm::vec3 origin(origin_);
  for (const std::uint32_t f : flat_faces_) {
    flat_[f] = 0;
    offset_[f] = glm::dot(glm::vec3(nx_[f], ny_[f], nz_[f]), moved_points_[moved_faces_[f].x] - origin);
  }
}

void ContourFinder::classify(std::uint32_t f, const Eye& eye) {
  const float distance = nx_[f] * eye.x + ny_[f] * eye.y + nz_[f] * eye.z - offset_[f] * eye.w;
  front_[f] = distance > 0 ? 1 : 0;
  seen_front_[f] = static_cast<std::uint8_t>((distance > -eye.margin ? 1 : 0) | two_sided_[f]);
}

const Contour& ContourFinder::find(const glm::dvec4& eye, const ContourLists& lists, const KnownFaces* known) {
  if (!moved_faces_.empty()) {
    known = nullptr;
    flat_faces_.clear();
    const Eye seen = seen_from(eye);
    classify_moved(moved_faces_, moved_points_, glm::vec3(origin_), seen, two_sided_, front_, seen_front_, flat_faces_);
    if (!flat_faces_.empty()) borrow_normals();
    for (const std::uint32_t f : flat_faces_) classify(f, seen);
  } else if (known != nullptr) {
    classify_doubtful(seen_from(eye), *known);
  } else {
    classify_all(seen_from(eye));
  }
  result_.front = front_;
  result_.front_indices = result_.edges = {};
  result_.front_parts = {};
  if (lists.front) list_front();
  if (lists.edges) list_edges(known);
  return result_;
}

Eye ContourFinder::seen_from(const glm::dvec4& eye) const {
  const double sign = eye.w < 0 ? -1.0 : 1.0;
  glm::dvec3 towards = (glm::dvec3(eye) - eye.w * origin_) * sign;
  double w = eye.w * sign;
  const double scale = std::max(glm::length(towards), w * radius_);
  if (scale > 0) {
    towards /= scale;
    w /= scale;
  }
  // No point of the mesh is further from the eye than this, so the margin is an angle at least as large as asked for.
  const double margin = options_.margin * (glm::length(towards) + w * radius_);
  return {static_cast<float>(towards.x), static_cast<float>(towards.y), static_cast<float>(towards.z),
          static_cast<float>(w), static_cast<float>(margin)};
}

void ContourFinder::classify_all(const Eye& eye) {
  known_serial_ = 0;
  const std::size_t count = triangles_.size();
  const float* nx = nx_.data();
  const float* ny = ny_.data();
  const float* nz = nz_.data();
  const float* offset = offset_.data();
  const std::uint8_t* two_sided = two_sided_.data();
  std::uint8_t* front = front_.data();
  std::uint8_t* seen_front = seen_front_.data();
  const Eye e = eye;  // a copy, that no store may change
  for (std::size_t f = 0; f < count; ++f) {
    const float distance = nx[f] * e.x + ny[f] * e.y + nz[f] * e.z - offset[f] * e.w;
    front[f] = distance > 0 ? 1 : 0;
    seen_front[f] = static_cast<std::uint8_t>((distance > -e.margin ? 1 : 0) | two_sided[f]);
  }
}

void ContourFinder::classify_doubtful(const Eye& eye, const KnownFaces& known) {
  if (known.serial != known_serial_) {
    std::copy(known.front.begin(), known.front.end(), front_.begin());
    for (std::size_t f = 0; f < front_.size(); ++f) {
      seen_front_[f] = static_cast<std::uint8_t>(front_[f] | two_sided_[f]);
    }
    known_serial_ = known.serial;
  }
  for (const std::uint32_t f : known.doubtful) classify(f, eye);
}

namespace {

// Writes without a branch; the entry counts only if it is kept.
void append(std::uint32_t*& to, const glm::uvec3& triangle, std::uint8_t keep) {
  to[0] = triangle.x;
  to[1] = triangle.y;
  to[2] = triangle.z;
  to += 3 * std::ptrdiff_t{keep};
}

}  // namespace

void ContourFinder::list_front() {
  std::uint32_t* front = front_indices_.data();
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const std::uint32_t* part_start = front;
    for (std::uint32_t f = parts_[p].first; f < parts_[p].first + parts_[p].count; ++f) {
      append(front, triangles_[f], seen_front_[f]);
    }
    front_parts_[p] = {static_cast<std::uint32_t>(part_start - front_indices_.data()),
                       static_cast<std::uint32_t>(front - part_start)};
  }
  result_.front_indices = {front_indices_.data(), front};
  result_.front_parts = front_parts_;
}

void ContourFinder::list_edges(const KnownFaces* known) {
  const std::uint8_t* front = front_.data();
  std::uint32_t* out = contour_.data();
  std::uint32_t edge = 0;
  if (known != nullptr) {
    for (const std::uint32_t e : known->edges) {
      *out = e;
      out += front[consistent_[e].face0] ^ front[consistent_[e].face1];
    }
    edge = static_cast<std::uint32_t>(consistent_.size());
  } else {
    for (const EdgeFaces& faces : consistent_) {
      *out = edge++;
      out += front[faces.face0] ^ front[faces.face1];
    }
  }
  for (const EdgeFaces& faces : inconsistent_) {
    *out = edge++;
    out += 1 ^ front[faces.face0] ^ front[faces.face1];
  }
  for (; edge < first_non_manifold_; ++edge) *out++ = edge;
  for (std::size_t run = 0; run + 1 < non_manifold_first_.size(); ++run, ++edge) {
    // A face lies on the edge's left if it is seen from the front and runs along it, or neither.
    int left = 0;
    int right = 0;
    for (std::uint32_t k = non_manifold_first_[run]; k < non_manifold_first_[run + 1]; ++k) {
      const EdgeFace& of = non_manifold_faces_[k];
      ((front[of.face] != 0) != of.reversed ? left : right)++;
    }
    if (left == 0 || right == 0) *out++ = edge;
  }
  result_.edges = {contour_.data(), out};
}

}  // namespace rinkaku::mesh

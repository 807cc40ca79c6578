#include "outline/corrected_curvature.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rinkaku::outline {
namespace {

constexpr std::size_t kBlock = 64;
using Row = std::array<float, kBlock>;

struct Rows3 {
  alignas(32) Row x, y, z;
};

// Corners of up to kBlock faces, coordinate by coordinate, so that faces are computed side by side.
struct Block {
  Rows3 i, j, k;

  void load(std::span<const glm::uvec3> faces, const glm::vec4* from) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const glm::vec4 &p = from[faces[f].x], &q = from[faces[f].y], &r = from[faces[f].z];
      i.x[f] = p.x, i.y[f] = p.y, i.z[f] = p.z;
      j.x[f] = q.x, j.y[f] = q.y, j.z[f] = q.z;
      k.x[f] = r.x, k.y[f] = r.y, k.z[f] = r.z;
    }
  }
};

// Zeroed, so that rows beyond a last, short block hold numbers too.
struct Scratch {
  Block points{}, normals{};
  Rows3 cross{};
  alignas(32) Row weight_i{}, weight_j{}, weight_k{};
  alignas(32) Row area{}, mean{}, gauss{}, flat_area{};
};

// The same in curvature_normals.comp.
void weigh_corners(Scratch& s) {
  constexpr float shortest_sq = 1e-6f, least_product = 1e-36f;
  const Block& p = s.points;
  for (std::size_t f = 0; f < kBlock; ++f) {
    const float ax = p.j.x[f] - p.i.x[f], ay = p.j.y[f] - p.i.y[f], az = p.j.z[f] - p.i.z[f];
    const float bx = p.k.x[f] - p.i.x[f], by = p.k.y[f] - p.i.y[f], bz = p.k.z[f] - p.i.z[f];
    const float cx = bx - ax, cy = by - ay, cz = bz - az;
    s.cross.x[f] = ay * bz - az * by;
    s.cross.y[f] = az * bx - ax * bz;
    s.cross.z[f] = ax * by - ay * bx;
    float aa = ax * ax + ay * ay + az * az;
    float bb = bx * bx + by * by + bz * bz;
    float cc = cx * cx + cy * cy + cz * cz;
    const float longest = std::max(aa, std::max(bb, cc));
    const float least = shortest_sq * longest;
    aa = std::max(aa, least), bb = std::max(bb, least), cc = std::max(cc, least);
    // Max's 1 / (|e|^2 |e'|^2) for the edges at each corner, with one division for the three.
    const float share = 1.0f / std::max(aa * bb * cc, least_product);
    s.weight_i[f] = share * cc;
    s.weight_j[f] = share * bb;
    s.weight_k[f] = share * aa;
  }
}

// The same in curvature_faces.comp.
void measure_faces(Scratch& s) {
  const Block &p = s.points, &u = s.normals;
  for (std::size_t f = 0; f < kBlock; ++f) {
    const float ax = p.j.x[f] - p.i.x[f], ay = p.j.y[f] - p.i.y[f], az = p.j.z[f] - p.i.z[f];
    const float bx = p.k.x[f] - p.i.x[f], by = p.k.y[f] - p.i.y[f], bz = p.k.z[f] - p.i.z[f];
    const float nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    const float ux = u.i.x[f], uy = u.i.y[f], uz = u.i.z[f];
    const float vx = u.j.x[f], vy = u.j.y[f], vz = u.j.z[f];
    const float wx = u.k.x[f], wy = u.k.y[f], wz = u.k.z[f];
    const float mx = (ux + vx + wx) / 3.0f, my = (uy + vy + wy) / 3.0f, mz = (uz + vz + wz) / 3.0f;
    const float dx = ux - wx, dy = uy - wy, dz = uz - wz;  // ui - uk
    const float ex = vx - ux, ey = vy - uy, ez = vz - uz;  // uj - ui
    const float tx = (dy * az - dz * ay) + (ey * bz - ez * by);
    const float ty = (dz * ax - dx * az) + (ez * bx - ex * bz);
    const float tz = (dx * ay - dy * ax) + (ex * by - ey * bx);
    s.area[f] = 0.5f * (mx * nx + my * ny + mz * nz);
    s.mean[f] = 0.5f * (mx * tx + my * ty + mz * tz);
    // ui . (uj x uk) as ui . ((uj - ui) x (uk - ui)): the large parts that cancel are left out.
    s.gauss[f] = 0.5f * (ux * (ez * dy - ey * dz) + uy * (ex * dz - ez * dx) + uz * (ey * dx - ex * dy));
    s.flat_area[f] = 0.5f * std::sqrt(nx * nx + ny * ny + nz * nz);
  }
}

template <typename Body>
void for_blocks(std::span<const glm::uvec3> faces, Body body) {
  for (std::size_t at = 0; at < faces.size(); at += kBlock) {
    body(faces.subspan(at, std::min(kBlock, faces.size() - at)));
  }
}

void add(glm::vec4& to, const Rows3& v, const Row& weight, std::size_t f) {
  to.x += v.x[f] * weight[f];
  to.y += v.y[f] * weight[f];
  to.z += v.z[f] * weight[f];
}

void add(Measures& to, const Scratch& s, std::size_t f) {
  to.area += s.area[f];
  to.mean += s.mean[f];
  to.gauss += s.gauss[f];
  to.flat_area += s.flat_area[f];
}

void normalise(glm::vec4& n) {
  constexpr float least_sq = 1e-36f;
  const float length_sq = n.x * n.x + n.y * n.y + n.z * n.z;
  const float scale = length_sq > least_sq ? 1.0f / std::sqrt(length_sq) : 0.0f;
  n = glm::vec4(n.x * scale, n.y * scale, n.z * scale, 0);
}

}  // namespace

CorrectedCurvature::CorrectedCurvature(const FaceStars& stars)
    : normals_(stars.point_count()), measures_(stars.point_count()) {}

void CorrectedCurvature::add_normals(std::span<const glm::uvec3> all, std::span<const glm::vec4> points) {
  Scratch s;
  for_blocks(all, [&](std::span<const glm::uvec3> faces) {
    s.points.load(faces, points.data());
    weigh_corners(s);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      add(normals_[faces[f].x], s.cross, s.weight_i, f);
      add(normals_[faces[f].y], s.cross, s.weight_j, f);
      add(normals_[faces[f].z], s.cross, s.weight_k, f);
    }
  });
}

void CorrectedCurvature::add_measures(std::span<const glm::uvec3> all, std::span<const glm::vec4> points) {
  Scratch s;
  for_blocks(all, [&](std::span<const glm::uvec3> faces) {
    s.points.load(faces, points.data());
    s.normals.load(faces, normals_.data());
    measure_faces(s);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (int c = 0; c < 3; ++c) add(measures_[faces[f][c]], s, f);
    }
  });
}

void CorrectedCurvature::run(const FaceStars& stars, std::span<const glm::vec4> points) {
  std::fill(normals_.begin(), normals_.end(), glm::vec4(0));
  add_normals(stars.faces, points);
  for (glm::vec4& n : normals_) normalise(n);
  std::fill(measures_.begin(), measures_.end(), Measures{});
  add_measures(stars.faces, points);
}

void CorrectedCurvature::run_at(const FaceStars& stars, std::span<const glm::vec3> points, float scale,
                                std::span<const std::uint32_t> wanted) {
  seen_face_.resize(stars.faces.size());
  seen_at_.resize(stars.point_count());
  scaled_.resize(stars.point_count());
  // The faces around points and their corners, each once.
  const auto collect = [&](std::span<const std::uint32_t> around, std::vector<glm::uvec3>& faces,
                           std::vector<std::uint32_t>& corners) {
    ++sweep_;
    faces.clear();
    corners.clear();
    for (const std::uint32_t p : around) {
      for (const std::uint32_t corner : stars.at(p)) {
        const std::uint32_t f = corner / 3;
        if (seen_face_[f] == sweep_) continue;
        seen_face_[f] = sweep_;
        const glm::uvec3& face = stars.faces[f];
        faces.push_back(face);
        for (int c = 0; c < 3; ++c) {
          if (seen_at_[face[c]] == sweep_) continue;
          seen_at_[face[c]] = sweep_;
          corners.push_back(face[c]);
        }
      }
    }
  };
  collect(wanted, inner_faces_, ring_);
  collect(ring_, faces_, second_ring_);
  for (const std::uint32_t p : second_ring_) {
    scaled_[p] = glm::vec4(points[p] * scale, 0);
    normals_[p] = glm::vec4(0);
    measures_[p] = {};
  }
  add_normals(faces_, scaled_);
  for (const std::uint32_t p : ring_) normalise(normals_[p]);
  add_measures(inner_faces_, scaled_);
}

MeanAndGauss from_measures(const Measures& sum) {
  constexpr float least_seen = 0.05f;
  if (!(sum.flat_area > 0)) return {};
  const float area = std::max(sum.area, least_seen * sum.flat_area);
  return {sum.mean / (2 * area), sum.gauss / area};
}

}  // namespace rinkaku::outline

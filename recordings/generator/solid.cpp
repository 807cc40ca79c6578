#include "recordings/generator/solid.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rinkaku::recordings {
namespace {

constexpr float pi = 3.14159265f;
constexpr float nearest = 1e-5f;

float turn_of(glm::vec3 p) {
  const float a = std::atan2(p.y, p.x) / (2 * pi);
  return a < 0 ? a + 1 : a;
}

struct LocalHit {
  float t;
  int face;
  glm::vec2 uv;
  glm::vec3 normal;
};

bool hit_box(glm::vec3 size, glm::vec3 o, glm::vec3 d, LocalHit& hit) {
  const glm::vec3 inverse = 1.0f / d;
  const glm::vec3 a = (-size - o) * inverse, b = (size - o) * inverse;
  const glm::vec3 low = glm::min(a, b), high = glm::max(a, b);
  const float enter = std::max({low.x, low.y, low.z}), leave = std::min({high.x, high.y, high.z});
  if (enter > leave || enter < nearest || enter >= hit.t) return false;
  const int axis = enter == low.x ? 0 : enter == low.y ? 1 : 2;
  const glm::vec3 p = (o + enter * d) / size;
  const bool positive = d[axis] < 0;
  glm::vec3 normal(0);
  normal[axis] = positive ? 1.0f : -1.0f;
  const glm::vec2 uv = axis == 0 ? glm::vec2(p.y, p.z) : axis == 1 ? glm::vec2(p.x, p.z) : glm::vec2(p.x, p.y);
  hit = {enter, 2 * axis + (positive ? 1 : 0), 0.5f + 0.5f * uv, normal};
  return true;
}

bool hit_side(glm::vec3 size, glm::vec3 o, glm::vec3 d, LocalHit& hit) {
  const float slope = (size.y - size.x) / size.z;
  const float ro = size.x + slope * o.z, rd = slope * d.z;
  const float a = d.x * d.x + d.y * d.y - rd * rd, b = o.x * d.x + o.y * d.y - ro * rd;
  const float c = o.x * o.x + o.y * o.y - ro * ro;
  const float discriminant = b * b - a * c;
  if (discriminant <= 0 || std::abs(a) < 1e-12f) return false;
  const float root = std::sqrt(discriminant);
  for (const float t : {std::min((-b - root) / a, (-b + root) / a), std::max((-b - root) / a, (-b + root) / a)}) {
    if (t < nearest || t >= hit.t) continue;
    const glm::vec3 p = o + t * d;
    if (p.z < 0 || p.z > size.z) continue;
    const float r = std::hypot(p.x, p.y);
    hit = {t, 0, {turn_of(p), p.z / size.z}, glm::normalize(glm::vec3(p.x, p.y, -slope * r))};
    return true;
  }
  return false;
}

bool hit_ring(float inner, float outer, float z, int face, glm::vec3 o, glm::vec3 d, LocalHit& hit) {
  const float t = (z - o.z) / d.z;
  if (!(t >= nearest) || t >= hit.t) return false;
  const glm::vec3 p = o + t * d;
  const float r2 = p.x * p.x + p.y * p.y;
  if (r2 > outer * outer || r2 < inner * inner) return false;
  hit = {t, face, 0.5f + 0.5f * glm::vec2(p) / outer, {0, 0, face == 1 ? -1.0f : 1.0f}};
  return true;
}

bool hit_ellipsoid(glm::vec3 size, glm::vec3 o, glm::vec3 d, LocalHit& hit) {
  const glm::vec3 oo = o / size, dd = d / size;
  const float a = glm::dot(dd, dd), b = glm::dot(oo, dd), c = glm::dot(oo, oo) - 1;
  const float discriminant = b * b - a * c;
  if (discriminant <= 0) return false;
  const float t = (-b - std::sqrt(discriminant)) / a;
  if (t < nearest || t >= hit.t) return false;
  const glm::vec3 p = oo + t * dd;
  hit = {t, 0, {turn_of(p), std::acos(glm::clamp(-p.z, -1.0f, 1.0f)) / pi}, glm::normalize(p / size)};
  return true;
}

// Steps by the distance to the tube, which is never overestimated.
bool hit_arc(glm::vec3 size, glm::vec3 o, glm::vec3 d, LocalHit& hit) {
  const float reach = size.x + size.y, along = -glm::dot(o, d);
  const float half2 = reach * reach - glm::dot(o, o) + along * along;
  if (half2 <= 0) return false;
  const float end = std::min(hit.t, along + std::sqrt(half2));
  float t = std::max(nearest, along - std::sqrt(half2));
  for (int step = 0; step < 64 && t < end; ++step) {
    const glm::vec3 p = o + t * d;
    const float ring = std::hypot(p.x, p.z);
    const float away =
        p.x >= 0 ? std::hypot(ring - size.x, p.y) : std::hypot(std::hypot(p.x, p.y), std::abs(p.z) - size.x);
    if (away - size.y < 2e-6f && p.x >= 0) {
      const glm::vec3 core = size.x / ring * glm::vec3(p.x, 0, p.z);
      const glm::vec3 normal = glm::normalize(p - core);
      const float around = std::atan2(p.y, ring - size.x) / (2 * pi);
      hit = {t, 0, {0.5f + std::atan2(p.z, p.x) / pi, around < 0 ? around + 1 : around}, normal};
      return true;
    }
    t += std::max(1e-5f, away - size.y);
  }
  return false;
}

}  // namespace

int Solid::faces(Shape shape) { return shape == Shape::Box ? 6 : shape == Shape::Frustum ? 3 : 1; }

bool intersect(const Solid& solid, glm::vec3 origin, glm::vec3 direction, Hit& hit) {
  const glm::mat3 local = glm::transpose(solid.rotation);
  const glm::vec3 o = local * (origin - solid.position), d = local * direction;
  LocalHit found{hit.distance, 0, {}, {}};
  bool any = false;
  switch (solid.shape) {
    case Solid::Shape::Box:
      any = hit_box(solid.size, o, d, found);
      break;
    case Solid::Shape::Frustum:
      any = hit_side(solid.size, o, d, found);
      any |= hit_ring(0, solid.size.x, 0, 1, o, d, found);
      any |= hit_ring(0, solid.size.y, solid.size.z, 2, o, d, found);
      break;
    case Solid::Shape::Tube:
      any = hit_side(solid.size, o, d, found);
      break;
    case Solid::Shape::Ring:
      any = hit_ring(solid.size.x, solid.size.y, 0, 0, o, d, found);
      break;
    case Solid::Shape::Ellipsoid:
      any = hit_ellipsoid(solid.size, o, d, found);
      break;
    case Solid::Shape::Arc:
      any = hit_arc(solid.size, o, d, found);
      break;
  }
  if (!any) return false;
  hit.distance = found.t;
  hit.face = found.face;
  hit.uv = found.uv;
  hit.point = origin + found.t * direction;
  hit.normal = solid.rotation * found.normal;
  if (glm::dot(hit.normal, direction) > 0) hit.normal = -hit.normal;
  return true;
}

FacePoint face_point(const Solid& solid, int face, glm::vec2 uv) {
  glm::vec3 p(0), n(0);
  const glm::vec2 s = 2.0f * uv - 1.0f;
  const auto side = [&](float slope) {
    const float a = 2 * pi * uv.x, r = solid.size.x + slope * uv.y * solid.size.z;
    p = {r * std::cos(a), r * std::sin(a), uv.y * solid.size.z};
    n = glm::normalize(glm::vec3(std::cos(a), std::sin(a), -slope));
  };
  const auto disc = [&](float radius, float z, float up) {
    p = glm::vec3(s * radius, z);
    n = {0, 0, up};
  };
  switch (solid.shape) {
    case Solid::Shape::Box: {
      const int axis = face / 2;
      const float sign = face % 2 == 1 ? 1.0f : -1.0f;
      const glm::vec3 q = axis == 0   ? glm::vec3(sign, s.x, s.y)
                          : axis == 1 ? glm::vec3(s.x, sign, s.y)
                                      : glm::vec3(s.x, s.y, sign);
      p = q * solid.size;
      n[axis] = sign;
      break;
    }
    case Solid::Shape::Frustum:
      if (face == 0) side((solid.size.y - solid.size.x) / solid.size.z);
      if (face == 1) disc(solid.size.x, 0, -1);
      if (face == 2) disc(solid.size.y, solid.size.z, 1);
      break;
    case Solid::Shape::Tube:
      side((solid.size.y - solid.size.x) / solid.size.z);
      break;
    case Solid::Shape::Ring:
      disc(solid.size.y, 0, 1);
      break;
    case Solid::Shape::Ellipsoid: {
      const float a = 2 * pi * uv.x, z = -std::cos(pi * uv.y), r = std::sin(pi * uv.y);
      const glm::vec3 q(r * std::cos(a), r * std::sin(a), z);
      p = q * solid.size;
      n = glm::normalize(q / solid.size);
      break;
    }
    case Solid::Shape::Arc: {
      const float a = pi * (uv.x - 0.5f), b = 2 * pi * uv.y;
      const glm::vec3 out(std::cos(a), 0, std::sin(a));
      n = std::cos(b) * out + std::sin(b) * glm::vec3(0, 1, 0);
      p = solid.size.x * out + solid.size.y * n;
      break;
    }
  }
  return {solid.rotation * p + solid.position, solid.rotation * n};
}

glm::vec2 face_size_m(const Solid& solid, int face) {
  const glm::vec3 s = 2.0f * solid.size;
  switch (solid.shape) {
    case Solid::Shape::Box:
      return face / 2 == 0 ? glm::vec2(s.y, s.z) : face / 2 == 1 ? glm::vec2(s.x, s.z) : glm::vec2(s.x, s.y);
    case Solid::Shape::Frustum:
    case Solid::Shape::Tube:
      if (face == 0) return {pi * std::max(s.x, s.y), solid.size.z};
      return glm::vec2(face == 1 ? s.x : s.y);
    case Solid::Shape::Ring:
      return glm::vec2(s.y);
    case Solid::Shape::Ellipsoid:
      return {pi * std::max(s.x, s.y), 0.5f * pi * s.z};
    case Solid::Shape::Arc:
      return {pi * solid.size.x, pi * s.y};
  }
  return glm::vec2(1);
}

glm::vec3 bounding_centre(const Solid& solid) {
  const bool along = solid.shape == Solid::Shape::Frustum || solid.shape == Solid::Shape::Tube;
  return solid.position + (along ? solid.rotation * glm::vec3(0, 0, 0.5f * solid.size.z) : glm::vec3(0));
}

glm::vec3 bounding_half_size(const Solid& solid) {
  if (solid.shape != Solid::Shape::Box) return glm::vec3(bounding_radius(solid));
  glm::vec3 half(0);
  for (int axis = 0; axis < 3; ++axis) half += glm::abs(solid.rotation[axis]) * solid.size[axis];
  return half;
}

float bounding_radius(const Solid& solid) {
  const glm::vec3 s = solid.size;
  switch (solid.shape) {
    case Solid::Shape::Box:
      return glm::length(s);
    case Solid::Shape::Frustum:
    case Solid::Shape::Tube:
      return std::hypot(std::max(s.x, s.y), 0.5f * s.z);
    case Solid::Shape::Ring:
      return s.y;
    case Solid::Shape::Ellipsoid:
      return std::max({s.x, s.y, s.z});
    case Solid::Shape::Arc:
      return s.x + s.y;
  }
  return 0;
}

}  // namespace rinkaku::recordings

#include "silhouette/verify/check_views.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace rinkaku::silhouette {

// The same numbers on every platform: only the engine is the standard's, not its distributions.
class CheckViews::Random {
 public:
  Random(std::uint64_t seed, std::uint64_t n) : engine_(seed * 0x9e3779b97f4a7c15u + n) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(unit() * static_cast<double>(count)); }
  bool chance(double probability) { return unit() < probability; }
  glm::dvec3 direction() {
    const double z = between(-1, 1), angle = between(-M_PI, M_PI), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::mt19937_64 engine_;
};

namespace {

// Farther eyes see nearly parallel rays.
constexpr double farthest_radii = 1000;

glm::dvec3 any_perpendicular(const glm::dvec3& v) {
  return glm::normalize(
      glm::cross(v, std::abs(v.y) < 0.9 * glm::length(v) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
}

}  // namespace

CheckViews::CheckViews(ViewSpace space, const UnitFrame& frame, const CheckViewOptions& options)
    : space_(std::move(space)), frame_(frame), options_(options), finder_(space_) {}

// A random convex combination of a vertex, an edge's, a face's, or all of a hull's vertices. Vertices in infinity only
// push outwards, by how much is drawn so that near and far eyes are alike frequent.
CheckViews::Eye CheckViews::eye_on_hull(Random& random) {
  Eye eye;
  eye.region = random.below(region_count(space_));
  const ViewRegion region = view_region(space_, eye.region);
  const auto [at, fresh] = faces_.try_emplace(eye.region);
  if (fresh) at->second = hull_faces(region);
  const HullFaces& faces = at->second;

  std::vector<glm::dvec4> corners;
  const std::uint32_t kind = random.below(4);
  if (kind == 0) {
    eye.where = "hull vertex";
    const glm::dvec4& vertex = region.hull[random.below(region.hull.size())];
    corners.push_back(vertex);
  } else if (kind == 1) {
    eye.where = "hull edge";
    for (const std::uint32_t v : faces.edges[random.below(faces.edges.size())]) corners.push_back(region.hull[v]);
  } else if (kind == 2) {
    eye.where = "hull face";
    for (const std::uint32_t v : faces.faces[random.below(faces.faces.size())]) corners.push_back(region.hull[v]);
  } else {
    eye.where = "inside";
    corners = region.hull;
  }
  const bool finite = std::any_of(corners.begin(), corners.end(), [](const glm::dvec4& c) { return c.w > 0; });
  glm::dvec3 sum(0), outwards(0);
  double weights = 0;
  for (const glm::dvec4& corner : corners) {
    const double weight = -std::log1p(-random.unit()) + 1e-12;
    if (corner.w > 0) {
      sum += weight / corner.w * glm::dvec3(corner);
      weights += weight;
    } else {
      outwards += weight * glm::dvec3(corner);
    }
  }
  eye.unit = finite ? sum / weights : glm::dvec3(0);
  if (glm::length(outwards) > 0) {
    // As if 1 / r were even: half of the eyes lie within twice the inner distance.
    const double near = finite ? glm::length(eye.unit) : farthest_radii;
    const double reach = finite ? std::min(near * random.unit() / (1 - random.unit()), farthest_radii) : near;
    eye.unit += glm::normalize(outwards) * reach;
  }
  return eye;
}

// Steps across a border and closes in on it from both sides.
std::optional<CheckViews::Eye> CheckViews::eye_at_border(Random& random) const {
  const double shells_reach = 8;
  glm::dvec3 a = random.direction() * random.between(1.05, shells_reach);
  glm::dvec3 b = a + random.direction() * random.between(0.2, 2.0);
  auto region_a = finder_.find(a), region_b = finder_.find(b);
  if (!region_a || !region_b || region_a == region_b) return std::nullopt;
  for (int halving = 0; halving < 60; ++halving) {
    const glm::dvec3 middle = (a + b) * 0.5;
    const auto region = finder_.find(middle);
    if (!region) return std::nullopt;
    if (region == region_a) {
      a = middle;
    } else {
      b = middle;
      region_b = region;
    }
  }
  return random.chance(0.5) ? Eye{a, *region_a, "border"} : Eye{b, *region_b, "border"};
}

CheckView CheckViews::placed(Random& random, const Eye& eye) const {
  CheckView out;
  out.region = eye.region;
  const double distance = glm::length(eye.unit);

  double scale = 1, offset = 0;
  glm::dvec3 uneven(1);
  const char* placing = "as it is";
  const std::uint32_t kind = random.below(8);
  if (kind == 1) {
    placing = "1e-4 large";
    scale = 1e-4 / frame_.radius;
  } else if (kind == 2) {
    placing = "1e4 large";
    scale = 1e4 / frame_.radius;
  } else if (kind == 3) {
    placing = "1e5 away";
    scale = 1 / frame_.radius;
    offset = 1e5;
  } else if (kind == 4) {
    placing = "uneven";
    uneven = {random.log_between(0.2, 5), random.log_between(0.2, 5), random.log_between(0.2, 5)};
  } else if (kind == 5) {
    placing = "mirrored";
    uneven = {random.log_between(0.5, 2), -1, random.log_between(0.5, 2)};
  } else if (kind == 6) {
    placing = "cut by the near plane";
    scale = passes::near_m / (random.between(distance - 0.9, distance + 0.9) * frame_.radius);
  } else if (kind == 7) {
    placing = "cut by the eye's plane";
  }
  const glm::dquat rotation = glm::angleAxis(random.between(-M_PI, M_PI), random.direction());
  out.world_from_object = glm::mat4_cast(rotation);
  for (int axis = 0; axis < 3; ++axis) out.world_from_object[axis] *= scale * uneven[axis];
  out.world_from_object[3] = glm::dvec4(random.direction() * offset, 1.0);

  // What is looked at lies on the object's silhouette or about it, so that there is something to compare.
  const auto in_world = [&](const glm::dvec3& unit) {
    return glm::dvec3(out.world_from_object * glm::dvec4(frame_.to_mesh(unit), 1.0));
  };
  const glm::dvec3 away = glm::normalize(eye.unit);
  const glm::dvec3 u = any_perpendicular(away), v = glm::cross(away, u);
  const double around = random.between(-M_PI, M_PI);
  const glm::dvec3 sideways = std::cos(around) * u + std::sin(around) * v;
  double fov = random.log_between(5, 120) * M_PI / 180;
  glm::dvec3 target = sideways * random.unit();
  if (kind == 7 && distance < 3) {
    // The plane through the eye cuts the object where the line of sight is nearly at right angles to its centre.
    target = eye.unit + sideways * random.between(1.0, 4.0) - away * random.between(-0.2, 1.0);
    fov = 2 * M_PI / 3;
  } else if (random.chance(0.4)) {
    fov = std::clamp(2.2 * std::asin(std::min(1.0, 1 / distance)), 5 * M_PI / 180, 120 * M_PI / 180);
    target *= 0.2;
  }
  static constexpr glm::ivec2 sizes[] = {{640, 480},  {640, 480},  {640, 480},  {640, 480},   {640, 480},
                                         {1280, 720}, {1280, 720}, {800, 1200}, {1920, 1080}, {3840, 2160}};
  const glm::ivec2 size = options_.size_px.value_or(sizes[random.below(std::size(sizes))]);
  out.view.camera = camera_of(size, fov);
  out.view.camera_from_world = looking_at(in_world(eye.unit), in_world(target));
  double largest_scale = 0;
  for (int axis = 0; axis < 3; ++axis) {
    largest_scale = std::max(largest_scale, glm::length(glm::dvec3(out.world_from_object[axis])));
  }
  const double radius_m = largest_scale * frame_.radius;
  const double distance_m = glm::length(in_world(eye.unit) - in_world(glm::dvec3(0)));
  out.radius_px = radius_px(out.view.camera.fx_px, radius_m, distance_m);
  char text[160];
  std::snprintf(text, sizeof text, "region %u, %s, %.3g radii off, %s, %dx%d, %.3g degrees", eye.region, eye.where,
                distance, placing, size.x, size.y, fov * 180 / M_PI);
  out.description = text;
  return out;
}

CheckView CheckViews::view(std::uint64_t n) {
  Random random(options_.seed, n);
  std::optional<Eye> eye;
  if (region_count(space_) > 1 && random.chance(0.25)) {
    for (int attempt = 0; attempt < 100 && !eye; ++attempt) eye = eye_at_border(random);
  }
  if (!eye) eye = eye_on_hull(random);
  return placed(random, *eye);
}

CameraModel camera_of(const glm::ivec2& size_px, double fov_rad) {
  CameraModel camera;
  camera.width_px = size_px.x;
  camera.height_px = size_px.y;
  camera.fx_px = camera.fy_px = size_px.y / 2.0 / std::tan(fov_rad / 2);
  camera.cx_px = (size_px.x - 1) / 2.0;
  camera.cy_px = (size_px.y - 1) / 2.0;
  return camera;
}

RigidTransform looking_at(const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 forward = glm::normalize(target - eye);
  const glm::dvec3 up = std::abs(forward.y) < 0.9999 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, up)), down = glm::cross(forward, right);
  const glm::dmat3 world_from_camera(right, down, forward);
  RigidTransform out;
  out.rotation = glm::conjugate(glm::normalize(glm::quat_cast(world_from_camera)));
  out.translation_m = -(out.rotation * eye);
  return out;
}

}  // namespace rinkaku::silhouette

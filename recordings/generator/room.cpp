#include "recordings/generator/room.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "recordings/generator/parallel.h"
#include "recordings/generator/random.h"
#include "recordings/generator/solid.h"

namespace rinkaku::recordings {
namespace {

const std::array<float, 256>& linear_from_srgb() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) {
      const float v = static_cast<float>(i) / 255.0f;
      t[i] = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    }
    return t;
  }();
  return table;
}

bool misses_sphere(glm::vec3 origin, glm::vec3 direction, glm::vec3 centre, float radius) {
  const glm::vec3 to = centre - origin;
  const float along = glm::dot(to, direction), d2 = glm::dot(to, to), r2 = radius * radius;
  return d2 > r2 && (along < 0 || d2 - along * along > r2);
}

}  // namespace

int Room::add_surface(const Surface& surface) {
  surfaces_.push_back(surface);
  return static_cast<int>(surfaces_.size()) - 1;
}

int Room::add(const Solid& solid) {
  solids_.push_back(solid);
  centres_.push_back(bounding_centre(solid));
  radii_.push_back(bounding_radius(solid) * 1.001f);
  return static_cast<int>(solids_.size()) - 1;
}

void Room::set_light(const Window& window, glm::vec3 ambient_above, glm::vec3 ambient_below) {
  window_ = window;
  above_ = ambient_above;
  below_ = ambient_below;
}

const Surface& Room::surface(int solid, int face) const {
  const auto& of = solids_[static_cast<std::size_t>(solid)].surfaces;
  return surfaces_[static_cast<std::size_t>(of[std::min(of.size() - 1, static_cast<std::size_t>(face))])];
}

Hit Room::trace(glm::vec3 origin, glm::vec3 direction, const std::vector<int>* candidates) const {
  Hit hit;
  const auto test = [&](int i) {
    const std::size_t s = static_cast<std::size_t>(i);
    if (misses_sphere(origin, direction, centres_[s], radii_[s])) return;
    if (intersect(solids_[s], origin, direction, hit)) hit.solid = i;
  };
  if (candidates) {
    for (const int i : *candidates) test(i);
  } else {
    visit_along(origin, direction, hit.distance, [&](int i) {
      test(i);
      return true;
    });
  }
  return hit;
}

bool Room::is_blocked(glm::vec3 origin, glm::vec3 direction, float distance) const {
  Hit hit;
  hit.distance = distance;
  bool blocked = false;
  visit_along(origin, direction, distance, [&](int i) {
    const std::size_t s = static_cast<std::size_t>(i);
    blocked =
        !misses_sphere(origin, direction, centres_[s], radii_[s]) && intersect(solids_[s], origin, direction, hit);
    return !blocked;
  });
  return blocked;
}

void Room::build_tree() {
  std::vector<int> solids(solids_.size());
  for (std::size_t i = 0; i < solids.size(); ++i) solids[i] = static_cast<int>(i);
  tree_.clear();
  build_tree(solids, 0, solids.size());
}

void Room::build_tree(std::vector<int>& solids, std::size_t begin, std::size_t end) {
  const std::size_t at = tree_.size();
  Node node{glm::vec3(1e9f), glm::vec3(-1e9f)};
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t s = static_cast<std::size_t>(solids[i]);
    const glm::vec3 half = bounding_half_size(solids_[s]) * 1.001f + 1e-5f;
    node.low = glm::min(node.low, centres_[s] - half);
    node.high = glm::max(node.high, centres_[s] + half);
  }
  if (end - begin == 1) node.solid = solids[begin];
  tree_.push_back(node);
  if (end - begin == 1) return;
  const glm::vec3 size = node.high - node.low;
  const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  std::sort(solids.begin() + static_cast<std::ptrdiff_t>(begin), solids.begin() + static_cast<std::ptrdiff_t>(end),
            [&](int a, int b) {
              const float u = centres_[static_cast<std::size_t>(a)][axis],
                          v = centres_[static_cast<std::size_t>(b)][axis];
              return u != v ? u < v : a < b;
            });
  const std::size_t middle = (begin + end) / 2;
  build_tree(solids, begin, middle);
  tree_[at].second = static_cast<int>(tree_.size());
  build_tree(solids, middle, end);
}

template <class Visit>
void Room::visit_along(glm::vec3 origin, glm::vec3 direction, const float& distance, const Visit& visit) const {
  const glm::vec3 inverse = 1.0f / direction;
  std::array<int, 64> stack;
  int depth = 0;
  stack[static_cast<std::size_t>(depth++)] = 0;
  while (depth > 0) {
    const int at = stack[static_cast<std::size_t>(--depth)];
    const Node& node = tree_[static_cast<std::size_t>(at)];
    const glm::vec3 a = (node.low - origin) * inverse, b = (node.high - origin) * inverse;
    const glm::vec3 low = glm::min(a, b), high = glm::max(a, b);
    const float enter = std::max({low.x, low.y, low.z, 0.0f}), leave = std::min({high.x, high.y, high.z, distance});
    if (enter > leave) continue;
    if (node.solid >= 0) {
      if (!visit(node.solid)) return;
      continue;
    }
    stack[static_cast<std::size_t>(depth++)] = node.second;
    stack[static_cast<std::size_t>(depth++)] = at + 1;
  }
}

glm::vec3 Room::environment(glm::vec3 direction, glm::vec3 from, float sharpness) const {
  glm::vec3 light = glm::mix(below_, above_, 0.5f + 0.5f * direction.z);
  const glm::vec3 normal = glm::normalize(glm::cross(window_.side_u, window_.side_v));
  const float towards = -glm::dot(direction, normal);
  if (towards <= 0.01f) return light;
  const float t = glm::dot(window_.corner - from, normal) / glm::dot(direction, normal);
  const glm::vec3 at = from + t * direction - window_.corner;
  const float lu = glm::length(window_.side_u), lv = glm::length(window_.side_v);
  const float u = glm::dot(at, window_.side_u) / lu, v = glm::dot(at, window_.side_v) / lv;
  const float blur = t / std::sqrt(sharpness);
  const auto inside = [&](float x, float length) {
    return glm::smoothstep(-blur, blur, x) * (1 - glm::smoothstep(length - blur, length + blur, x));
  };
  // A blur wider than the window spreads its light thin.
  const float thin = std::min(1.0f, lu / (2 * blur)) * std::min(1.0f, lv / (2 * blur));
  float bars = 1;
  if (sharpness > 300) {
    for (const float x : {u / lu, v / lv}) bars *= glm::smoothstep(0.01f, 0.025f, std::abs(x - 0.5f));
  }
  return light + window_.radiance * inside(u, lu) * inside(v, lv) * thin * bars;
}

glm::vec3 Room::albedo(const Hit& hit) const {
  const Surface& s = surface(hit.solid, hit.face);
  if (s.texture.empty()) return s.colour;
  const auto& linear = linear_from_srgb();
  const float x = hit.uv.x * static_cast<float>(s.texture.cols) - 0.5f;
  const float y = (1 - hit.uv.y) * static_cast<float>(s.texture.rows) - 0.5f;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const auto at = [&](int i, int j) {
    const cv::Vec3b& c = s.texture(std::clamp(j, 0, s.texture.rows - 1), std::clamp(i, 0, s.texture.cols - 1));
    return glm::vec3(linear[c[2]], linear[c[1]], linear[c[0]]);
  };
  return s.colour *
         glm::mix(glm::mix(at(x0, y0), at(x0 + 1, y0), fx), glm::mix(at(x0, y0 + 1), at(x0 + 1, y0 + 1), fx), fy);
}

glm::vec3 Room::Lightmap::at(glm::vec2 uv) const {
  const float x = std::clamp(uv.x, 0.0f, 1.0f) * static_cast<float>(width) - 0.5f;
  const float y = std::clamp(uv.y, 0.0f, 1.0f) * static_cast<float>(height) - 0.5f;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const auto texel = [&](int i, int j) {
    return light[static_cast<std::size_t>(std::clamp(j, 0, height - 1) * width + std::clamp(i, 0, width - 1))];
  };
  return glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), fx),
                  glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), fx), fy);
}

glm::vec3 Room::irradiance(glm::vec3 point, glm::vec3 normal, int samples, glm::vec2 shift) const {
  const glm::vec3 origin = point + normal * 2e-4f;
  const glm::vec3 out = glm::cross(window_.side_u, window_.side_v);
  glm::vec3 direct(0), around(0);
  const glm::mat3 frame = frame_along(normal);
  for (int i = 0; i < samples; ++i) {
    const glm::vec2 u = low_discrepancy(i, shift);
    const glm::vec3 to = window_.corner + u.x * window_.side_u + u.y * window_.side_v - origin;
    const float d2 = glm::dot(to, to), d = std::sqrt(d2);
    const glm::vec3 direction = to / d;
    const float weight = glm::dot(direction, normal) * -glm::dot(direction, out) / d2;
    if (weight > 0 && !is_blocked(origin, direction, d)) direct += window_.radiance * weight;

    const float r = std::sqrt(u.x), a = 6.2831853f * u.y;
    const glm::vec3 bounce = frame * glm::vec3(r * std::cos(a), r * std::sin(a), std::sqrt(1 - u.x));
    const Hit hit = trace(origin, bounce);
    if (hit.solid < 0) {
      around += glm::mix(below_, above_, 0.5f + 0.5f * bounce.z);
    } else {
      // What other faces send back: their colour times a guess of the light on them.
      const glm::vec3 guess = 0.55f * glm::mix(below_, above_, 0.5f + 0.5f * hit.normal.z) +
                              0.3f * std::max(0.0f, glm::dot(hit.normal, -glm::normalize(out))) * above_;
      around += albedo(hit) * guess;
    }
  }
  return direct / (3.14159265f * static_cast<float>(samples)) + around / static_cast<float>(samples);
}

void Room::bake(float texel_m, int samples, const std::vector<glm::vec3>& eyes) {
  build_tree();
  lightmaps_.resize(solids_.size());
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    const Solid& solid = solids_[s];
    for (int face = 0; face < Solid::faces(solid.shape); ++face) {
      const glm::vec2 size = face_size_m(solid, face);
      const FacePoint middle = face_point(solid, face, {0.5f, 0.5f});
      const bool turned_away =
          solid.shape == Solid::Shape::Box && std::none_of(eyes.begin(), eyes.end(), [&](glm::vec3 eye) {
            return glm::dot(eye - middle.point, middle.normal) > 0;
          });
      if (turned_away) {
        lightmaps_[s].push_back({1, 1, {glm::vec3(0)}});
        continue;
      }
      Lightmap map;
      map.width = std::clamp(static_cast<int>(size.x / texel_m), 6, 640);
      map.height = std::clamp(static_cast<int>(size.y / texel_m), 4, 640);
      map.light.resize(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
      parallel_for(map.height, [&](int y) {
        for (int x = 0; x < map.width; ++x) {
          const glm::vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(map.width),
                             (static_cast<float>(y) + 0.5f) / static_cast<float>(map.height));
          const FacePoint at = face_point(solid, face, uv);
          const std::uint32_t key = static_cast<std::uint32_t>(s * 6 + static_cast<std::size_t>(face));
          const std::uint32_t ux = static_cast<std::uint32_t>(x), uy = static_cast<std::uint32_t>(y);
          const glm::vec2 shift(uniform({key, ux, uy, 1}), uniform({key, ux, uy, 2}));
          map.light[static_cast<std::size_t>(y * map.width + x)] = irradiance(at.point, at.normal, samples, shift);
        }
      });
      // The samples' noise is evened out over neighbouring texels.
      cv::Mat3f picture(map.height, map.width, reinterpret_cast<cv::Vec3f*>(map.light.data()));
      cv::Mat3f even = picture.clone();
      for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
          cv::Vec3f sum(0, 0, 0);
          float total = 0;
          for (int j = std::max(0, y - 1); j <= std::min(map.height - 1, y + 1); ++j) {
            for (int i = std::max(0, x - 1); i <= std::min(map.width - 1, x + 1); ++i) {
              sum += picture(j, i);
              total += 1;
            }
          }
          even(y, x) = sum / total;
        }
      }
      even.copyTo(picture);
      lightmaps_[s].push_back(std::move(map));
    }
  }
}

glm::vec3 Room::shade(const Hit& hit, glm::vec3 direction) const {
  if (hit.solid < 0) return environment(direction, glm::vec3(0), 40);
  const glm::vec3 light =
      lightmaps_[static_cast<std::size_t>(hit.solid)][static_cast<std::size_t>(hit.face)].at(hit.uv);
  glm::vec3 colour = albedo(hit) * light;
  const Surface& s = surface(hit.solid, hit.face);
  if (s.shine > 0) {
    const float cosine = std::min(1.0f, -glm::dot(hit.normal, direction)), away = 1 - cosine;
    const float fresnel = 0.04f + 0.96f * away * away * away * away * away;
    const glm::vec3 mirrored = direction + 2 * cosine * hit.normal;
    // Where little of the room's light falls, little of the room is mirrored.
    const float open = std::min(1.0f, (light.x + light.y + light.z) / (above_.x + above_.y + above_.z));
    colour += s.shine * fresnel * open * environment(mirrored, hit.point, s.sharpness);
  }
  return colour;
}

std::vector<int> Room::inside_cone(glm::vec3 origin, glm::vec3 axis, float half_angle) const {
  std::vector<int> seen;
  for (int i = 0; i < static_cast<int>(solids_.size()); ++i) {
    const glm::vec3 to = centres_[static_cast<std::size_t>(i)] - origin;
    const float d = glm::length(to), radius = radii_[static_cast<std::size_t>(i)];
    if (d <= radius) {
      seen.push_back(i);
      continue;
    }
    const float angle = std::acos(glm::clamp(glm::dot(to, axis) / d, -1.0f, 1.0f));
    if (angle <= half_angle + std::asin(radius / d)) seen.push_back(i);
  }
  return seen;
}

glm::mat3 turn_z(float degrees) {
  const float a = degrees * 3.14159265f / 180, c = std::cos(a), s = std::sin(a);
  return {c, s, 0, -s, c, 0, 0, 0, 1};
}

glm::mat3 frame_along(glm::vec3 z) {
  const glm::vec3 other = std::abs(z.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  const glm::vec3 x = glm::normalize(glm::cross(other, z));
  return {x, glm::cross(z, x), z};
}

}  // namespace rinkaku::recordings

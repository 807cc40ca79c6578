#include "recordings/generator/brook_land.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "recordings/generator/noise.h"
#include "recordings/generator/parallel.h"
#include "recordings/generator/random.h"

namespace rinkaku::recordings {
namespace {

// The brook's banks, counter-clockwise from where it leaves the picture; the scene file has the same corners.
const std::vector<glm::vec2> banks{{0.6f, -2.5f}, {1.3f, -0.6f}, {2.0f, 1.6f},  {2.3f, 3.4f},
                                   {2.7f, 5.0f},  {3.4f, 6.6f},  {3.2f, 8.2f},  {2.3f, 8.9f},
                                   {0.9f, 8.9f},  {0.3f, 8.3f},  {-0.4f, 7.0f}, {-0.3f, 5.2f},
                                   {-0.9f, 3.6f}, {-2.2f, 2.0f}, {-3.6f, 0.0f}, {-4.5f, -2.5f}};
struct Rock {
  glm::vec2 at;
  float radius;
};
const std::vector<Rock> rocks{{{0.25f, 4.9f}, 0.32f}, {{1.45f, 2.7f}, 0.42f}, {{2.35f, 7.2f}, 0.36f}};

constexpr float cliff_y = 9.0f, cliff_m = 1.25f;
const glm::vec3 sun = glm::normalize(glm::vec3(-0.55f, -0.45f, 0.70f));

constexpr int columns = 1500, rows = 1700;
constexpr float cell = 0.03f;
constexpr glm::vec2 origin{-22.5f, -4.0f};

float smooth(float a, float b, float x) {
  const float t = std::clamp((x - a) / (b - a), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Metres from the banks: below 0 in the brook.
float outside(glm::vec2 p) {
  float nearest = 1e9f;
  bool in = false;
  for (std::size_t i = 0; i < banks.size(); ++i) {
    const glm::vec2 a = banks[i], b = banks[(i + 1) % banks.size()], d = b - a;
    nearest = std::min(nearest, glm::distance(p, a + d * std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0f, 1.0f)));
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + d.x * (p.y - a.y) / d.y) in = !in;
  }
  return in ? -nearest : nearest;
}

float land_height(glm::vec2 p) {
  const float off = outside(p);
  float h = 0.16f * smooth(0.0f, 0.35f, off) + 0.35f * smooth(0.5f, 4.0f, off);
  h += off > 0 ? 0.05f * smooth(0, 0.8f, off) * fractal_noise(p * 1.3f, 4, 11) : 0;
  h -= 0.28f * smooth(0.0f, 0.5f, -off) - 0.02f * fractal_noise(p * 7.0f, 3, 12) * smooth(0, 0.2f, -off);
  for (const Rock& r : rocks) {
    const float d = glm::distance(p, r.at) / r.radius;
    if (d < 1.5f)
      h = std::max(h, 0.8f * r.radius * (1 - d * d) + 0.05f * r.radius * fractal_noise(p * 9.0f, 3, 13) * (1.5f - d));
  }
  // The cliff, with a notch where the water comes over, and hills beyond.
  const float edge =
      cliff_y + 0.25f * fractal_noise(glm::vec2(p.x * 0.9f, 3), 4, 14) * smooth(0.6f, 1.6f, std::abs(p.x - 1.6f));
  const float up = smooth(edge, edge + 0.22f, p.y);
  float top = cliff_m + 0.25f + 0.15f * fractal_noise(p * 0.7f, 4, 15);
  top -= 0.35f * (1 - smooth(0.62f, 0.85f, std::abs(p.x - 1.6f)));
  top += 0.14f * std::max(0.0f, p.y - 13.0f) * (0.8f + 0.5f * fractal_noise(p * 0.12f, 3, 16));
  return h + up * (top - h);
}

}  // namespace

BrookLand::BrookLand() : heights_(static_cast<std::size_t>(columns) * rows) {
  parallel_for(rows, [&](int y) {
    for (int x = 0; x < columns; ++x) {
      heights_[static_cast<std::size_t>(y) * columns + x] = land_height(origin + glm::vec2(x, y) * cell);
    }
  });
  for (unsigned i = 0; i < 46; ++i) {
    const glm::vec2 p(-20 + 40 * uniform({i, 1}), 11.5f + 22 * uniform({i, 2}) * uniform({i, 3}));
    if (std::abs(p.x - 1.6f) < 1.5f && p.y < 15) continue;
    const float h = 2.2f + 3.2f * uniform({i, 4});
    trees_.push_back({{p.x, p.y, height(p) - 0.1f}, h, 0.26f * h, i});
  }
}

float BrookLand::height(glm::vec2 p) const {
  const glm::vec2 g = glm::clamp((p - origin) / cell, glm::vec2(0), glm::vec2(columns - 1.01f, rows - 1.01f));
  const int x = static_cast<int>(g.x), y = static_cast<int>(g.y);
  const float fx = g.x - static_cast<float>(x), fy = g.y - static_cast<float>(y);
  const float* h = heights_.data() + static_cast<std::size_t>(y) * columns + x;
  return (h[0] * (1 - fx) + h[1] * fx) * (1 - fy) + (h[columns] * (1 - fx) + h[columns + 1] * fx) * fy;
}

glm::vec3 BrookLand::normal(glm::vec2 p) const {
  constexpr float e = 0.03f;
  return glm::normalize(glm::vec3(height(p - glm::vec2(e, 0)) - height(p + glm::vec2(e, 0)),
                                  height(p - glm::vec2(0, e)) - height(p + glm::vec2(0, e)), 2 * e));
}

BrookLand::Hit BrookLand::first_hit(glm::vec3 eye, glm::vec3 direction, float most) const {
  Hit hit;
  const auto clearance = [&](float t) {
    const glm::vec3 p = eye + direction * t;
    return p.z - height(glm::vec2(p));
  };
  float t = 0.02f, before = 0;
  while (t < most) {
    const float above = clearance(t);
    if (above < 0.0005f * t) {
      hit.distance = t;
      break;
    }
    if (eye.z + direction.z * t > 12 && direction.z > 0) break;
    before = t;
    t += std::max(0.3f * above, 0.003f + 0.0006f * t);
  }
  // A step may end deep within a cliff: back to its face.
  if (t < most && clearance(t) < 0) {
    float inside = t;
    for (int i = 0; i < 16; ++i) {
      const float middle = (before + inside) / 2;
      (clearance(middle) < 0 ? inside : before) = middle;
    }
    hit.distance = before;
  }
  // Trees: cones with a ragged skin.
  for (const Tree& tree : trees_) {
    const glm::vec2 o = glm::vec2(eye) - glm::vec2(tree.foot), d(direction);
    const float along = -glm::dot(o, d) / std::max(glm::dot(d, d), 1e-9f);
    if (along < 0 || along > std::min(hit.distance, most) + tree.radius) continue;
    if (glm::length(o + d * along) > 1.4f * tree.radius) continue;
    for (float s = std::max(0.02f, along - 1.4f * tree.radius); s < along + 1.4f * tree.radius; s += 0.03f) {
      if (s > hit.distance) break;
      const glm::vec3 p = eye + direction * s - tree.foot;
      const float v = p.z / tree.height;
      if (v < 0.04f || v > 1) continue;
      const float angle = std::atan2(p.y, p.x);
      const float tier = v * 7 - std::floor(v * 7);
      const float skin = tree.radius * (1 - v) * (1.12f - 0.4f * tier) *
                         (1 + 0.35f * noise(glm::vec3(3 * std::cos(angle), 3 * std::sin(angle), p.z * 6), tree.seed));
      if (glm::length(glm::vec2(p)) < skin) {
        if (s < hit.distance) hit = {s, &tree};
        break;
      }
    }
  }
  return hit;
}

float BrookLand::lit(glm::vec3 point, glm::vec3 n) const {
  return first_hit(point + n * 0.05f, sun, 14).distance < 14 ? 0.0f : 1.0f;
}

glm::vec3 BrookLand::ground_colour(glm::vec3 p, glm::vec3 n) const {
  const float fine = fractal_noise(p * 14.0f, 4, 21), broad = fractal_noise(p * 1.1f, 3, 22);
  const glm::vec3 rock = glm::vec3(0.20f, 0.185f, 0.165f) * (1 + 0.5f * fine + 0.25f * broad);
  glm::vec3 grass = glm::mix(glm::vec3(0.075f, 0.135f, 0.028f), glm::vec3(0.15f, 0.17f, 0.045f), 0.5f + 0.5f * broad);
  grass *= 1 + 0.55f * fractal_noise(glm::vec3(p.x * 38, p.y * 22, p.z * 38), 3, 23);
  const glm::vec3 pebbles = glm::vec3(0.17f, 0.15f, 0.125f) * (1 + 0.7f * fractal_noise(p * 17.0f, 3, 24));
  float steep = smooth(0.25f, 0.5f, 1 - n.z);
  for (const Rock& r : rocks) {
    if (glm::distance(glm::vec2(p), r.at) < 1.3f * r.radius && p.z > -0.14f) steep = 1;
  }
  const float off = outside(glm::vec2(p));
  glm::vec3 c = glm::mix(grass, pebbles, 1 - smooth(-0.02f, 0.3f + 0.15f * fine, off));
  return glm::mix(c, rock, steep);
}

glm::vec3 BrookLand::light(glm::vec3 eye, glm::vec3 direction) const {
  const Hit hit = first_hit(eye, direction, 55);
  const float up = std::max(direction.z, 0.0f);
  const glm::vec3 haze(0.62f, 0.72f, 0.80f);
  if (hit.distance > 54) {
    glm::vec3 sky = glm::mix(haze, glm::vec3(0.20f, 0.40f, 0.74f), std::pow(up, 0.55f));
    const glm::vec2 at = glm::vec2(direction) / (up + 0.12f);
    const float cloud = smooth(0.02f, 0.5f, fractal_noise(at * 0.9f + glm::vec2(1.3f, 0), 5, 31));
    sky = glm::mix(sky, glm::vec3(0.95f, 0.94f, 0.92f), cloud * smooth(0.02f, 0.2f, up));
    return sky;
  }
  const glm::vec3 p = eye + direction * hit.distance;
  glm::vec3 n, colour;
  if (hit.tree != nullptr) {
    const glm::vec3 q = p - hit.tree->foot;
    n = glm::normalize(glm::vec3(glm::vec2(q) / std::max(glm::length(glm::vec2(q)), 1e-3f), 0.4f));
    const float leaf = fractal_noise(p * 9.0f, 3, 41);
    colour = glm::vec3(0.035f, 0.075f, 0.032f) * (1 + 0.7f * leaf) * (0.7f + 0.6f * uniform({hit.tree->seed, 9}));
  } else {
    n = normal(glm::vec2(p));
    colour = ground_colour(p, n);
  }
  const float direct = std::max(0.0f, glm::dot(n, sun)) * lit(p, n);
  const glm::vec3 shine =
      glm::vec3(2.3f, 2.1f, 1.75f) * direct + glm::vec3(0.42f, 0.52f, 0.66f) * (0.55f + 0.45f * n.z);
  const float far = 1 - std::exp(-hit.distance / 130);
  return glm::mix(colour * shine, haze * 0.8f, far);
}

std::string BrookLand::rocks_obj() const {
  std::ostringstream out;
  out << "# The rocks of the filmed brook: metres, z up\n" << std::fixed << std::setprecision(4);
  constexpr int around = 40, rings = 14;
  int first = 1;
  for (const Rock& rock : rocks) {
    const auto vertex = [&](glm::vec2 p) { out << "v " << p.x << ' ' << p.y << ' ' << height(p) << '\n'; };
    vertex(rock.at);
    for (int r = 1; r <= rings; ++r) {
      for (int a = 0; a < around; ++a) {
        const float angle = 6.2831853f * static_cast<float>(a) / around,
                    d = 1.4f * rock.radius * static_cast<float>(r) / rings;
        vertex(rock.at + d * glm::vec2(std::cos(angle), std::sin(angle)));
      }
    }
    const auto at = [&](int r, int a) { return r == 0 ? first : first + 1 + (r - 1) * around + a % around; };
    for (int r = 0; r < rings; ++r) {
      for (int a = 0; a < around; ++a) {
        out << "f " << at(r, a) << ' ' << at(r + 1, a) << ' ' << at(r + 1, a + 1) << '\n';
        if (r > 0) out << "f " << at(r, a) << ' ' << at(r + 1, a + 1) << ' ' << at(r, a + 1) << '\n';
      }
    }
    first += 1 + rings * around;
  }
  return out.str();
}

}  // namespace rinkaku::recordings

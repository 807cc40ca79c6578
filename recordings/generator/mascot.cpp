#include "recordings/generator/mascot.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace rinkaku::recordings {
namespace {

enum Colour { Coat, Stripe, Cream, Pink, Blush, Eye, Shine, Nose, Mouth, Collar, Bell, Iris };

const std::vector<Material> palette = {
    {"coat", {0.976f, 0.690f, 0.392f}},   {"stripe", {0.878f, 0.510f, 0.239f}}, {"cream", {1.000f, 0.957f, 0.875f}},
    {"pink", {0.984f, 0.694f, 0.671f}},   {"blush", {0.992f, 0.573f, 0.494f}},  {"eye", {0.180f, 0.118f, 0.137f}},
    {"shine", {1.000f, 1.000f, 1.000f}},  {"nose", {0.902f, 0.431f, 0.451f}},   {"mouth", {0.376f, 0.188f, 0.176f}},
    {"collar", {0.239f, 0.557f, 0.639f}}, {"bell", {0.992f, 0.827f, 0.275f}},   {"iris", {0.451f, 0.275f, 0.176f}}};

glm::vec3 mirrored(glm::vec3 p) { return {std::abs(p.x), p.y, p.z}; }

float head(glm::vec3 p) {
  const glm::vec3 m = mirrored(p);
  float d = ellipsoid(p, {0, 0.635f, 0.02f}, {0.335f, 0.265f, 0.270f});
  d = smooth_union(d, ellipsoid(m, {0.165f, 0.565f, 0.065f}, {0.165f, 0.130f, 0.170f}), 0.10f);
  // Cheek fluff: three tufts a side.
  d = smooth_union(d, rounded_cone(m, {0.25f, 0.600f, 0.03f}, {0.386f, 0.606f, 0.01f}, 0.085f, 0.019f), 0.030f);
  d = smooth_union(d, rounded_cone(m, {0.24f, 0.550f, 0.04f}, {0.392f, 0.520f, 0.02f}, 0.085f, 0.019f), 0.030f);
  d = smooth_union(d, rounded_cone(m, {0.20f, 0.500f, 0.04f}, {0.325f, 0.448f, 0.04f}, 0.080f, 0.019f), 0.030f);
  // A tuft on the crown.
  d = smooth_union(d, rounded_cone(p, {0.00f, 0.860f, 0.04f}, {0.030f, 0.955f, 0.07f}, 0.055f, 0.019f), 0.030f);
  d = smooth_union(d, rounded_cone(p, {-0.04f, 0.860f, 0.04f}, {-0.055f, 0.925f, 0.07f}, 0.050f, 0.019f), 0.025f);
  return d;
}

glm::vec3 ear_space(glm::vec3 p) {
  const glm::vec3 m = mirrored(p);
  return {m.x, m.y, (m.z - 0.01f) * 1.75f};  // flat from front to back
}

float ears(glm::vec3 p) {
  const glm::vec3 q = ear_space(p);
  const float outer = rounded_cone(q, {0.190f, 0.770f, 0}, {0.276f, 0.968f, -0.02f}, 0.135f, 0.038f) / 1.3f;
  const float hollow = rounded_cone(q, {0.195f, 0.800f, 0.20f}, {0.260f, 0.905f, 0.14f}, 0.100f, 0.020f) / 1.3f;
  return -smooth_union(-outer, hollow, 0.03f);
}

float tail(glm::vec3 p) {
  constexpr int links = 14;
  const glm::vec3 a(0.04f, 0.10f, -0.17f), b(0.40f, 0.00f, -0.34f), c(0.62f, 0.30f, -0.22f), e(0.40f, 0.53f, -0.13f);
  const auto along = [&](float t) {
    const float s = 1 - t;
    return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * e;
  };
  const auto thick = [](float t) { return 0.052f + 0.028f * std::sin(3.0f * t) * t; };
  float d = 1e9f;
  for (int i = 0; i < links; ++i) {
    const float t0 = static_cast<float>(i) / links, t1 = static_cast<float>(i + 1) / links;
    d = std::min(d, rounded_cone(p, along(t0), along(t1), thick(t0), thick(t1)));
  }
  return d;
}

float body(glm::vec3 p) {
  const glm::vec3 m = mirrored(p);
  float d = ellipsoid(p, {0, 0.255f, -0.01f}, {0.255f, 0.270f, 0.225f});
  d = smooth_union(d, ellipsoid(m, {0.165f, 0.120f, 0.02f}, {0.120f, 0.120f, 0.150f}), 0.06f);  // haunches
  d = smooth_union(d, tail(p), 0.05f);
  d = smooth_union(d, head(p), 0.05f);
  d = smooth_union(d, ears(p), 0.035f);
  // Feet, with toes.
  float feet = ellipsoid(m, {0.135f, 0.048f, 0.170f}, {0.083f, 0.060f, 0.105f});
  for (const float toe : {-0.042f, 0.0f, 0.042f}) {
    const float forward = 0.245f - std::abs(toe) * 0.35f;
    feet = smooth_union(feet, ellipsoid(m, {0.135f + toe, 0.040f, forward}, {0.028f, 0.036f, 0.036f}), 0.016f);
  }
  d = smooth_union(d, feet, 0.03f);
  // One paw rests on the belly, the other waves.
  float rest = rounded_cone(p, {0.205f, 0.335f, 0.08f}, {0.120f, 0.225f, 0.215f}, 0.058f, 0.060f);
  d = smooth_union(d, rest, 0.022f);
  float wave = rounded_cone(p, {-0.195f, 0.310f, 0.07f}, {-0.370f, 0.330f, 0.150f}, 0.058f, 0.056f);
  wave =
      smooth_union(wave, rounded_cone(p, {-0.370f, 0.330f, 0.150f}, {-0.425f, 0.455f, 0.190f}, 0.056f, 0.068f), 0.03f);
  d = smooth_union(d, wave, 0.022f);
  // Flat soles.
  return -smooth_union(-d, p.y, 0.02f);
}

// Distance-like function of an ellipse in the front view, for painting; only what faces forward counts.
float front_ellipse(glm::vec3 p, glm::vec2 centre, glm::vec2 radii, float least_z = 0) {
  const glm::vec2 q = (glm::vec2(p) - centre) / radii;
  return std::max((glm::length(q) - 1) * std::min(radii.x, radii.y), least_z - p.z);
}

void paint_coat(ColouredMesh& mesh) {
  const auto mark = [&](Colour colour, const Implicit& region, const std::vector<int>& from = {Coat}) {
    paint(mesh, region, colour, from);
  };
  // Belly and bib, muzzle and the underside of the cheeks.
  mark(Cream, [](glm::vec3 p) {
    return std::min(front_ellipse(p, {0, 0.235f}, {0.165f, 0.185f}, 0.05f),
                    front_ellipse(p, {0, 0.400f}, {0.120f, 0.060f}, 0.05f));
  });
  mark(Cream, [](glm::vec3 p) {
    const glm::vec3 m = mirrored(p);
    const float muzzle = std::min(front_ellipse(m, {0.062f, 0.525f}, {0.100f, 0.072f}, 0.1f),
                                  front_ellipse(p, {0, 0.585f}, {0.034f, 0.080f}, 0.1f));
    return std::max(muzzle, 0.40f - p.y);
  });
  // Socks on the feet and both paws, the tail's tip, the fluff's tips.
  mark(Cream, [](glm::vec3 p) {
    const glm::vec3 m = mirrored(p);
    const float foot = ellipsoid(m, {0.135f, 0.030f, 0.215f}, {0.110f, 0.085f, 0.085f});
    const float rest = glm::distance(p, {0.108f, 0.208f, 0.235f}) - 0.072f;
    const float wave =
        std::max(0.408f - p.y + 0.35f * (p.x + 0.425f), glm::distance(p, {-0.425f, 0.46f, 0.19f}) - 0.1f);
    return std::min({foot, rest, wave, glm::distance(p, {0.415f, 0.555f, -0.13f}) - 0.115f});
  });
  // Inside the ears.
  mark(Pink, [](glm::vec3 p) {
    const glm::vec3 m = mirrored(p);
    const float flat = rounded_cone({m.x, m.y, 0}, {0.200f, 0.800f, 0}, {0.270f, 0.935f, 0}, 0.066f, 0.012f);
    return std::max({flat, 0.012f - p.z, 0.822f - m.y + 0.1f * m.x});
  });
  // Tabby: three marks on the brow, two on either cheek, bands on the tail and the back.
  mark(Stripe, [](glm::vec3 p) {
    const glm::vec3 m = mirrored(p);
    const auto leaf = [](glm::vec2 q, glm::vec2 a, glm::vec2 b, float width) {
      const glm::vec2 axis = b - a;
      const float t = glm::clamp(glm::dot(q - a, axis) / glm::dot(axis, axis), 0.0f, 1.0f);
      return glm::length(q - a - t * axis) - width * (1.0f - 0.85f * t);
    };
    const glm::vec2 q(m.x, m.y);
    const float brow =
        std::min(leaf(q, {0, 0.90f}, {0, 0.765f}, 0.026f), leaf(q, {0.085f, 0.885f}, {0.060f, 0.790f}, 0.022f));
    const float cheek = std::min(leaf(q, {0.40f, 0.635f}, {0.265f, 0.622f}, 0.020f),
                                 leaf(q, {0.40f, 0.575f}, {0.272f, 0.578f}, 0.018f));
    return std::min(std::max(brow, 0.02f - p.z), std::max(cheek, -p.z));
  });
  mark(Stripe, [](glm::vec3 p) {
    float nearest = 1;
    for (const float y : {0.20f, 0.30f, 0.60f, 0.70f, 0.80f}) nearest = std::min(nearest, std::abs(p.y - y));
    const float half_width = 0.030f * (1 - p.x * p.x / (0.19f * 0.19f));
    return std::max(nearest - half_width, p.z + 0.05f);
  });
  mark(Stripe, [](glm::vec3 p) {
    const float turn = glm::length(glm::vec2(p.x - 0.28f, p.y - 0.33f));
    const float angle = std::atan2(p.y - 0.33f, p.x - 0.28f);
    const float band = std::min({std::abs(angle + 1.15f), std::abs(angle + 0.45f), std::abs(angle - 0.25f)}) - 0.12f;
    return std::max({band * turn, 0.30f - p.x, p.z - 0.05f});
  });
  mark(Blush,
       [](glm::vec3 p) {
         return front_ellipse(mirrored(p), {0.226f, 0.545f}, {0.046f, 0.029f}, 0.05f);
       },
       {Coat, Cream});
}

// The point of the head's front at (x, y).
glm::vec3 on_face(float x, float y) {
  float z = 0.5f;
  for (int i = 0; i < 200; ++i) z -= 0.7f * body({x, y, z});
  return {x, y, z};
}

// An ellipsoid on the face, its short axis along the face's normal, `out` of its thickness before the face.
ColouredMesh button(glm::vec2 place, glm::vec3 radii, float out, Colour colour, float cell, float lean = 1) {
  const glm::vec3 at = on_face(place.x, place.y);
  const glm::vec3 normal = glm::normalize(glm::mix(glm::vec3(0, 0, 1), surface_normal(body, at, 0.02f), lean));
  const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), normal));
  const glm::mat3 world(right, glm::cross(normal, right), normal);
  const glm::vec3 centre = at + normal * (out - radii.z);
  const glm::vec3 reach(std::max({radii.x, radii.y, radii.z}) + 2 * cell);
  const Implicit f = [=](glm::vec3 p) { return ellipsoid(glm::transpose(world) * (p - centre), glm::vec3(0), radii); };
  return mesh_surface(f, centre - reach, centre + reach, cell, colour);
}

// A line drawn into the face: low, but rooted deep, so that an outline pass does not thicken it.
ColouredMesh mouth() {
  constexpr int links = 8;
  std::vector<glm::vec3> line;  // half an omega
  for (int i = 0; i <= links; ++i) {
    const float a = 3.14159f * static_cast<float>(i) / links;
    line.push_back(on_face(0.036f - 0.036f * std::cos(a), 0.527f - 0.030f * std::sin(a)));
  }
  const Implicit f = [&](glm::vec3 p) {
    const glm::vec2 q(std::abs(p.x), p.y);
    float away = 1e9f, face = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const glm::vec2 a(line[i - 1]), axis = glm::vec2(line[i]) - a;
      const float t = glm::clamp(glm::dot(q - a, axis) / glm::dot(axis, axis), 0.0f, 1.0f);
      const float d = glm::length(q - a - t * axis);
      if (d >= away) continue;
      away = d;
      face = glm::mix(line[i - 1].z, line[i].z, t);
    }
    return -smooth_union(0.0082f - away, 0.018f - std::abs(p.z - face + 0.0145f), 0.004f);
  };
  return mesh_surface(f, {-0.10f, 0.47f, 0.15f}, {0.10f, 0.55f, 0.36f}, 0.0062f, Mouth);
}

}  // namespace

Mascot make_mascot() {
  Mascot mascot{mesh_surface(body, {-0.54f, -0.04f, -0.44f}, {0.66f, 1.06f, 0.36f}, 0.0215f, Coat), palette};
  ColouredMesh& mesh = mascot.mesh;
  paint_coat(mesh);

  for (const float side : {-1.0f, 1.0f}) {
    ColouredMesh eye = button({side * 0.130f, 0.632f}, {0.068f, 0.090f, 0.055f}, 0.013f, Eye, 0.0155f, 0.7f);
    const glm::vec2 low(side * 0.130f, 0.590f);
    paint(
        eye, [low](glm::vec3 p) { return (glm::length((glm::vec2(p) - low) / glm::vec2(0.034f, 0.026f)) - 1) * 0.03f; },
        Iris);
    append(mesh, eye);
    append(mesh, button({side * 0.130f - 0.016f, 0.658f}, {0.018f, 0.020f, 0.012f}, 0.0165f, Shine, 0.0068f, 0.7f));
    append(mesh, button({side * 0.130f + 0.018f, 0.613f}, {0.008f, 0.009f, 0.010f}, 0.0155f, Shine, 0.0052f, 0.7f));
  }
  append(mesh, button({0, 0.548f}, {0.025f, 0.017f, 0.016f}, 0.014f, Nose, 0.0065f, 0.4f));
  append(mesh, mouth());

  const Implicit collar = [](glm::vec3 p) {
    const glm::vec3 q((p.x) / 1.04f, p.y - 0.405f + 0.12f * (p.z - 0.02f), (p.z - 0.015f) / 0.96f);
    const glm::vec2 ring(glm::length(glm::vec2(q.x, q.z)) - 0.240f, q.y);
    return glm::length(ring) - 0.026f;
  };
  append(mesh, mesh_surface(collar, {-0.30f, 0.30f, -0.30f}, {0.30f, 0.50f, 0.34f}, 0.0185f, Collar));
  const glm::vec3 bell_at(0, 0.348f, 0.280f);
  const Implicit bell = [bell_at](glm::vec3 p) { return glm::distance(p, bell_at) - 0.042f; };
  ColouredMesh bell_mesh = mesh_surface(bell, bell_at - 0.06f, bell_at + 0.06f, 0.0105f, Bell);
  paint(
      bell_mesh,
      [bell_at](glm::vec3 p) {
        const glm::vec3 q = p - bell_at;
        const float slit = std::max(std::abs(q.x) - 0.0045f, q.y + 0.010f);
        const float hole = glm::length(glm::vec2(q.x, q.y + 0.012f)) - 0.010f;
        return std::max(std::min(slit, hole), -q.z);
      },
      Mouth);
  append(mesh, bell_mesh);
  return mascot;
}

}  // namespace rinkaku::recordings

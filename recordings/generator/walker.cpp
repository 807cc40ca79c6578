#include "recordings/generator/walker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "recordings/generator/noise.h"
#include "recordings/generator/parallel.h"

namespace rinkaku::recordings {
namespace {

enum Bone {
  Pelvis,
  Chest,
  Neck,
  Head,
  Rucksack,
  RightThigh,
  RightShin,
  RightFoot,
  LeftThigh,
  LeftShin,
  LeftFoot,
  RightUpperArm,
  RightForearm,
  RightHand,
  LeftUpperArm,
  LeftForearm,
  LeftHand
};

const glm::vec3 hip(0, 0.092f, 0.935f), knee(0.012f, 0.096f, 0.495f), ankle(-0.012f, 0.100f, 0.085f);
const glm::vec3 toe(0.150f, 0.112f, 0.032f), shoulder(-0.005f, 0.172f, 1.405f), elbow(-0.025f, 0.262f, 1.135f);
const glm::vec3 wrist(0.010f, 0.330f, 0.905f), fingers(0.022f, 0.352f, 0.815f);

glm::vec3 on_side(glm::vec3 p, bool left) { return {p.x, left ? p.y : -p.y, p.z}; }

std::array<Limb, Walker::bones> rest_limbs() {
  std::array<Limb, Walker::bones> limbs;
  limbs[Pelvis] = {{0, 0, 0.93f}, {0, 0, 1.04f}, 0.135f, 0.125f};
  limbs[Chest] = {{0, 0, 1.12f}, {-0.01f, 0, 1.34f}, 0.125f, 0.130f};
  limbs[Neck] = {{-0.012f, 0, 1.42f}, {0.008f, 0, 1.52f}, 0.055f, 0.050f};
  limbs[Head] = {{0.015f, 0, 1.575f}, {0.015f, 0, 1.63f}, 0.088f, 0.090f};
  limbs[Rucksack] = {{-0.185f, 0, 1.07f}, {-0.180f, 0, 1.31f}, 0.095f, 0.090f};
  for (const bool left : {false, true}) {
    const std::size_t leg = left ? LeftThigh : RightThigh, arm = left ? LeftUpperArm : RightUpperArm;
    const auto s = [left](glm::vec3 p) { return on_side(p, left); };
    limbs[leg] = {s(hip), s(knee), 0.092f, 0.064f};
    limbs[leg + 1] = {s(knee), s(ankle), 0.064f, 0.050f};
    limbs[leg + 2] = {s(ankle) - glm::vec3(0.02f, 0, 0.045f), s(toe), 0.042f, 0.034f};
    limbs[arm] = {s(shoulder), s(elbow), 0.060f, 0.049f};
    limbs[arm + 1] = {s(elbow), s(wrist), 0.049f, 0.037f};
    limbs[arm + 2] = {s(wrist), s(fingers), 0.032f, 0.022f};
  }
  return limbs;
}

float cone(glm::vec3 p, const Limb& limb) {
  return rounded_cone(p, limb.from, limb.to, limb.radius_from, limb.radius_to);
}

float hair(glm::vec3 p) {
  const float cap = ellipsoid(p, {0.002f, 0, 1.618f}, {0.106f, 0.088f, 0.110f});
  const float face = ellipsoid(p, {0.105f, 0, 1.560f}, {0.085f, 0.085f, 0.085f});
  float d = -smooth_union(-cap, face, 0.015f);
  d = std::max(d, 1.545f + 0.55f * p.x - p.z);
  const float tail = smooth_union(rounded_cone(p, {-0.095f, 0, 1.640f}, {-0.150f, 0, 1.600f}, 0.024f, 0.034f),
                                  rounded_cone(p, {-0.150f, 0, 1.600f}, {-0.165f, 0, 1.490f}, 0.034f, 0.010f), 0.02f);
  return smooth_union(d, tail, 0.012f);
}

float figure(glm::vec3 p) {
  static const std::array<Limb, Walker::bones> limbs = rest_limbs();
  const glm::vec3 m(p.x, std::abs(p.y), p.z);
  float trunk = ellipsoid(p, {-0.005f, 0, 0.950f}, {0.118f, 0.160f, 0.125f});
  trunk = smooth_union(trunk, ellipsoid(p, {-0.005f, 0, 1.270f}, {0.112f, 0.165f, 0.185f}), 0.10f);
  // The shirt hangs over the belt.
  trunk = smooth_union(trunk, ellipsoid(p, {0, 0, 1.000f}, {0.128f, 0.166f, 0.110f}), 0.03f);
  trunk = smooth_union(trunk, rounded_cone(m, {-0.01f, 0.05f, 1.43f}, shoulder, 0.060f, 0.062f), 0.06f);
  float d = smooth_union(trunk, cone(p, limbs[Neck]), 0.03f);
  float skull = ellipsoid(p, {0.005f, 0, 1.615f}, {0.100f, 0.078f, 0.100f});
  skull = smooth_union(skull, ellipsoid(p, {0.035f, 0, 1.555f}, {0.060f, 0.056f, 0.072f}), 0.05f);
  skull = smooth_union(skull, rounded_cone(p, {0.098f, 0, 1.600f}, {0.110f, 0, 1.578f}, 0.010f, 0.0115f), 0.015f);
  skull = smooth_union(skull, ellipsoid(m, {0.000f, 0.080f, 1.592f}, {0.018f, 0.010f, 0.028f}), 0.008f);
  d = smooth_union(d, skull, 0.015f);
  d = smooth_union(d, hair(p), 0.006f);
  const std::size_t leg = p.y > 0 ? LeftThigh : RightThigh, arm = p.y > 0 ? LeftUpperArm : RightUpperArm;
  float legs = smooth_union(cone(p, limbs[leg]), cone(p, limbs[leg + 1]), 0.03f);
  legs = smooth_union(legs, ellipsoid(m, {-0.022f, 0.098f, 0.370f}, {0.052f, 0.054f, 0.120f}), 0.04f);
  // Trouser legs end in a hem over the shoes.
  legs = smooth_union(legs, rounded_cone(m, {0, 0.099f, 0.20f}, {-0.008f, 0.100f, 0.115f}, 0.056f, 0.060f), 0.015f);
  d = smooth_union(d, legs, 0.030f);
  float shoe = ellipsoid(m, {-0.005f, 0.101f, 0.062f}, {0.078f, 0.044f, 0.052f});
  shoe = smooth_union(shoe, ellipsoid(m, {0.095f, 0.110f, 0.042f}, {0.092f, 0.047f, 0.040f}), 0.035f);
  shoe = smooth_union(shoe, std::max(ellipsoid(m, {0.050f, 0.106f, 0.015f}, {0.145f, 0.052f, 0.040f}), m.z - 0.026f),
                      0.004f);
  d = smooth_union(d, -smooth_union(-shoe, m.z - 0.001f, 0.006f), 0.010f);
  float arms = smooth_union(cone(p, limbs[arm]), cone(p, limbs[arm + 1]), 0.02f);
  arms = smooth_union(arms, rounded_cone(m, wrist + glm::vec3(0, 0, 0.05f), wrist, 0.044f, 0.042f), 0.01f);
  d = smooth_union(d, arms, 0.035f);
  float hand = ellipsoid(m, 0.5f * (wrist + fingers) + glm::vec3(0.004f, 0.002f, -0.012f), {0.036f, 0.019f, 0.060f});
  hand = smooth_union(hand,
                      rounded_cone(m, wrist + glm::vec3(0.02f, 0, -0.02f), fingers + glm::vec3(0.042f, -0.006f, 0.035f),
                                   0.014f, 0.010f),
                      0.01f);
  d = smooth_union(d, hand, 0.012f);
  // Rucksack with a front pocket and straps.
  const glm::vec3 b = glm::abs(p - glm::vec3(-0.190f, 0, 1.205f)) - glm::vec3(0.035f, 0.085f, 0.140f);
  float bag = glm::length(glm::max(b, 0.0f)) + std::min(std::max({b.x, b.y, b.z}), 0.0f) - 0.045f;
  const glm::vec3 q = glm::abs(p - glm::vec3(-0.262f, 0, 1.130f)) - glm::vec3(0.010f, 0.060f, 0.055f);
  bag = smooth_union(bag, glm::length(glm::max(q, 0.0f)) + std::min(std::max({q.x, q.y, q.z}), 0.0f) - 0.025f, 0.012f);
  d = smooth_union(d, bag, 0.012f);
  float strap = rounded_cone(m, {-0.14f, 0.085f, 1.375f}, {0.02f, 0.095f, 1.480f}, 0.020f, 0.020f);
  strap = std::min(strap, rounded_cone(m, {0.02f, 0.095f, 1.480f}, {0.100f, 0.105f, 1.33f}, 0.020f, 0.020f));
  strap = std::min(strap, rounded_cone(m, {0.100f, 0.105f, 1.33f}, {0.02f, 0.165f, 1.13f}, 0.020f, 0.016f));
  d = smooth_union(d, strap, 0.006f);
  // Folds.
  const bool cloth = p.z > 0.10f && p.z < 1.45f && m.y < 0.30f;
  return cloth ? d + 0.0042f * fractal_noise(p * glm::vec3(9, 9, 14), 2, 5) : d;
}

void dress(ColouredMesh& mesh) {
  const auto side = [](glm::vec3 p) { return glm::vec3(p.x, std::abs(p.y), p.z); };
  paint(
      mesh, [](glm::vec3 p) { return 0.945f + 0.012f * std::sin(12 * p.x + 4 * p.y) - p.z; }, Walker::Shirt);
  paint(
      mesh,
      [&](glm::vec3 p) {  // the hands lie below the shirt's hem, beside the legs
        const glm::vec3 m = side(p);
        return std::max(m.z - 0.98f, 0.255f - m.y);
      },
      Walker::Shirt);
  paint(
      mesh,
      [&](glm::vec3 p) {
        const glm::vec3 m = side(p);
        const float hand = glm::dot(m - wrist, glm::normalize(wrist - fingers)) + 0.004f;
        return std::max(hand, 0.22f - m.y);
      },
      Walker::Skin);
  paint(
      mesh, [](glm::vec3 p) { return 1.462f + 0.25f * p.x - p.z; }, Walker::Skin);
  paint(mesh, [](glm::vec3 p) { return hair(p) - 0.004f; }, Walker::Hair, {Walker::Skin});
  paint(mesh,
        [&](glm::vec3 p) {
          const glm::vec3 m = side(p);
          const float eye =
              glm::length((glm::vec2(m.x, m.z) - glm::vec2(0.088f, 1.603f)) / glm::vec2(0.012f, 0.009f)) - 1;
          const float brow =
              glm::length((glm::vec2(m.x, m.z) - glm::vec2(0.090f, 1.626f)) / glm::vec2(0.017f, 0.0045f)) - 1;
          return std::max(0.01f * std::min(eye, brow), 0.02f - m.y);
        },
        Walker::Eye, {Walker::Skin});
  paint(mesh, [](glm::vec3 p) { return p.z - 0.098f - 0.08f * (p.x + 0.03f); }, Walker::Shoes, {Walker::Jeans});
  paint(mesh, [](glm::vec3 p) { return p.z - 0.026f; }, Walker::Sole, {Walker::Shoes});
  paint(mesh,
        [](glm::vec3 p) {
          return std::max(
              {p.x + 0.128f + 0.10f * std::max(0.0f, p.z - 1.36f), p.z - 1.42f, 0.98f - p.z, std::abs(p.y) - 0.16f});
        },
        Walker::Bag, {Walker::Shirt});
  paint(mesh,
        [&](glm::vec3 p) {
          const glm::vec3 m = side(p);
          float strap = rounded_cone(m, {-0.14f, 0.085f, 1.375f}, {0.02f, 0.095f, 1.480f}, 0.023f, 0.023f);
          strap = std::min(strap, rounded_cone(m, {0.02f, 0.095f, 1.480f}, {0.100f, 0.105f, 1.33f}, 0.023f, 0.023f));
          return std::min(strap, rounded_cone(m, {0.100f, 0.105f, 1.33f}, {0.02f, 0.165f, 1.13f}, 0.023f, 0.019f));
        },
        Walker::Bag, {Walker::Shirt, Walker::Skin});
}

glm::mat4 about(glm::vec3 pivot, float angle, glm::vec3 axis) {
  return glm::translate(glm::mat4(1), pivot) * glm::rotate(glm::mat4(1), angle, axis) *
         glm::translate(glm::mat4(1), -pivot);
}

// Where the ankle is relative to the hips' middle along x and above its rest height, and the foot's pitch (toes down
// positive), at `phase` of the stride (0: the heel strikes; 0.6: the toes leave).
struct Step {
  float x, lift, pitch;
};
Step step_at(float phase) {
  constexpr float stance = 0.6f, stride = 1.05f, strike = 0.295f;
  const auto smooth = [](float a, float b, float t) { return glm::smoothstep(a, b, t); };
  if (phase < stance) {
    const float heel = smooth(0.36f, stance, phase);  // the heel leaves the ground, the ball stays
    const float pitch = 0.75f * heel - 0.32f * (1 - smooth(0.0f, 0.09f, phase));
    return {strike - stride * phase + 0.145f * (1 - std::cos(0.75f * heel)) + 0.03f * heel,
            0.125f * std::sin(0.75f * heel) + 0.01f * (1 - smooth(0.0f, 0.09f, phase)), pitch};
  }
  const float t = (phase - stance) / (1 - stance);
  const Step off = {strike - stride * stance + 0.145f * (1 - std::cos(0.75f)) + 0.03f, 0.125f * std::sin(0.75f), 0.75f};
  // Leaves and lands with the ground's own speed.
  const float speed = -stride * (1 - stance), t2 = t * t, t3 = t2 * t;
  const float x = (2 * t3 - 3 * t2 + 1) * off.x + (t3 - 2 * t2 + t) * (speed + 0.45f) + (3 * t2 - 2 * t3) * strike +
                  (t3 - t2) * speed;
  const float lift = off.lift * (1 - smooth(0.0f, 0.85f, t)) + 0.055f * std::sin(3.14159f * t) + 0.01f * t;
  return {x, lift, off.pitch * (1 - smooth(0.0f, 0.6f, t)) - 0.32f * smooth(0.5f, 1.0f, t)};
}

}  // namespace

Walker::Walker() {
  mesh_ = mesh_surface(figure, {-0.36f, -0.43f, -0.03f}, {0.22f, 0.43f, 1.78f}, 0.0155f, Jeans);
  dress(mesh_);
  const auto limbs = rest_limbs();
  influences_.resize(mesh_.positions.size());
  parallel_for(static_cast<int>(mesh_.positions.size()), [&](int v) {
    const glm::vec3 p = mesh_.positions[static_cast<std::size_t>(v)];
    std::vector<std::pair<float, int>> by_weight;
    for (int b = 0; b < bones; ++b) {
      const bool is_left = b >= LeftUpperArm || (b >= LeftThigh && b <= LeftFoot);
      const bool is_right = (b >= RightThigh && b <= RightFoot) || (b >= RightUpperArm && b <= RightHand);
      if ((is_left && p.y < -0.004f) || (is_right && p.y > 0.004f)) continue;
      if (b >= RightUpperArm && std::abs(p.y) < 0.11f) continue;
      by_weight.emplace_back(std::exp(-cone(p, limbs[static_cast<std::size_t>(b)]) / 0.022f), b);
    }
    std::sort(by_weight.rbegin(), by_weight.rend());
    float total = 0;
    for (std::size_t i = 0; i < 4; ++i) total += by_weight[i].first;
    for (std::size_t i = 0; i < 4; ++i) {
      influences_[static_cast<std::size_t>(v)].bone[i] = by_weight[i].second;
      influences_[static_cast<std::size_t>(v)].weight[i] = by_weight[i].first / total;
    }
  });
}

Walker::Moment Walker::at(double time_s) const {
  constexpr double stride_s = 1.0;
  const double cycles = time_s / stride_s;
  const float phase = static_cast<float>(cycles - std::floor(cycles));
  const float turn = 6.2831853f * phase;
  const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

  Moment moment;
  auto& moved = moment.moved_from_rest;
  // Lowest while both feet are down, swaying over the standing foot.
  const glm::vec3 hips(static_cast<float>(time_s * speed_m_s) + 0.008f * std::sin(2 * turn),
                       -0.018f * std::sin(turn - 0.2f), -0.025f - 0.020f * std::cos(2 * turn - 0.5f));
  const glm::mat4 root = glm::translate(glm::mat4(1), hips);
  moved[Pelvis] =
      root * about({0, 0, 0.95f}, 0.10f * std::cos(turn), z) * about({0, 0, 0.95f}, 0.04f * std::sin(turn), x);
  moved[Chest] = root * about({0, 0, 1.02f}, -0.11f * std::cos(turn), z) * about({0, 0, 1.0f}, 0.045f, y);
  moved[Rucksack] = moved[Chest] * about({-0.1f, 0, 1.40f}, 0.02f * std::sin(2 * turn - 0.8f), y);
  moved[Neck] = moved[Chest] * about({0, 0, 1.45f}, 0.06f * std::cos(turn), z);
  moved[Head] = moved[Neck] * about({0, 0, 1.50f}, -0.02f + 0.015f * std::sin(2 * turn), y);

  for (const bool left : {false, true}) {
    const std::size_t leg = left ? LeftThigh : RightThigh, arm = left ? LeftUpperArm : RightUpperArm;
    const float own = left ? phase : phase + 0.5f - std::floor(phase + 0.5f);
    const Step step = step_at(own);
    // The leg bends in its own upright plane so that the ankle comes where the step wants it.
    const glm::vec3 at_hip = glm::vec3(moved[Pelvis] * glm::vec4(on_side(hip, left), 1));
    const glm::vec3 at_ankle(hips.x - 0.008f * std::sin(2 * turn) + step.x, at_hip.y, ankle.z + step.lift);
    const float thigh = glm::length(glm::vec2(knee.x - hip.x, knee.z - hip.z));
    const float shin = glm::length(glm::vec2(ankle.x - knee.x, ankle.z - knee.z));
    const glm::vec2 to(at_ankle.x - at_hip.x, at_ankle.z - at_hip.z);
    const float reach = std::min(glm::length(to), 0.999f * (thigh + shin));
    const float at_knee =
        std::acos(glm::clamp((thigh * thigh + shin * shin - reach * reach) / (2 * thigh * shin), -1.0f, 1.0f));
    const float at_top =
        std::acos(glm::clamp((thigh * thigh + reach * reach - shin * shin) / (2 * thigh * reach), -1.0f, 1.0f));
    // Angles forward from straight down; the rest's own are taken off.
    const float swing = std::atan2(to.x, -to.y) + at_top - std::atan2(knee.x - hip.x, hip.z - knee.z);
    const float rest_bend = std::atan2(knee.x - hip.x, hip.z - knee.z) - std::atan2(ankle.x - knee.x, knee.z - ankle.z);
    const float bend = (3.14159265f - at_knee) - rest_bend;
    const glm::mat4 placed = glm::translate(glm::mat4(1), at_hip - on_side(hip, left));
    moved[leg] = placed * about(on_side(hip, left), -swing, y);
    moved[leg + 1] = moved[leg] * about(on_side(knee, left), bend, y);
    const glm::vec3 foot_at = glm::vec3(moved[leg + 1] * glm::vec4(on_side(ankle, left), 1));
    moved[leg + 2] =
        glm::translate(glm::mat4(1), foot_at - on_side(ankle, left)) * about(on_side(ankle, left), step.pitch, y);

    // Arms swing against the legs and hang closer than at rest.
    const float arm_swing = -0.38f * std::cos(6.2831853f * own - 0.25f) + 0.02f, out = left ? -0.20f : 0.20f;
    moved[arm] = moved[Chest] * about(on_side(shoulder, left), -arm_swing, y) * about(on_side(shoulder, left), out, x);
    const float elbow_bend = 0.30f + 0.22f * std::max(-0.6f, arm_swing / 0.38f);
    moved[arm + 1] =
        moved[arm] * about(on_side(elbow, left), -elbow_bend, y) * about(on_side(elbow, left), 0.3f * out, x);
    moved[arm + 2] = moved[arm + 1] * about(on_side(wrist, left), -0.12f, y);
  }

  const auto rest = rest_limbs();
  for (std::size_t b = 0; b < rest.size(); ++b) {
    moment.limbs[b] = rest[b];
    moment.limbs[b].from = glm::vec3(moved[b] * glm::vec4(rest[b].from, 1));
    moment.limbs[b].to = glm::vec3(moved[b] * glm::vec4(rest[b].to, 1));
  }
  moment.positions.resize(mesh_.positions.size());
  moment.normals.resize(mesh_.positions.size());
  for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
    glm::mat4 m(0);
    for (std::size_t i = 0; i < 4; ++i) {
      m += influences_[v].weight[i] * moved[static_cast<std::size_t>(influences_[v].bone[i])];
    }
    moment.positions[v] = glm::vec3(m * glm::vec4(mesh_.positions[v], 1));
    moment.normals[v] = glm::normalize(glm::mat3(m) * mesh_.normals[v]);
  }
  return moment;
}

bool meets(const Limb& limb, glm::vec3 origin, glm::vec3 direction, float distance, float slim) {
  // The nearest points of ray and axis decide: exact enough for shadows.
  const glm::vec3 axis = limb.to - limb.from, w = origin - limb.from;
  const float a = glm::dot(axis, axis), b = glm::dot(axis, direction), c = glm::dot(axis, w),
              d = glm::dot(direction, w);
  const float denominator = a - b * b;
  float s = denominator > 1e-9f ? glm::clamp((c - b * d) / denominator, 0.0f, 1.0f) : 0.0f;
  const float t = s * b - d;
  if (t < 0 || t > distance) return false;
  const glm::vec3 apart = w + t * direction - s * axis;
  const float radius = slim * (limb.radius_from + s * (limb.radius_to - limb.radius_from));
  return glm::dot(apart, apart) < radius * radius;
}

}  // namespace rinkaku::recordings

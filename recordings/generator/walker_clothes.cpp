#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "recordings/generator/noise.h"
#include "recordings/generator/walker.h"

namespace rinkaku::recordings {
namespace {

// Checked flannel: broad bands crossing, thin light lines between.
glm::vec3 flannel(float along, float around) {
  const auto band = [](float t, float period, float width) {
    const float s = t / period - std::floor(t / period);
    return glm::smoothstep(0.0f, 0.03f, s) * (1 - glm::smoothstep(width, width + 0.03f, s));
  };
  const glm::vec3 red(0.52f, 0.060f, 0.045f), dark(0.055f, 0.035f, 0.055f), cream(0.72f, 0.62f, 0.46f);
  const float bands = 0.5f * (band(along, 0.072f, 0.42f) + band(around, 0.072f, 0.42f));
  const float lines = std::max(band(along + 0.022f, 0.072f, 0.07f), band(around + 0.022f, 0.072f, 0.07f));
  return glm::mix(glm::mix(red, dark, 0.85f * bands), cream, 0.75f * lines);
}

}  // namespace

glm::vec3 Walker::colour(int part, glm::vec3 rest) {
  const float cloud = fractal_noise(rest * 14.0f, 3, 91);
  switch (part) {
    case Skin: {
      const float flush = glm::smoothstep(
          0.06f, 0.0f, glm::distance(glm::vec3(rest.x, std::abs(rest.y), rest.z), {0.075f, 0.05f, 1.572f}));
      return glm::vec3(0.56f, 0.315f, 0.215f) * (1 + 0.05f * cloud) + flush * glm::vec3(0.05f, -0.02f, -0.02f);
    }
    case Hair:
      return glm::vec3(0.060f, 0.032f, 0.019f) * (1 + 0.6f * noise(rest * glm::vec3(40, 190, 60), 92));
    case Shirt: {
      const bool sleeve = std::abs(rest.y) > 0.185f;
      const float around = sleeve ? rest.x + 0.01f : 0.15f * std::atan2(rest.y, rest.x + 0.01f);
      const float along = sleeve ? rest.z - 0.33f * std::abs(rest.y) : rest.z;
      return flannel(along, around) * (1 + 0.10f * cloud);
    }
    case Jeans: {
      const float fade =
          glm::smoothstep(0.20f, 0.0f, std::abs(rest.z - 0.62f)) * glm::smoothstep(-0.02f, 0.08f, rest.x);
      const float weave = noise(rest * glm::vec3(260, 260, 90), 93);
      const float seam =
          glm::smoothstep(0.006f, 0.002f, std::abs(rest.x + 0.006f)) * glm::smoothstep(0.09f, 0.13f, std::abs(rest.y));
      return glm::mix(glm::vec3(0.040f, 0.068f, 0.145f), glm::vec3(0.135f, 0.190f, 0.285f),
                      0.25f + 0.55f * fade + 0.12f * weave + 0.12f * cloud) *
             (1 - 0.4f * seam);
    }
    case Shoes: {
      const bool stripe = std::abs(rest.x - 0.045f - 0.5f * (rest.z - 0.06f)) < 0.012f;
      return stripe ? glm::vec3(0.06f, 0.16f, 0.30f) : glm::vec3(0.66f, 0.65f, 0.62f) * (1 + 0.04f * cloud);
    }
    case Sole:
      return {0.50f, 0.42f, 0.30f};
    case Bag: {
      const float zip =
          glm::smoothstep(0.005f, 0.003f, std::abs(rest.z - 1.215f)) * glm::smoothstep(-0.20f, -0.24f, rest.x);
      return glm::vec3(0.085f, 0.130f, 0.095f) * (1 + 0.16f * noise(rest * 160.0f, 94) + 0.12f * cloud) *
             (1 - 0.7f * zip);
    }
    case Eye:
      return {0.020f, 0.013f, 0.010f};
    default:
      return glm::vec3(0.5f);
  }
}

}  // namespace rinkaku::recordings

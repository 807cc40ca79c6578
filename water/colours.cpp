#include "water/colours.h"

namespace rinkaku::water {

glm::vec3 neighbourhood_mean(const ReferencePicture& reference, glm::dvec2 pixel, glm::dvec2 reach_px) {
  glm::vec3 sum(0);
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) sum += reference.at(pixel + glm::dvec2(x, y) * reach_px);
  }
  return sum / 9.0f;
}

std::array<float, 4> spline_weights(double t) {
  const double s = 1 - t;
  return {static_cast<float>(s * s * s / 6), static_cast<float>((3 * t * t * t - 6 * t * t + 4) / 6),
          static_cast<float>((3 * s * s * s - 6 * s * s + 4) / 6), static_cast<float>(t * t * t / 6)};
}

glm::vec3 KeyColours::at(std::size_t place, std::int64_t frame) const {
  const std::int64_t j = frame / key_frames_;
  const auto w = spline_weights(static_cast<double>(frame - j * key_frames_) / key_frames_);
  const glm::vec3* keys = keys_.data() + place * ring;
  glm::vec3 sum(0);
  for (int k = 0; k < 4; ++k) sum += keys[static_cast<std::size_t>(j - 1 + k) & (ring - 1)] * w[k];
  return sum;
}

void FollowedColours::follow(std::size_t place, glm::vec3 colour) {
  // Two poles that lag two frames each: (1 - a) / a = 2.
  constexpr float a = 1.0f / 3;
  State& s = states_[place];
  s.first += (colour - s.first) * a;
  s.second += (s.first - s.second) * a;
}

}  // namespace rinkaku::water

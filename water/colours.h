#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "water/reference_picture.h"

namespace rinkaku::water {

/// A stroke's colour from the reference picture: the mean of its middle and of eight places around it, as if waves
/// turned the mirrored rays. (Suzuki et al. 2004, equation 2, n = 8.) `reach_px`: how far the places lie from the
/// middle, along x and y.
glm::vec3 neighbourhood_mean(const ReferencePicture& reference, glm::dvec2 pixel, glm::dvec2 reach_px);

/// The cubic B-spline's weights of the keys j - 1, j, j + 1 and j + 2 at j + t, t from 0 to 1. (Suzuki et al. 2004,
/// equation 3, in units of the key spacing; the printed second branch lacks a power.)
std::array<float, 4> spline_weights(double t);

/// Each particle's colours at the key frames around the present one, and smooth colours between. (Suzuki et al. 2004,
/// 4.4.) Keys of before a particle's birth or after its end are its first or last one's.
class KeyColours {
 public:
  KeyColours(std::size_t places, int key_frames) : key_frames_(key_frames), keys_(places * ring) {}

  int key_frames() const { return key_frames_; }
  void set(std::size_t place, std::int64_t key, glm::vec3 colour) {
    keys_[place * ring + static_cast<std::size_t>(key & (ring - 1))] = colour;
  }
  /// A colour for these keys, both included; at most eight.
  void fill(std::size_t place, std::int64_t first_key, std::int64_t last_key, glm::vec3 colour) {
    for (std::int64_t k = first_key; k <= last_key; ++k) set(place, k, colour);
  }
  glm::vec3 at(std::size_t place, std::int64_t frame) const;

 private:
  static constexpr std::size_t ring = 8;
  int key_frames_;
  std::vector<glm::vec3> keys_;
};

/// Colours that follow have forgotten what was so many frames ago, to less than a step of 8 bits.
inline constexpr int memory_frames = 30;

/// Colours that follow the reference picture without knowing what comes: a low-pass filter of second order over the
/// past frames, for live use. Its lag behind an even change is four frames.
class FollowedColours {
 public:
  explicit FollowedColours(std::size_t places) : states_(places) {}

  void start(std::size_t place, glm::vec3 colour) { states_[place] = {colour, colour}; }
  void follow(std::size_t place, glm::vec3 colour);
  glm::vec3 at(std::size_t place) const { return states_[place].second; }

 private:
  struct State {
    glm::vec3 first{0}, second{0};
  };
  std::vector<State> states_;
};

}  // namespace rinkaku::water

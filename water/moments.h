#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace rinkaku::water {

/// What a stroke needs to know of its particle at one frame.
struct Drifter {
  glm::vec2 at{0};        ///< metres, in the surface's axes
  glm::vec2 velocity{0};  ///< metres a second
  std::uint32_t serial = 0;
  std::uint32_t place = 0;    ///< in the list of particles
  std::uint16_t opacity = 0;  ///< of 65535
  std::uint8_t brush = 0;
};

/// The drifters of some frames in succession: where water is known ahead of the frame that is painted, it need not be
/// carried along twice. 28 bytes a drifter and frame.
class Moments {
 public:
  /// `frames` are kept, of at most so many drifters each.
  Moments(std::size_t frames, std::size_t drifters) : frames_(frames) {
    for (auto& f : frames_) f.reserve(drifters);
  }
  /// Begins a frame in the place of the oldest one.
  std::vector<Drifter>& begin(std::int64_t frame) {
    std::vector<Drifter>& f = frames_[static_cast<std::size_t>(frame) % frames_.size()];
    f.clear();
    return f;
  }
  /// One of the frames begun last.
  std::span<const Drifter> of(std::int64_t frame) const {
    return frames_[static_cast<std::size_t>(frame) % frames_.size()];
  }

 private:
  std::vector<std::vector<Drifter>> frames_;
};

}  // namespace rinkaku::water

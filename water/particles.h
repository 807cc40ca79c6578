#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "water/flow.h"
#include "water/plots.h"
#include "water/surface.h"

namespace rinkaku::water {

/// A point on the water that carries a stroke.
struct Particle {
  enum class State : std::uint8_t { Free, Alive, Leaving };
  glm::dvec2 at{0};
  glm::dvec2 velocity{0};    ///< metres a second
  float opacity = 0;         ///< 0 to 1, rising after birth and falling before death
  std::uint32_t serial = 0;  ///< which it is among all that ever lived: what is random of a stroke hangs on it
  std::int64_t free_since = 0;
  State state = State::Free;
};

struct ParticleOptions {
  double seconds_per_frame = 1.0 / 25;
  int fade_frames = 12;             ///< opacity rises and falls by 1 / fade_frames a frame
  double births_per_frame = 0.005;  ///< at most, of all strokes, beyond what flows in at open edges
  int rest_frames = 0;              ///< a place in the list is used again only after so many frames
};

/// What happened in a frame.
struct Census {
  std::size_t alive = 0, leaving = 0;
  std::size_t births = 0;
  double flowed_in = 0;  ///< how many strokes the flow through open edges calls for
};

/// The particles of one surface: carried by the flow, and kept as dense as the plots want. Where a plot has become too
/// empty new ones fade in, where it is too full some fade out, and what leaves through an open edge fades out beyond
/// it.
///
/// What happens depends on nothing but the frame's number, so that going to a frame gives what playing to it gives.
/// No allocation after construction. One thread at a time.
class Particles {
 public:
  /// All must outlive it. The state is that of frame 0: full, nothing fading.
  Particles(const Surface& surface, const Plots& plots, Flow& flow, const ParticleOptions& options);

  /// One frame on. Cost: some 0.3 microseconds a particle.
  void advance();
  std::int64_t frame() const { return frame_; }
  /// By place in the list, which a particle keeps for life; those that are Free are to be passed over.
  std::span<const Particle> list() const { return list_; }
  const Census& census() const { return census_; }

 private:
  void carry();
  void count();
  void thin_out();
  void fill_up();
  bool bear(int plot, float opacity);
  double inflow() const;

  const Surface& surface_;
  const Plots& plots_;
  Flow& flow_;
  ParticleOptions options_;
  std::vector<Particle> list_;
  std::vector<std::uint32_t> free_;  // a queue, oldest first
  std::size_t free_first_ = 0, free_count_ = 0;
  // Of each plot: how many are alive there, and the first of them; then each particle's next.
  std::vector<std::int32_t> count_, first_, next_;
  std::int64_t frame_ = 0;
  std::uint32_t born_ = 0;
  double allowance_ = 0;  // of births, fractions carried over
  Census census_;
};

}  // namespace rinkaku::water

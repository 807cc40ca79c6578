#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "water/section.h"
#include "water/stroke_size.h"
#include "water/strokes.h"
#include "water/surface.h"

namespace rinkaku::water {

struct WaterlineOptions {
  std::array<double, 3> colour{0.86, 0.92, 0.93};  ///< sRGB-coded
  StrokeSize size;                                 ///< the surface's
  double frames_per_s = 25;
};

/// Light strokes where the water meets its shores and what stands in it. They lie along the line and swell and fade
/// slowly, each in its own time; no stroke's opacity changes by more than a twentieth a frame at 10 frames a second or
/// more. A frame's strokes depend on its number alone. One thread.
class Waterline {
 public:
  Waterline(const Surface& surface, std::span<const Segment> bodies, const WaterlineOptions& options);

  /// Adds the frame's strokes to `strokes`. No allocation once warm.
  void add(std::int64_t frame, const CameraModel& camera, const RigidTransform& camera_from_world,
           Strokes& strokes) const;

 private:
  struct Spot {
    glm::dvec3 at{0};
    glm::dvec3 along{0};  // unit
    std::uint32_t serial = 0;
  };
  void add_spots(const Surface& surface, std::span<const Segment> segments, double spacing_m);

  WaterlineOptions options_;
  std::vector<Spot> spots_;
};

/// How drops rise along a line.
struct SprayOptions {
  glm::dvec3 from_m{0}, to_m{0};
  int drops = 300;
  double height_m = 0.3;  ///< how high the highest rises
  double size_m = 0.1;
  std::array<double, 3> colour{0.95, 0.97, 1.0};
  double frames_per_s = 25;
};

/// Adds the spray of a frame: drops that rise, fall and fade, over and over, at places, heights and times of their own.
/// It depends on the frame's number alone. (Suzuki et al. 2004, figure 9.)
void add_spray(const SprayOptions& options, std::int64_t frame, const CameraModel& camera,
               const RigidTransform& camera_from_world, Strokes& drops);

}  // namespace rinkaku::water

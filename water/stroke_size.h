#pragma once

#include <optional>

#include <glm/vec2.hpp>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "water/surface.h"

namespace rinkaku::water {

/// How large strokes are on the screen.
struct StrokeSize {
  double length_m = 0;  ///< beta / focal length of equation 4: what the stroke's length would measure upright there
  double width = 0.22;  ///< of the length
  double width_px = 0;  ///< if above 0: the same width for all strokes, as the paper has it
  double least_px = 5;  ///< of the length
  double most_px = 160;
};

/// Length in pixels at a depth: beta / z. (Suzuki et al. 2004, equation 4.)
double stroke_length_px(const StrokeSize& size, double focal_px, double depth_m);
double stroke_width_px(const StrokeSize& size, double length_px);

/// From where a surface is seen, to decide where how many strokes are needed.
struct Outlook {
  CameraModel camera;
  RigidTransform camera_from_world;
};

/// How many strokes a square metre of a surface needs so that all of the picture is covered alike, but for a common
/// factor: the square metre's pixels over a stroke's. Without an outlook the same everywhere.
class StrokeDensity {
 public:
  StrokeDensity(const Surface& surface, const std::optional<Outlook>& outlook, const StrokeSize& size);
  /// 0 where the outlook doesn't see: behind the camera, or farther outside the picture than an eighth of its size.
  double at(glm::dvec2 p) const;
  /// Pixels of the outlook's picture that a square metre there takes; 0 where it isn't seen.
  double pixels_per_m2(glm::dvec2 p) const;

 private:
  struct Seen {
    double depth_m = 0;
    double pixels_per_m2 = 0;
  };
  Seen seen(glm::dvec2 p) const;
  std::optional<Outlook> outlook_;
  StrokeSize size_;
  glm::dvec3 origin_{0}, along_x_{0}, along_y_{0};  // camera_from_surface
};

/// How much of the outlook's picture a surface takes, in pixels; without an outlook its area in square metres.
double seen_size(const Surface& surface, const std::optional<Outlook>& outlook);

/// The length (in metres, see StrokeSize) at which `strokes` strokes cover the picture `layers` times; `size` gives the
/// rest. Without an outlook, what covers the surface so many times, seen from above.
double covering_length_m(const Surface& surface, const std::optional<Outlook>& outlook, StrokeSize size, int strokes,
                         double layers);

}  // namespace rinkaku::water

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include <glm/mat4x4.hpp>

#include "pipeline/passes/view.h"
#include "silhouette/surface.h"
#include "silhouette/verify/hull_faces.h"
#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

/// A view of an object through which a region's matte is compared with the whole mesh's.
struct CheckView {
  std::uint32_t region = 0;
  glm::dmat4 world_from_object{1};
  passes::View view;
  double radius_px = 0;     ///< that the unit frame's radius takes in the picture, at most
  std::string description;  ///< for messages: where the eye is, how the object is placed, which camera
};

struct CheckViewOptions {
  std::uint64_t seed = 1;
  std::optional<glm::ivec2> size_px;  ///< of all pictures; else of several sizes, most of them 640x480
};

/// Thinks up views that are hard on region mattes, the n-th always the same for one seed.
///
/// Eyes lie inside regions, exactly on vertices, edges and faces of their hulls, and on both sides of borders between
/// regions, as near as double precision goes. Objects are as large as their mesh, or 1e-4 or 1e4 of that, 1e5 away
/// from the origin, unevenly scaled, mirrored, cut by the near plane, or by the plane through the eye, or by the
/// picture's border. Pictures are of 640x480 to 3840x2160 pixels, fields of view of 5 to 120 degrees over the height.
class CheckViews {
 public:
  CheckViews(ViewSpace space, const UnitFrame& frame, const CheckViewOptions& options = {});
  CheckView view(std::uint64_t n);

 private:
  class Random;
  struct Eye {
    glm::dvec3 unit{0};
    std::uint32_t region = 0;
    const char* where = "";
  };
  Eye eye_on_hull(Random& random);
  std::optional<Eye> eye_at_border(Random& random) const;
  CheckView placed(Random& random, const Eye& eye) const;

  ViewSpace space_;
  UnitFrame frame_;
  CheckViewOptions options_;
  RegionFinder finder_;
  std::map<std::uint32_t, HullFaces> faces_;  // of regions that were asked for
};

/// A pinhole camera over a whole picture, with this field of view over its height.
CameraModel camera_of(const glm::ivec2& size_px, double fov_rad);

/// A camera at `eye` that looks at `target`, the world's +y up in the picture (or +x where it looks along y).
RigidTransform looking_at(const glm::dvec3& eye, const glm::dvec3& target);

}  // namespace rinkaku::silhouette

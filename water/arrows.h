#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "water/surface.h"

namespace rinkaku::water {

/// How the water moves at one place of a surface: the surface's own metres, and metres a second.
struct Arrow {
  glm::dvec2 at{0};
  glm::dvec2 velocity{0};
};

/// All arrows of a key frame. Every key has as many, in the same order, so that each one can turn into the next key's.
struct ArrowKey {
  std::int64_t frame = 0;
  std::vector<Arrow> arrows;
};

/// The point of the surface's plane that the camera sees at a pixel of the pinhole picture, in the surface's metres;
/// `found` is false at and above the horizon. (Suzuki et al. 2004, 4.2: inverse perspective.)
struct SeenPoint {
  glm::dvec2 at{0};
  bool found = false;
};
SeenPoint back_projected(const Surface& surface, const CameraModel& camera, const RigidTransform& camera_from_world,
                         glm::dvec2 pixel);

/// An arrow drawn on the screen, brought onto the surface; its length is covered in one second. Throws Error (Input),
/// naming `where`, if it begins or ends at or above the horizon.
Arrow arrow_from_screen(std::string_view where, const Surface& surface, const CameraModel& camera,
                        const RigidTransform& camera_from_world, glm::dvec2 from_px, glm::dvec2 to_px);

/// The arrows at a moment between keys: places move straight, velocities turn the shorter way round at an even rate
/// (counter-clockwise if they are opposite) while their speed changes evenly, so that none stalls on the way. Before
/// the first and after the last key they stay. `keys` in order of frames; writes to `arrows` without allocating once
/// warm.
void arrows_at(std::span<const ArrowKey> keys, double frame, std::vector<Arrow>& arrows);

/// The velocity that the arrows ask for at a place: their mean, weighted with exp(-d / alpha) of the distance d.
/// (Suzuki et al. 2004, equation 1, normalised; the nearest distance is taken off first, so that small alphas work and
/// arrows at one place share it.) Zero without arrows. Cost: one exponential an arrow.
glm::dvec2 wished_velocity(std::span<const Arrow> arrows, double alpha_m, glm::dvec2 at);

}  // namespace rinkaku::water

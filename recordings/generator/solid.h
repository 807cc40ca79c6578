#pragma once

#include "recordings/generator/room.h"

namespace rinkaku::recordings {

/// Shortens `hit` to where the ray meets the solid, if it does before; all but `solid` is filled in.
bool intersect(const Solid& solid, glm::vec3 origin, glm::vec3 direction, Hit& hit);

/// The point and normal of a face at uv, for light maps, and the face's size in metres.
struct FacePoint {
  glm::vec3 point, normal;
};
FacePoint face_point(const Solid& solid, int face, glm::vec2 uv);
glm::vec2 face_size_m(const Solid& solid, int face);

/// Half size of the box along the world's axes about bounding_centre.
glm::vec3 bounding_half_size(const Solid& solid);

/// Centre and radius of a sphere about the solid.
glm::vec3 bounding_centre(const Solid& solid);
float bounding_radius(const Solid& solid);

}  // namespace rinkaku::recordings

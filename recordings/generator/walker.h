#pragma once

#include <array>
#include <vector>

#include <glm/mat4x4.hpp>

#include "recordings/generator/implicit_surface.h"

namespace rinkaku::recordings {

/// A limb or a part of the trunk: a cone with round ends.
struct Limb {
  glm::vec3 from, to;
  float radius_from = 0, radius_to = 0;
};

/// Somebody with a rucksack, 1.72 m tall, who walks along +x (y to the left, z up). Made once as a skin around bones;
/// each moment of the walk bends it.
class Walker {
 public:
  enum Part { Skin, Hair, Shirt, Jeans, Shoes, Sole, Bag, Eye, Parts };
  static constexpr int bones = 17;

  Walker();

  /// The moment's shape. Feet on the ground stay where they are; at time 0 the hips are over x = 0.
  struct Moment {
    std::vector<glm::vec3> positions, normals;
    std::array<Limb, bones> limbs;
    std::array<glm::mat4, bones> moved_from_rest;
  };
  Moment at(double time_s) const;

  const ColouredMesh& skin() const { return mesh_; }
  /// The clothes' colour (linear) at a place of the shape at rest.
  static glm::vec3 colour(int part, glm::vec3 rest);
  static constexpr double speed_m_s = 1.05;

 private:
  struct Influence {
    std::array<int, 4> bone;
    std::array<float, 4> weight;
  };
  ColouredMesh mesh_;
  std::vector<Influence> influences_;
};

/// Whether a ray meets the limb, slimmed by `slim`, nearer than `distance`.
bool meets(const Limb& limb, glm::vec3 origin, glm::vec3 direction, float distance, float slim);

}  // namespace rinkaku::recordings

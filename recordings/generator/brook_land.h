#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::recordings {

/// A dry brook between meadows under a low cliff, with trees behind: heights on a grid, and the light they send.
/// Metres, x right, y away from the camera, z up; the water would stand at z = 0.
class BrookLand {
 public:
  BrookLand();
  /// Linear light that comes from a direction (unit) to a place above the land.
  glm::vec3 light(glm::vec3 eye, glm::vec3 direction) const;
  /// The rocks in the brook as an OBJ file, down into the ground, for CG to be hidden by.
  std::string rocks_obj() const;

 private:
  struct Tree {
    glm::vec3 foot;
    float height, radius;
    unsigned seed;
  };
  struct Hit {
    float distance = 1e9f;
    const Tree* tree = nullptr;
  };
  float height(glm::vec2 p) const;  // bilinear on the grid
  glm::vec3 normal(glm::vec2 p) const;
  Hit first_hit(glm::vec3 eye, glm::vec3 direction, float most) const;
  float lit(glm::vec3 point, glm::vec3 normal) const;
  glm::vec3 ground_colour(glm::vec3 point, glm::vec3 normal) const;

  std::vector<float> heights_;
  std::vector<Tree> trees_;
};

}  // namespace rinkaku::recordings

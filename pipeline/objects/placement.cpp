#include "pipeline/objects/placement.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "pipeline/frame/error.h"

namespace rinkaku::pipeline {
namespace {

// Takes the mesh's up axis to z, keeping right-handedness.
glm::dmat4 z_from_up(char up) {
  switch (up) {
    case 'x':
      return {{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    case 'y':
      return {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}};
    default:
      return glm::dmat4(1.0);
  }
}

}  // namespace

glm::dmat4 world_from_object(const ObjectScene& object, const mesh::Box& box, char default_up) {
  const char up = object.up.value_or(default_up);
  const int axis = up - 'x';
  glm::dvec3 anchor(0);
  glm::dvec3 scale = object.scale;
  if (object.height_m) {
    const double height = box.size()[axis];
    if (!(height > 0)) {
      throw input_error(object.mesh.string(), std::string("the mesh has no height along its up axis ") + up,
                        "give scale instead of height_m, or another up");
    }
    scale = glm::dvec3(*object.height_m / height);
  }
  if (object.anchor == ObjectScene::Anchor::Base) {
    anchor = box.centre();
    anchor[axis] = box.min[axis];
  }
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), object.position_m);
  m = glm::rotate(m, glm::radians(object.rotation_deg.z), glm::dvec3(0, 0, 1));
  m = glm::rotate(m, glm::radians(object.rotation_deg.y), glm::dvec3(0, 1, 0));
  m = glm::rotate(m, glm::radians(object.rotation_deg.x), glm::dvec3(1, 0, 0));
  m = glm::scale(m, scale);
  return m * z_from_up(up) * glm::translate(glm::dmat4(1.0), -anchor);
}

}  // namespace rinkaku::pipeline

#pragma once

#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <opencv2/core.hpp>

namespace rinkaku::recordings {

/// What a face looks like. Colours are linear, textures sRGB pictures spread over the face (row 0 is v = 1).
struct Surface {
  glm::vec3 colour{0.8f};
  cv::Mat3b texture;     ///< multiplied by colour unless empty
  float shine = 0;       ///< strength of the reflection of the window and the room
  float sharpness = 40;  ///< of that reflection: about 10 is satin, 1000 glaze
};

/// A solid in its own frame: a box of half size `size`; a frustum about z from z = 0 (radius size.x) to z = size.z
/// (radius size.y), with or without caps; a ring in the plane z = 0 between radii size.x and size.y; an ellipsoid;
/// half a torus of radii size.x (large) and size.y (tube) in the plane y = 0, on the side x > 0.
struct Solid {
  enum class Shape { Box, Frustum, Tube, Ring, Ellipsoid, Arc } shape = Shape::Box;
  glm::vec3 size{1};
  glm::vec3 position{0};
  glm::mat3 rotation{1};      ///< world from own frame
  std::vector<int> surfaces;  ///< of each face (see faces()); one stands for all

  static int faces(Shape shape);
};

struct Hit {
  float distance = 1e30f;
  int solid = -1;
  int face = 0;
  glm::vec2 uv{0};  ///< in [0, 1]^2 of the face
  glm::vec3 point{0};
  glm::vec3 normal{0};
};

/// A rectangular area light: one corner and two sides; shines along side_u x side_v.
struct Window {
  glm::vec3 corner{0}, side_u{1, 0, 0}, side_v{0, 0, 1};
  glm::vec3 radiance{10};
};

/// Things that stand still under light that stays the same, so that the light on every face is found once (bake) and
/// then looked up. Not changed after bake(); shade() may be called from many threads.
class Room {
 public:
  int add_surface(const Surface& surface);
  int add(const Solid& solid);
  void set_light(const Window& window, glm::vec3 ambient_above, glm::vec3 ambient_below);

  /// Light falling on each face from the window (with soft shadows), from the room around and, once, from the other
  /// faces. `texel_m` is the finest detail of shadows. Flat faces turned away from all `eyes` are left out.
  void bake(float texel_m, int samples, const std::vector<glm::vec3>& eyes);

  /// The nearest solid of `candidates` (all, if null) along a ray of unit direction.
  Hit trace(glm::vec3 origin, glm::vec3 direction, const std::vector<int>* candidates = nullptr) const;
  bool is_blocked(glm::vec3 origin, glm::vec3 direction, float distance) const;

  /// Radiance towards where the ray came from.
  glm::vec3 shade(const Hit& hit, glm::vec3 direction) const;
  glm::vec3 environment(glm::vec3 direction, glm::vec3 from, float sharpness) const;

  /// Which solids can be seen inside the cone of `half_angle` radians about `axis`.
  std::vector<int> inside_cone(glm::vec3 origin, glm::vec3 axis, float half_angle) const;

  const Window& window() const { return window_; }

 private:
  struct Lightmap {
    int width = 0, height = 0;
    std::vector<glm::vec3> light;
    glm::vec3 at(glm::vec2 uv) const;
  };
  struct Node {  // of a tree of boxes about solids
    glm::vec3 low{0}, high{0};
    int solid = -1;  // a leaf's
    int second = 0;  // the other child; the first follows its parent
  };
  void build_tree();
  void build_tree(std::vector<int>& solids, std::size_t begin, std::size_t end);
  template <class Visit>
  void visit_along(glm::vec3 origin, glm::vec3 direction, const float& distance, const Visit& visit) const;
  glm::vec3 irradiance(glm::vec3 point, glm::vec3 normal, int samples, glm::vec2 shift) const;
  glm::vec3 albedo(const Hit& hit) const;
  const Surface& surface(int solid, int face) const;

  std::vector<Surface> surfaces_;
  std::vector<Solid> solids_;
  std::vector<float> radii_;  ///< of the spheres about solids
  std::vector<glm::vec3> centres_;
  std::vector<Node> tree_;
  std::vector<std::vector<Lightmap>> lightmaps_;  ///< of each face of each solid
  Window window_;
  glm::vec3 above_{0.5f}, below_{0.2f};
};

/// Rotation about z by `degrees`, then whatever is multiplied from the left.
glm::mat3 turn_z(float degrees);
/// A frame whose z axis is the given direction.
glm::mat3 frame_along(glm::vec3 z);

}  // namespace rinkaku::recordings

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "pipeline/passes/layer_renderer.h"
#include "pipeline/passes/toon/band_borders.h"
#include "pipeline/passes/toon/toon_pass.h"

// Scenes drawn in the camera's own frame (x right, y down, z away), and what their layers hold.
namespace rinkaku::test {

inline passes::ToonOptions unlit() {
  passes::ToonOptions options;
  options.bands = 0;
  return options;
}

inline passes::StyledObject toon(const mesh::Mesh& mesh, const glm::dmat4& camera_from_object,
                                 const passes::ToonOptions& options = unlit()) {
  passes::StyledObject styled;
  styled.object = std::make_unique<passes::DrawnObject>(
      passes::ObjectShape(mesh, camera_from_object, passes::band_borders(mesh, camera_from_object, options)));
  styled.passes.push_back(std::make_unique<passes::ToonPass>(*styled.object, mesh, options));
  return styled;
}

/// Square pixels, the eye's axis through the middle of the picture.
inline passes::View view(int width_px, int height_px, double focal_px) {
  passes::View v;
  v.camera.width_px = width_px, v.camera.height_px = height_px;
  v.camera.fx_px = v.camera.fy_px = focal_px;
  v.camera.cx_px = (width_px - 1) / 2.0, v.camera.cy_px = (height_px - 1) / 2.0;
  return v;
}

inline passes::PixelRect picture_of(const passes::View& v) { return {0, 0, v.camera.width_px, v.camera.height_px}; }

template <typename... Objects>
std::vector<passes::StyledObject> scene_of(Objects... objects) {
  std::vector<passes::StyledObject> scene;
  (scene.push_back(std::move(objects)), ...);
  return scene;
}

/// What a fresh renderer draws.
inline passes::Layer drawn(std::vector<passes::StyledObject> scene, const passes::View& v) {
  passes::LayerRenderer renderer(std::move(scene), picture_of(v));
  passes::Layer layer;
  renderer.draw(v, layer);
  return layer;
}

using Rgba = std::array<int, 4>;

/// The layer at a pixel of the picture; nothing outside its rectangle.
inline Rgba at(const passes::Layer& layer, int x, int y) {
  const int lx = x - layer.rect.x_px, ly = y - layer.rect.y_px;
  if (lx < 0 || ly < 0 || lx >= layer.rect.width_px || ly >= layer.rect.height_px) return {};
  const std::uint8_t* rgba = layer.rgba.data() + (static_cast<std::size_t>(ly) * layer.rect.width_px + lx) * 4;
  return {rgba[0], rgba[1], rgba[2], rgba[3]};
}

/// The sum of alpha, 1 a covered pixel.
inline double area_px(const passes::Layer& layer) {
  double sum = 0;
  for (std::size_t i = 3; i < layer.rgba.size(); i += 4) sum += layer.rgba[i];
  return sum / 255;
}

inline glm::dvec2 centroid_px(const passes::Layer& layer) {
  glm::dvec2 sum(0);
  for (int y = layer.rect.y_px; y < layer.rect.bottom_px(); ++y) {
    for (int x = layer.rect.x_px; x < layer.rect.right_px(); ++x) {
      sum += glm::dvec2(x, y) * (at(layer, x, y)[3] / 255.0);
    }
  }
  return sum / area_px(layer);
}

inline glm::dmat4 moved(double x, double y, double z) { return glm::translate(glm::dmat4(1), glm::dvec3(x, y, z)); }
inline glm::dmat4 scaled(double s) { return glm::scale(glm::dmat4(1), glm::dvec3(s)); }

/// The ellipse that a sphere is seen as: the cone around it cut by the picture's plane.
struct SeenSphere {
  double area_px = 0;
  glm::dvec2 centre_px{0};
};
inline SeenSphere seen_sphere(const CameraModel& camera, const glm::dvec3& centre, double radius) {
  const double d = glm::length(centre), sin_a = radius / d, cos_a = std::sqrt(1 - sin_a * sin_a);
  const double cos_t = centre.z / d, cut = cos_t * cos_t - sin_a * sin_a;
  const double semi_major = sin_a * cos_a / cut, semi_minor = sin_a / std::sqrt(cut);
  const double off_axis = std::sqrt(1 - cos_t * cos_t) * cos_t / cut;
  const glm::dvec2 across(centre.x, centre.y);
  const glm::dvec2 direction = glm::length(across) > 0 ? glm::normalize(across) : glm::dvec2(0);
  return {std::acos(-1.0) * camera.fx_px * camera.fy_px * semi_major * semi_minor,
          to_pixels(camera, direction * off_axis)};
}

/// The exact area of the convex hull of points on the picture.
inline double hull_area_px(std::vector<glm::dvec2> points) {
  std::sort(points.begin(), points.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  double twice = 0;
  for (int side = 0; side < 2; ++side) {
    std::vector<glm::dvec2> chain;
    for (const glm::dvec2& p : points) {
      auto turns_in = [&] {
        const glm::dvec2 a = chain[chain.size() - 2], b = chain.back();
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) <= 0;
      };
      while (chain.size() >= 2 && turns_in()) chain.pop_back();
      chain.push_back(p);
    }
    for (std::size_t i = 1; i < chain.size(); ++i) twice += chain[i - 1].x * chain[i].y - chain[i].x * chain[i - 1].y;
    std::reverse(points.begin(), points.end());
  }
  return std::abs(twice) / 2;
}

}  // namespace rinkaku::test

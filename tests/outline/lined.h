#pragma once

#include <memory>
#include <vector>

#include "outline/pass/hull_pass.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/shapes.h"

// Objects with lines, for tests.
namespace rinkaku::test {

/// A white body with a red line, so that the two can be measured apart.
inline passes::StyledObject lined(const mesh::Mesh& mesh, const glm::dmat4& place, outline::HullOptions options) {
  passes::StyledObject styled = toon(mesh, place);
  styled.passes.push_back(std::make_unique<outline::HullPass>(*styled.object, options));
  return styled;
}
inline passes::StyledObject lined(const mesh::Mesh& mesh, const glm::dmat4& place, double width_px,
                                  const glm::vec3& colour = {1, 0, 0}) {
  outline::HullOptions options;
  options.look.width_px = static_cast<float>(width_px);
  options.look.colour = colour;
  return lined(mesh, place, options);
}

/// The area of a colour: the sum of one channel.
inline double channel_px(const passes::Layer& layer, int channel) {
  double sum = 0;
  for (std::size_t i = static_cast<std::size_t>(channel); i < layer.rgba.size(); i += 4) sum += layer.rgba[i];
  return sum / 255;
}

/// Alpha, 0 to 1, between pixels.
inline double alpha_at(const passes::Layer& layer, const glm::dvec2& p) {
  const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
  const double fx = p.x - x, fy = p.y - y;
  const auto alpha = [&](int dx, int dy) { return at(layer, x + dx, y + dy)[3] / 255.0; };
  return (1 - fy) * ((1 - fx) * alpha(0, 0) + fx * alpha(1, 0)) + fy * ((1 - fx) * alpha(0, 1) + fx * alpha(1, 1));
}

/// Radius 1 about y, from y = -1 to 1, with hard rims.
inline mesh::Mesh cylinder(std::uint32_t sides) {
  mesh::Mesh mesh;
  std::vector<glm::vec3> top, bottom;
  std::vector<std::uint32_t> top_points, bottom_points;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double a = 2 * std::acos(-1.0) * i / sides;
    top.emplace_back(std::cos(a), 1, -std::sin(a));
    bottom.emplace_back(std::cos(a), -1, -std::sin(a));
    top_points.push_back(i), bottom_points.push_back(sides + i);
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    add_face(mesh, {bottom[i], bottom[j], top[j], top[i]}, {sides + i, sides + j, j, i});
  }
  add_face(mesh, top, top_points);
  std::reverse(bottom.begin(), bottom.end());
  std::reverse(bottom_points.begin(), bottom_points.end());
  add_face(mesh, bottom, bottom_points);
  one_part(mesh, glm::vec4(1));
  return mesh;
}

/// How far alpha reaches beyond a contour point, across the contour.
inline double reach_px(const passes::Layer& layer, const glm::dvec2& contour, const glm::dvec2& outwards,
                       double width_px) {
  constexpr double inside = 4, step = 0.1;
  double sum = 0;
  for (double r = -inside; r < 3 * width_px + 4; r += step) sum += alpha_at(layer, contour + outwards * r) * step;
  return sum - inside;
}

}  // namespace rinkaku::test

#include "pipeline/objects/outline_passes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "mesh/bounds.h"
#include "mesh/topology.h"
#include "outline/line_width.h"
#include "outline/local_thickness.h"
#include "outline/pass/hull_pass.h"
#include "outline/strokes/bristles.h"
#include "outline/styles/facing_pass.h"
#include "outline/styles/inverted_hull_pass.h"
#include "outline/styles/picture_lines_pass.h"
#include "outline/styles/stroke_pass.h"
#include "pipeline/objects/control_line.h"
#include "pipeline/objects/drawn_lines_file.h"
#include "pipeline/objects/texture_file.h"

namespace rinkaku::pipeline {
namespace {

using M = LineMethod;

glm::vec3 colour(const std::array<double, 3>& c) { return glm::vec3(c[0], c[1], c[2]); }

outline::LineLook look_of(const OutlineScene& line) {
  return {static_cast<float>(line.width_px), static_cast<float>(line.width_m.value_or(0)),
          static_cast<float>(line.min_px), static_cast<float>(line.max_px), colour(line.colour)};
}

outline::LineLook thinner(outline::LineLook look) {
  look.width_px /= 2, look.width_m /= 2, look.least_px /= 2, look.most_px /= 2;
  return look;
}

double radius_m(const passes::DrawnObject& object, const mesh::Mesh& mesh) {
  const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(object.shape().world_from_object()))));
  return mesh::bounding_sphere(mesh.positions).radius * scale;
}

std::unique_ptr<passes::ObjectPass> hull(passes::DrawnObject& object, const OutlineScene& line,
                                         const passes::LineStyle& style) {
  outline::HullOptions options;
  options.look = look_of(line);
  options.lean = static_cast<float>(line.lean);
  options.style = style;
  return std::make_unique<outline::HullPass>(object, options);
}

// The thinnest that a line of uneven width gets.
OutlineScene least_of(OutlineScene line) {
  const double part = line.method == M::Isophote ? 0.2 : std::max(0.25, 1 - line.style.wobble);
  line.width_px *= part, line.min_px *= part, line.max_px *= part;
  if (line.width_m) *line.width_m *= part;
  line.lean = 0;  // it closes gaps, also over what lies close behind
  return line;
}

std::unique_ptr<passes::ObjectPass> picture_lines(passes::StyledObject& styled, const mesh::Mesh& mesh,
                                                  const OutlineScene& line) {
  using Method = outline::PictureLinesOptions::Method;
  outline::PictureLinesOptions options;
  options.look = look_of(line);
  options.method = line.method == M::Silhouette  ? Method::Silhouette
                   : line.method == M::Laplacian ? Method::Laplacian
                                                 : Method::DepthNormals;
  options.depth_step_m = static_cast<float>(line.style.depth_step * radius_m(*styled.object, mesh));
  options.normal_deg = static_cast<float>(line.style.normal_deg);
  options.contrast = static_cast<float>(line.style.contrast);
  return std::make_unique<outline::PictureLinesPass>(*styled.object, *styled.passes.front(), options);
}

mesh::Texture brush_of(const LineStyleScene& style) {
  return style.brush.empty() ? outline::bristles() : read_stroke_image(style.brush);
}

// `brush` must outlive the options.
void press(const LineStyleScene& style, const mesh::Texture& brush, outline::StrokeOptions& options) {
  options.brush = &brush;
  options.brush_px = static_cast<float>(style.brush_px);
  options.stroke_px = static_cast<float>(style.stroke_px);
  options.gap = static_cast<float>(style.gap);
  options.pressure = static_cast<float>(style.pressure);
  options.dryness = static_cast<float>(style.dryness);
}

std::unique_ptr<passes::ObjectPass> strokes(passes::DrawnObject& object, const mesh::Mesh& mesh,
                                            const OutlineScene& line) {
  const LineStyleScene& style = line.style;
  outline::StrokeOptions options;
  options.look = look_of(line);
  options.taper_px = static_cast<float>(line.taper_px);
  mesh::Texture brush;
  if (line.method == M::Isophote) {
    options.outside = true;
    options.isophote = static_cast<float>(style.threshold);
    options.most_factor = static_cast<float>(style.most_factor);
  } else if (line.method == M::Wobble) {
    options.outside = true;
    options.wobble = static_cast<float>(style.wobble);
    options.wave_m = static_cast<float>(style.wave * radius_m(object, mesh));
    options.redraw_frames = style.redraw_frames;
  } else {
    brush = brush_of(style);
    press(style, brush, options);
  }
  return std::make_unique<outline::StrokePass>(object, mesh, mesh::topology(mesh), options);
}

// The lines that the user drew, as the brush draws them if there is one.
std::unique_ptr<passes::ObjectPass> drawn_lines(passes::DrawnObject& object, const mesh::Mesh& mesh,
                                                const OutlineScene& line) {
  outline::StrokeOptions options;
  options.lines = outline::StrokeOptions::Lines::Drawn;
  options.drawn = read_drawn_lines(line.style.drawn, mesh.triangles.size());
  options.look = look_of(line);
  options.taper_px = static_cast<float>(line.taper_px);
  mesh::Texture brush;
  if (line.method == M::Strokes) {
    brush = brush_of(line.style);
    press(line.style, brush, options);
  }
  return std::make_unique<outline::StrokePass>(object, mesh, mesh::topology(mesh), options);
}

// Strokes along what the scene takes for a line on the body, thinner than the contour.
outline::StrokeOptions along_features(outline::StrokeOptions::Lines lines, const OutlineScene& line,
                                      const InnerLinesScene& inner) {
  outline::StrokeOptions options;
  options.lines = lines;
  options.features = {inner.creases, inner.crease_deg, inner.materials, inner.cuts};
  options.look = thinner(look_of(line));
  return options;
}

std::unique_ptr<passes::ObjectPass> hidden_lines(passes::DrawnObject& object, const mesh::Mesh& mesh,
                                                 const OutlineScene& line, const InnerLinesScene& inner) {
  outline::StrokeOptions options = along_features(outline::StrokeOptions::Lines::All, line, inner);
  options.only_hidden = true;
  options.opacity = static_cast<float>(line.style.hidden);
  return std::make_unique<outline::StrokePass>(object, mesh, mesh::topology(mesh), options);
}

std::unique_ptr<passes::ObjectPass> inner_lines(passes::DrawnObject& object, const mesh::Mesh& mesh,
                                                const OutlineScene& line, const InnerLinesScene& inner) {
  outline::StrokeOptions options = along_features(outline::StrokeOptions::Lines::Inner, line, inner);
  options.hand = false;
  if (inner.width_px) options.look.width_px = static_cast<float>(*inner.width_px), options.look.width_m = 0;
  // Lighter than the contour, as those who classify lines draw them.
  options.look.colour = inner.colour ? colour(*inner.colour) : glm::mix(colour(line.colour), glm::vec3(0.5f), 0.35f);
  return std::make_unique<outline::StrokePass>(object, mesh, mesh::topology(mesh), options);
}

outline::WidthOptions width_options(const OutlineScene& line) {
  outline::WidthOptions options;
  options.kind = line.curvature;
  options.sign = line.sign;
  options.exaggeration = static_cast<float>(line.exaggeration);
  options.saturation = static_cast<float>(line.saturation);
  options.curve = static_cast<float>(line.curve);
  options.least = static_cast<float>(line.min_factor);
  options.smoothing = line.smoothing;
  return options;
}

// A line that neither curvature nor control points make uneven, in the form of those that they do.
class EvenWidths {
 public:
  explicit EvenWidths(std::size_t points) : ones_(points, 1.0f) {}
  std::span<const float> at(std::span<const glm::vec3>) const { return ones_; }
  void at(std::span<const glm::vec3>, std::span<const std::uint32_t> wanted, std::span<float> factors) const {
    for (const std::uint32_t p : wanted) factors[p] = 1;
  }

 private:
  std::vector<float> ones_;
};

// What the scene multiplies widths by, whatever the method.
class Weight {
 public:
  Weight(const LineWeightScene& scene, const LineSurroundings& around)
      : weights_(around.weights.begin(), around.weights.end()),
        shade_(static_cast<float>(scene.shade)),
        world_from_normal_(glm::transpose(glm::inverse(glm::dmat3(around.world_from_object)))),
        light_(glm::normalize(around.light)) {}

  float most() const {
    return (1 + shade_) * (weights_.empty() ? 1.0f : *std::max_element(weights_.begin(), weights_.end()));
  }
  void apply(std::span<const glm::vec3> normals, std::span<float> factors) const {
    for (std::uint32_t p = 0; p < factors.size(); ++p) factors[p] *= at(p, normals);
  }
  /// At some points, of which some are named several times.
  void apply(std::span<const glm::vec3> normals, std::span<const std::uint32_t> wanted, std::span<float> factors) {
    if (weights_.empty() && shade_ == 0) return;
    const std::span<const std::uint32_t> once = distinct(wanted, factors.size());
    for (const std::uint32_t p : once) factors[p] *= at(p, normals);
  }

 private:
  float at(std::uint32_t p, std::span<const glm::vec3> normals) const {
    const float painted = weights_.empty() ? 1.0f : weights_[p];
    if (shade_ == 0) return painted;
    const glm::vec3 normal = world_from_normal_ * normals[p];
    const float length = glm::length(normal);
    const float lit = length > 0 ? glm::dot(normal, light_) / length : 0.0f;
    return painted * (1 + shade_ * (1 - lit) / 2);
  }
  std::span<const std::uint32_t> distinct(std::span<const std::uint32_t> wanted, std::size_t points) {
    seen_.resize(points, 0);
    ++call_;
    once_.clear();
    once_.reserve(points);
    for (const std::uint32_t p : wanted) {
      if (seen_[p] != call_) once_.push_back(p);
      seen_[p] = call_;
    }
    return once_;
  }

  std::vector<float> weights_;
  float shade_;
  glm::mat3 world_from_normal_;
  glm::vec3 light_;
  std::vector<std::uint32_t> seen_, once_;  // per point: by which call
  std::uint32_t call_ = 0;
};

}  // namespace

void add_outline(passes::StyledObject& styled, const mesh::Mesh& mesh, const OutlineScene& line,
                 const passes::LineStyle& style) {
  passes::DrawnObject& object = *styled.object;
  // What lies over the body comes before it in the list.
  std::vector<std::unique_ptr<passes::ObjectPass>> over;
  std::unique_ptr<passes::ObjectPass> under;
  switch (line.method) {
    case M::Uniform:
    case M::Curvature:
    case M::Control:
    case M::ZLines:
      under = hull(object, line, style);
      break;
    case M::HiddenLines:
      under = hull(object, line, style);
      if (line.style.inner) over.push_back(hidden_lines(object, mesh, line, *line.style.inner));
      break;
    case M::Hull:
      under = std::make_unique<outline::InvertedHullPass>(object, mesh, look_of(line));
      break;
    case M::Silhouette:
      under = picture_lines(styled, mesh, line);
      break;
    case M::DepthNormals:
    case M::Laplacian:
      over.push_back(picture_lines(styled, mesh, line));
      break;
    case M::Facing:
      under = std::make_unique<outline::FacingPass>(
          object, outline::FacingOptions{static_cast<float>(line.style.threshold), colour(line.colour)});
      break;
    case M::Isophote:
    case M::Wobble:
      // Where the contour zigzags over small triangles strokes may leave a gap; a thin even line closes it.
      styled.passes.push_back(strokes(object, mesh, line));
      under = hull(object, least_of(line), style);
      break;
    case M::Strokes:
      over.push_back(strokes(object, mesh, line));
      break;
  }
  if (!line.style.drawn.empty()) over.push_back(drawn_lines(object, mesh, line));
  if (line.style.inner) over.push_back(inner_lines(object, mesh, line, *line.style.inner));
  for (auto& pass : over) styled.passes.insert(styled.passes.begin(), std::move(pass));
  if (under) styled.passes.push_back(std::move(under));
}

passes::LineStyle line_style(const mesh::Mesh& mesh, const OutlineScene& line, const LineSurroundings& around,
                             std::vector<float>& factors) {
  passes::LineStyle style;
  style.taper_px = static_cast<float>(line.taper_px);
  const bool follows = line.method == M::Curvature || line.method == M::Control;
  if (!follows && !line.weight.any()) return style;
  const mesh::Topology topology = mesh::topology(mesh);
  if (follows && line.exaggeration > 0 && line.thickness_part > 0) {
    style.most_added_m = outline::local_thickness(topology);
    const double unit_m = std::cbrt(std::abs(glm::determinant(glm::dmat3(around.world_from_object))));
    for (float& t : style.most_added_m) t *= static_cast<float>(line.thickness_part * unit_m);
  }
  const auto weight = std::make_shared<Weight>(line.weight, around);
  const auto follow = [&](auto widths) {
    if (around.moves) {
      style.most_factor = (follows ? 1 + static_cast<float>(line.exaggeration) : 1.0f) * weight->most();
      style.follow = [widths, weight](const passes::LineStyle::Moved& now) {
        widths->at(now.points, now.wanted, now.factors);
        weight->apply(now.outline_normals, now.wanted, now.factors);
      };
      return;
    }
    const std::span<const float> found = widths->at(topology.points);
    factors.assign(found.begin(), found.end());
    weight->apply(topology.outline_normals, factors);
    style.factors = factors;
  };
  if (line.method == M::Curvature) {
    follow(std::make_shared<outline::CurvatureWidths>(topology, width_options(line)));
  } else if (line.method == M::Control) {
    follow(std::make_shared<outline::ControlWidths>(control_widths(line, topology, around.world_from_object)));
  } else {
    follow(std::make_shared<EvenWidths>(topology.points.size()));
  }
  return style;
}

}  // namespace rinkaku::pipeline

#pragma once

#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>

#include "mesh/bounds.h"
#include "mesh/mesh.h"
#include "outline/fluffy/frame.h"
#include "outline/fluffy/moving_frame.h"
#include "outline/fluffy/transmission.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/passes/line_strips.h"
#include "pipeline/scene/light.h"
#include "pipeline/scene/object.h"

namespace rinkaku::pipeline {

/// What of an object's fluff needs no GL.
struct Fluff {
  fluffy::Frame frame;
  std::optional<fluffy::MovingFrame> moving;  ///< the same, if the object is animated
  fluffy::TransmissionImage image;
};

/// Precondition: the object has fluff. Throws Error (Input).
Fluff prepare_fluff(const ObjectScene& object, const mesh::Mesh& mesh, const glm::dmat4& world_from_object);

/// Lets the outline fade where fluff grows, unless the line is to run there. `factors` are what `style` refers to where
/// the line's width doesn't follow movement; empty stands for 1 everywhere.
/// Precondition: the object has fluff and an outline.
void thin_line_under_fluff(passes::LineStyle& style, std::vector<float>& factors, const ObjectScene& object,
                           const mesh::Mesh& mesh);

/// Adds the pass that draws it, after all of the object's other passes have been added: where the line is to be over
/// the fluff, the fluff is drawn before them, else after them. Needs a GL context.
void add_fluff(passes::StyledObject& styled, const Fluff& fluff, const ObjectScene& object, const LightScene& light);

/// A box that holds an object and its fluff, in the object's coordinates as `body` is.
mesh::Box with_fluff(const mesh::Box& body, const Fluff& fluff, const glm::dmat4& world_from_object);

}  // namespace rinkaku::pipeline

#pragma once

#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>

#include "mesh/mesh.h"
#include "outline/fluffy/frame.h"
#include "outline/fluffy/transmission.h"
#include "pipeline/passes/pass.h"
#include "pipeline/scene/light.h"
#include "pipeline/scene/object.h"

namespace rinkaku::pipeline {

/// What of an object's fluff needs no GL.
struct Fluff {
  fluffy::Frame frame;
  fluffy::TransmissionImage image;
};

/// Precondition: the object has fluff. Throws Error (Input).
Fluff prepare_fluff(const ObjectScene& object, const mesh::Mesh& mesh, const glm::dmat4& world_from_object);

/// Lets the outline fade where fluff grows, unless the line is to run there: factors of the line's width at each welded
/// point. Precondition: the object has fluff and an outline. `factors` may be empty, which stands for 1 everywhere.
void thin_line_under_fluff(std::vector<float>& factors, const ObjectScene& object, const mesh::Mesh& mesh);

/// Whether the fluff is drawn before the rest of its object, so that the line is over it.
bool fluff_is_under_line(const ObjectScene& object);

/// The pass that draws it. Needs a GL context.
std::unique_ptr<passes::ObjectPass> make_fluffy_pass(passes::DrawnObject& drawn, const Fluff& fluff,
                                                     const ObjectScene& object, const LightScene& light);

}  // namespace rinkaku::pipeline

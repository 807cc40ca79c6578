#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "water/arrows.h"
#include "water/reference_picture.h"
#include "water/stroke_size.h"
#include "water/surface.h"

namespace rinkaku::water {

/// Water that fills a picture of 400 x 400, seen from a bank.
struct River {
  /// Looking along +y, so many degrees down, from 3 m above the water.
  explicit River(double down_deg);
  void set_arrows(std::span<const std::array<double, 4>> px);
  Outlook outlook() const { return {camera, camera_from_world}; }

  CameraModel camera{400, 400, 360, 360, 199.5, 199.5, {}};
  RigidTransform camera_from_world;
  std::unique_ptr<Surface> surface;
  std::vector<ArrowKey> arrows;
};

/// Two shores, inflow on the left, outflow on the right.
River river_scene();
/// A pond in which water turns, without inflow, seen steeply.
River pond_scene();

/// What such water mirrors: trees and clouds all around, made of noise.
ReferencePicture reference_of(const River& river);

}  // namespace rinkaku::water

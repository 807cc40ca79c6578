#include "water/verify/scenes.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "water/scatter.h"

namespace rinkaku::water {

namespace {

// What is mirrored: trees and clouds all around, made of noise.
Picture surroundings() {
  Picture p;
  p.width_px = 512, p.height_px = 256;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 512; ++x) {
      const double tree = scattered(static_cast<std::uint64_t>(x / 8), 1);
      const double shade = 0.3 + 0.7 * scattered(static_cast<std::uint64_t>(x / 4 + 1000 * (y / 4)), 2);
      const double cloud = scattered(static_cast<std::uint64_t>(x / 24 + 1000 * (y / 10)), 3);
      const bool sky = y < 20 + 95 * tree;
      p.samples.push_back(static_cast<std::uint8_t>(sky ? 120 + 130 * cloud : 90 * shade));
      p.samples.push_back(static_cast<std::uint8_t>(sky ? 170 + 80 * cloud : 150 * shade));
      p.samples.push_back(static_cast<std::uint8_t>(sky ? 230 + 20 * cloud : 70 * shade));
    }
  }
  return p;
}

}  // namespace

River::River(double down_deg) {
  const double tilt = std::numbers::pi / 2 + down_deg * std::numbers::pi / 180;
  const glm::dmat3 turn(glm::dvec3(1, 0, 0), glm::dvec3(0, std::cos(tilt), std::sin(tilt)),
                        glm::dvec3(0, -std::sin(tilt), std::cos(tilt)));
  camera_from_world.rotation = glm::normalize(glm::quat_cast(turn));
  camera_from_world.translation_m = -(camera_from_world.rotation * glm::dvec3(0, 0, 3));
}
void River::set_arrows(std::span<const std::array<double, 4>> px) {
  ArrowKey key;
  for (const auto& a : px) {
    key.arrows.push_back(arrow_from_screen("bench", *surface, camera, camera_from_world, {a[0], a[1]}, {a[2], a[3]}));
  }
  arrows.push_back(key);
}
River river_scene() {
  River river(35);
  SurfaceOutline outline;
  outline.corners = {{-6, 1.5, 0}, {6, 1.5, 0}, {8, 5, 0}, {9, 9, 0}, {2, 8.2, 0}, {-3, 9.4, 0}, {-9, 9, 0}};
  outline.open_edges = {2, 6, 1};
  river.surface = std::make_unique<Surface>("bench", outline, glm::dvec3(0, 0, 3));
  river.set_arrows(std::array<std::array<double, 4>, 12>{{{30, 330, 90, 335},
                                                          {150, 340, 215, 330},
                                                          {280, 345, 350, 360},
                                                          {60, 240, 110, 250},
                                                          {170, 260, 225, 240},
                                                          {290, 240, 345, 255},
                                                          {40, 160, 70, 165},
                                                          {130, 150, 165, 140},
                                                          {220, 165, 255, 160},
                                                          {320, 150, 350, 160},
                                                          {100, 100, 118, 98},
                                                          {280, 98, 300, 102}}});
  return river;
}

River pond_scene() {
  River pond(55);
  SurfaceOutline outline;
  for (int i = 0; i < 12; ++i) {
    const double a = 2 * std::numbers::pi * i / 12;
    outline.corners.emplace_back(1.9 * std::cos(a), 2.2 + 1.7 * std::sin(a), 0);
  }
  pond.surface = std::make_unique<Surface>("bench", outline, glm::dvec3(0, 0, 3));
  pond.set_arrows(std::array<std::array<double, 4>, 6>{{{90, 230, 100, 280},
                                                        {130, 320, 180, 345},
                                                        {250, 340, 295, 310},
                                                        {320, 260, 318, 210},
                                                        {290, 150, 255, 125},
                                                        {170, 120, 130, 145}}});
  return pond;
}

ReferencePicture reference_of(const River& river) {
  ReferencePicture reference;
  MirrorOptions mirror;
  mirror.sky.panorama = surroundings();
  reference.paint(*river.surface, river.camera, river.camera_from_world, mirror, nullptr, nullptr, 1, 2);
  return reference;
}

}  // namespace rinkaku::water

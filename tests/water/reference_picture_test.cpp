#include "water/reference_picture.h"

#include <gtest/gtest.h>

#include "tests/water/waters.h"

namespace rinkaku::test {
namespace {

using water::MirrorOptions;
using water::Picture;
using water::ReferencePicture;

TEST(ReferencePicture, AMirroredEyeSeesAPointWhereItsMirrorImageIsSeen) {
  const water::Surface s("test", {{{-3, 0, 0.4}, {3, 0, 0.4}, {3, 6, 0.4}, {-3, 6, 0.4}}, {}, {}}, {0, 0, 5});
  const CameraModel camera = square_camera();
  const RigidTransform pose = looking_down(2, 20);
  const water::MirroredEye eye = water::mirrored_eye(s, camera, pose);
  for (const glm::dvec3& p : {glm::dvec3(0.3, 5, 1.5), glm::dvec3(-1, 4, 0.7)}) {
    const glm::dvec3 image(p.x, p.y, 0.8 - p.z);
    const glm::dvec2 seen = seen_at(camera, pose, image), mirrored = seen_at(eye.camera, eye.camera_from_world, p);
    EXPECT_NEAR(mirrored.x, camera.width_px - 1 - seen.x, 1e-9);
    EXPECT_NEAR(mirrored.y, seen.y, 1e-9);
  }
}

TEST(ReferencePicture, AMirrorShowsTheSkyInTheMirroredDirection) {
  const water::Surface s = flat(rectangle(100, 100));
  const CameraModel camera = square_camera(200, 180);
  const RigidTransform pose = looking_down(2, 25);
  MirrorOptions options;
  options.reflection = 1;
  options.water_colour = {0, 0, 0};
  // A panorama whose red tells the height above the horizon.
  options.sky.panorama.width_px = 4, options.sky.panorama.height_px = 181;
  for (int y = 0; y <= 180; ++y) {
    for (int x = 0; x < 4; ++x)
      options.sky.panorama.samples.insert(options.sky.panorama.samples.end(),
                                          {static_cast<std::uint8_t>(y <= 90 ? 90 - y : 0), 200, 0});
  }
  ReferencePicture reference;
  reference.paint(s, camera, pose, options, nullptr, nullptr, 1, 1);
  const glm::dvec2 pixel(100, 150);
  const glm::dvec3 ray = glm::normalize(inverse(pose).rotation * glm::dvec3(to_normalised(camera, pixel), 1.0));
  const glm::vec3 seen = reference.at(pixel);
  // Share and all: red over green is the elevation.
  EXPECT_NEAR(seen.r / seen.g * 200, std::asin(-ray.z) * 180 / std::acos(-1.0),
              0.6);  // the panorama's step is a degree
}

TEST(ReferencePicture, TheFilmedPictureIsMirroredWhereItShowsTheSurroundings) {
  const water::Surface s = flat(rectangle(100, 100));
  const CameraModel camera = square_camera(200, 180);
  const RigidTransform pose = looking_down(2, 0);  // the horizon is the middle row
  MirrorOptions options;
  options.reflection = 1;
  options.water_colour = {0, 0, 0};
  options.surroundings_m = 1e5;
  Picture plate;
  plate.width_px = plate.height_px = 200;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x)
      plate.samples.insert(plate.samples.end(), {static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(x), 200});
  }
  ReferencePicture reference;
  reference.paint(s, camera, pose, options, &plate, nullptr, 1, 1);
  // Far things are mirrored at the horizon: row 99.5 + d shows row 99.5 - d, the same column.
  const glm::vec3 seen = reference.at({60, 139});
  EXPECT_NEAR(seen.r / seen.b * 200, 60, 1);
  EXPECT_NEAR(seen.g / seen.b * 200, 60, 1);
}

TEST(ReferencePicture, MirroredObjectsLieOverTheRest) {
  const water::Surface s = flat(rectangle(100, 100));
  const CameraModel camera = square_camera(200, 180);
  const RigidTransform pose = looking_down(2, 25);
  MirrorOptions options;
  options.reflection = 1;
  options.water_colour = {0, 0, 0};
  Picture objects;
  objects.width_px = objects.height_px = 200, objects.channels = 4;
  objects.samples.assign(200 * 200 * 4, 0);
  const int x = 40, y = 150;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      std::uint8_t* at = objects.samples.data() + ((y + dy) * 200 + 199 - x + dx) * 4;  // it is turned left to right
      at[0] = 255, at[3] = 255;
    }
  }
  ReferencePicture with, without;
  with.paint(s, camera, pose, options, nullptr, &objects, 1, 1);
  without.paint(s, camera, pose, options, nullptr, nullptr, 1, 1);
  EXPECT_EQ(with.at({x, y}).g, 0);
  EXPECT_GT(with.at({x, y}).r, 0.3);
  EXPECT_EQ(with.at({120, 150}), without.at({120, 150}));
}

TEST(ReferencePicture, AnEyeInThePlaneGivesNoNonsense) {
  const water::Surface s = flat(rectangle(10, 10));
  for (const double height : {0.0, 1e-9, -1.0}) {
    ReferencePicture reference;
    reference.paint(s, square_camera(64, 60), looking_down(height, 10), {}, nullptr, nullptr, 1, 2);
    for (const glm::vec3& c : reference.samples()) {
      for (int i = 0; i < 3; ++i) ASSERT_TRUE(c[i] >= 0 && c[i] <= 1);
    }
  }
}

}  // namespace
}  // namespace rinkaku::test

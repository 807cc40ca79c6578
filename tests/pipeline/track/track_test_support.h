#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/error.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/rigid_transform.h"
#include "pipeline/track/board.h"

namespace rinkaku::track::test {

/// A frame that shows an 8-bit grey picture; keeps the picture alive.
Frame grey_frame(const cv::Mat& grey, std::int64_t number = 0, Rational time_base = {1, 30});

glm::dvec2 project(const CameraModel& camera, const RigidTransform& camera_from_world, const glm::dvec3& point);

/// Root mean square distance in pixels at which two poses show the board's corners.
double corner_distance_px(const CameraModel& camera, const Board& board, const RigidTransform& a,
                          const RigidTransform& b);

double angle_deg(const glm::dquat& a, const glm::dquat& b);

/// A camera that looks at `centre` from `distance`, its line of sight `tilt` off the board's normal, seen from azimuth
/// `around`, and rolled by `roll`; all radians.
RigidTransform view_of(const glm::dvec3& centre, double distance, double tilt, double around, double roll);

struct RenderOptions {
  double noise = 2;      ///< grey levels, standard deviation
  double blur_px = 0.6;  ///< standard deviation
  unsigned seed = 1;
};

/// What a camera sees of a flat board on a grey wall: every pixel is traced through the lens to the board's plane, 4 x
/// 4 samples a pixel. Independent of the detector and of warpPerspective.
cv::Mat render(const CameraModel& camera, const Board& board, const RigidTransform& camera_from_world,
               const RenderOptions& options = {});

/// A 640x480 camera of 54 degrees with a lens like a webcam's.
CameraModel webcam();

std::filesystem::path write(const std::filesystem::path& file, const std::string& text);

/// The message of the input Error that `f` throws; empty if it throws none.
template <typename F>
std::string refusal(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_status(), 2) << error.what();
    return error.what();
  }
  return {};
}

#define EXPECT_REFUSED(expression, part)                                                     \
  do {                                                                                       \
    const std::string message = rinkaku::track::test::refusal([&] { (void)(expression); });  \
    EXPECT_NE(message.find(part), std::string::npos) << #expression << " said: " << message; \
  } while (false)

}  // namespace rinkaku::track::test

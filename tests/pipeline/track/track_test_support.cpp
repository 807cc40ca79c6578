#include "tests/pipeline/track/track_test_support.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>

namespace rinkaku::track::test {

Frame grey_frame(const cv::Mat& grey, std::int64_t number, Rational time_base) {
  Frame frame;
  frame.number = number;
  frame.pts = number;
  frame.time_base = time_base;
  frame.format.width_px = grey.cols;
  frame.format.height_px = grey.rows;
  frame.format.pixels = {"gray", ColourModel::Grey, 1, 1, false, false, 0, 0, {}};
  set_plane_sizes(frame);
  auto kept = std::make_shared<cv::Mat>(grey);
  frame.planes[0].data = kept->data;
  frame.planes[0].stride_bytes = static_cast<std::ptrdiff_t>(kept->step);
  frame.storage = std::shared_ptr<void>(kept, kept->data);
  return frame;
}

glm::dvec2 project(const CameraModel& camera, const RigidTransform& camera_from_world, const glm::dvec3& point) {
  const glm::dvec3 p = camera_from_world * point;
  return to_pixels(camera, distort(camera, {p.x / p.z, p.y / p.z}));
}

double corner_distance_px(const CameraModel& camera, const Board& board, const RigidTransform& a,
                          const RigidTransform& b) {
  double sum = 0;
  for (const BoardMarker& marker : board.markers) {
    for (const glm::dvec3& corner : marker.corners_m) {
      const glm::dvec2 d = project(camera, a, corner) - project(camera, b, corner);
      sum += glm::dot(d, d);
    }
  }
  return std::sqrt(sum / (4.0 * static_cast<double>(board.markers.size())));
}

double angle_deg(const glm::dquat& a, const glm::dquat& b) {
  return 2 * std::acos(std::min(1.0, std::abs(glm::dot(a, b)))) * 180 / M_PI;
}

RigidTransform view_of(const glm::dvec3& centre, double distance, double tilt, double around, double roll) {
  // At tilt 0 the camera looks along the board's -z; board y is up in the picture: the camera's axes are x, -y, -z.
  const glm::dquat facing = glm::angleAxis(M_PI, glm::dvec3(1, 0, 0));
  const glm::dquat tilted = glm::angleAxis(tilt, glm::dvec3(std::cos(around), std::sin(around), 0));
  RigidTransform pose;
  pose.rotation = glm::normalize(glm::angleAxis(roll, glm::dvec3(0, 0, 1)) * facing * tilted);
  pose.translation_m = glm::dvec3(0, 0, distance) - pose.rotation * centre;
  return pose;
}

cv::Mat render(const CameraModel& camera, const Board& board, const RigidTransform& camera_from_world,
               const RenderOptions& options) {
  struct Printed {
    glm::dvec3 top_left, middle, right, down;  // right and down divided by their squared lengths
    double radius;
    cv::Mat cells;
  };
  std::vector<Printed> printed;
  if (!board.dictionary.empty()) {
    static const std::vector<std::pair<std::string, int>> numbers = {{"ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL},
                                                                     {"4X4_50", cv::aruco::DICT_4X4_50},
                                                                     {"APRILTAG_36h11", cv::aruco::DICT_APRILTAG_36h11},
                                                                     {"5X5_100", cv::aruco::DICT_5X5_100}};
    for (const auto& [name, number] : numbers) {
      if (name != board.dictionary) continue;
      const auto dictionary = cv::aruco::getPredefinedDictionary(number);
      for (const BoardMarker& marker : board.markers) {
        cv::Mat cells;
        cv::aruco::drawMarker(dictionary, marker.id, dictionary->markerSize + 2, cells);
        const auto& c = marker.corners_m;
        const glm::dvec3 right = c[1] - c[0], down = c[3] - c[0];
        printed.push_back({c[0], (c[0] + c[2]) * 0.5, right / glm::dot(right, right), down / glm::dot(down, down),
                           glm::distance(c[0], c[2]) / 2, cells});
      }
    }
  }
  const auto brightness = [&](const glm::dvec3& p) {
    for (const Printed& print : printed) {
      if (std::abs(p.x - print.middle.x) > print.radius || std::abs(p.y - print.middle.y) > print.radius) continue;
      const double u = glm::dot(p - print.top_left, print.right), v = glm::dot(p - print.top_left, print.down);
      if (u < 0 || u >= 1 || v < 0 || v >= 1) continue;
      const int n = print.cells.cols;
      return print.cells.at<std::uint8_t>(static_cast<int>(v * n), static_cast<int>(u * n)) ? 200.0 : 40.0;
    }
    if (board.square_m > 0 && p.x >= 0 && p.y >= 0) {
      const int column = static_cast<int>(p.x / board.square_m), up = static_cast<int>(p.y / board.square_m);
      if (column < board.columns && up < board.rows) return (board.rows - 1 - up + column) % 2 == 0 ? 40.0 : 200.0;
    }
    return 200.0;
  };
  const RigidTransform world_from_camera = inverse(camera_from_world);
  const double limit = max_undistorted_radius(camera);
  cv::Mat picture(camera.height_px, camera.width_px, CV_32F, cv::Scalar(0));
  constexpr int samples = 4;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      // Undistorted once a pixel; within a pixel the lens is linear.
      const auto middle = undistort(camera, to_normalised(camera, {x, y}), limit);
      const auto at = [&](double dx, double dy) {
        const glm::dvec3 ray =
            world_from_camera.rotation * glm::dvec3(middle->x + dx / camera.fx_px, middle->y + dy / camera.fy_px, 1);
        const double along = -world_from_camera.translation_m.z / ray.z;
        return along > 0 ? brightness(world_from_camera.translation_m + along * ray) : 200.0;
      };
      if (!middle) continue;
      // Where a pixel's corners agree, no edge runs through it.
      double sum = at(-0.5, -0.5) * samples * samples;
      if (at(0.5, -0.5) * samples * samples != sum || at(-0.5, 0.5) * samples * samples != sum ||
          at(0.5, 0.5) * samples * samples != sum) {
        sum = 0;
        for (int s = 0; s < samples * samples; ++s) {
          sum += at((s % samples + 0.5) / samples - 0.5, (s / samples + 0.5) / samples - 0.5);
        }
      }
      picture.at<float>(y, x) = static_cast<float>(sum / (samples * samples));
    }
  }
  if (options.blur_px > 0) cv::GaussianBlur(picture, picture, {}, options.blur_px);
  cv::RNG random(options.seed);
  cv::Mat noise(picture.size(), CV_32F);
  random.fill(noise, cv::RNG::NORMAL, 0, options.noise);
  picture += noise;
  cv::Mat grey;
  picture.convertTo(grey, CV_8U);
  return grey;
}

CameraModel webcam() {
  CameraModel camera{640, 480, 628, 627, 322, 251, {}};
  camera.distortion = {-0.21, 0.09, 0.002, -0.001, 0.01};
  return camera;
}

std::filesystem::path write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

}  // namespace rinkaku::track::test

// The main job on the recordings that the repository ships, against their truth.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "pipeline/objects/drawing.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/pipeline.h"
#include "pipeline/set_up.h"

namespace rinkaku::pipeline {
namespace {

const std::filesystem::path recordings = std::filesystem::path(RINKAKU_SOURCE_DIR) / "recordings";

// The object's shape in the whole pinhole picture: 255 where it covers at least half of a pixel.
cv::Mat shape(const passes::Layer& layer, const PictureFormat& format) {
  cv::Mat mask = cv::Mat::zeros(format.height_px, format.width_px, CV_8U);
  for (int y = 0; y < layer.rect.height_px; ++y) {
    for (int x = 0; x < layer.rect.width_px; ++x) {
      const auto alpha = layer.rgba[(static_cast<std::size_t>(y) * layer.rect.width_px + x) * 4 + 3];
      if (alpha >= 128) mask.at<std::uint8_t>(layer.rect.y_px + y, layer.rect.x_px + x) = 255;
    }
  }
  return mask;
}

cv::Mat border(const cv::Mat& mask) {
  cv::Mat eroded;
  cv::erode(mask, eroded, cv::Mat(), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  return mask - eroded;
}

// Mean distance of one shape's border pixels from the other's border, pixels.
double mean_distance_px(const cv::Mat& from, const cv::Mat& to) {
  cv::Mat distance;
  cv::distanceTransform(255 - border(to), distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return cv::mean(distance, border(from))[0];
}

TEST(Recordings, DeskObjectTrackedByTheBoardLiesWhereTheTrueCameraSeesIt) {
  RenderOptions options;
  options.output = "unused.mp4";
  const Prepared tracked = prepare(read_scene(recordings / "desk" / "scene.toml"), options);
  Scene scene = tracked.scene;
  scene.track->from = PoseFileTrack{recordings / "desk" / "poses.csv"};
  scene.track->smoothing.on = false;
  Prepared truth = tracked;
  truth.scene = scene;
  truth.plan = make_plan(scene, &*truth.camera, {});

  const auto source = open_source(tracked);
  const PictureFormat& format = source->description().format;
  const auto by_board = make_tracker(tracked, source->description());
  const auto by_truth = make_tracker(truth, source->description());
  Drawing drawing = make_drawing(scene, {0, 0, format.width_px, format.height_px});
  passes::Layer layer;
  double sum_px = 0, worst_px = 0;
  int frames = 0;
  while (const std::optional<Frame> frame = source->next()) {
    const auto measured = by_board->track(*frame), exact = by_truth->track(*frame);
    ASSERT_TRUE(measured && exact) << "frame " << frame->number;
    ASSERT_TRUE(drawing.renderer->draw({*truth.camera, measured->camera_from_world}, layer));
    const cv::Mat seen = shape(layer, format);
    ASSERT_TRUE(drawing.renderer->draw({*truth.camera, exact->camera_from_world}, layer));
    const double distance_px = mean_distance_px(seen, shape(layer, format));
    sum_px += distance_px;
    worst_px = std::max(worst_px, distance_px);
    ++frames;
  }
  EXPECT_EQ(frames, 150);
  // A pixel, mean over frames, is what an eye on the film may notice; single frames blur by more than 2.
  EXPECT_LT(sum_px / frames, 1.0);
  EXPECT_LT(worst_px, 2.0);
  RecordProperty("mean_distance_px", std::to_string(sum_px / frames));
  RecordProperty("worst_distance_px", std::to_string(worst_px));
}

}  // namespace
}  // namespace rinkaku::pipeline

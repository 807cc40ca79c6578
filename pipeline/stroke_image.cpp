#include "pipeline/stroke_image.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/frame/error.h"

namespace rinkaku::pipeline {
namespace {

cv::Mat ink_of(const std::filesystem::path& file) {
  cv::Mat picture;
  try {
    picture = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {  // of a size that OpenCV refuses
  }
  if (picture.empty()) throw input_error(file.string(), "is no picture", "give a PNG or JPEG file of a stroke");
  if (picture.depth() == CV_16U) picture.convertTo(picture, CV_8U, 1 / 257.0);
  if (picture.depth() != CV_8U) {
    throw input_error(file.string(), "is no picture of 8 or 16 bits a channel", "save it as an 8-bit PNG");
  }
  cv::Mat ink;
  if (picture.channels() == 4) {
    cv::extractChannel(picture, ink, 3);
    double least = 0;
    cv::minMaxLoc(ink, &least);
    if (least < 255) return ink;
    cv::cvtColor(picture, picture, cv::COLOR_BGRA2GRAY);
  } else if (picture.channels() == 3) {
    cv::cvtColor(picture, picture, cv::COLOR_BGR2GRAY);
  }
  return 255 - picture;
}

}  // namespace

mesh::Texture read_stroke_image(const std::filesystem::path& file) {
  const cv::Mat ink = ink_of(file);
  mesh::Texture image;
  image.width_px = ink.cols, image.height_px = ink.rows;
  image.rgba.assign(ink.total() * 4, 0);
  for (int y = 0; y < ink.rows; ++y) {
    for (int x = 0; x < ink.cols; ++x) {
      image.rgba[(static_cast<std::size_t>(y) * ink.cols + x) * 4 + 3] = ink.at<std::uint8_t>(y, x);
    }
  }
  return image;
}

}  // namespace rinkaku::pipeline

#include "pipeline/picture_file.h"

#include <string>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/track/opencv_quiet.h"

namespace rinkaku::pipeline {

mesh::Texture read_picture(const std::filesystem::path& file) {
  const cv::Mat picture = track::with_opencv([&] { return cv::imread(file.string(), cv::IMREAD_COLOR); },
                                             [](const std::string&) { return cv::Mat(); });  // e.g. too large
  if (picture.empty()) {
    throw input_error(file.string(), "it can't be read as a picture", "give a PNG, JPEG, TIFF or WebP file");
  }
  cv::Mat rgba;
  cv::cvtColor(picture, rgba, cv::COLOR_BGR2RGBA);
  mesh::Texture texture;
  texture.width_px = rgba.cols;
  texture.height_px = rgba.rows;
  texture.rgba.assign(rgba.datastart, rgba.dataend);
  return texture;
}

}  // namespace rinkaku::pipeline

#include "apps/rinkaku/grey_image.h"

#include <filesystem>

#include <opencv2/imgcodecs.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/track/opencv_quiet.h"

namespace rinkaku::app {
namespace {

cv::Mat read_picture(const std::string& path) {
  if (!std::filesystem::exists(path)) throw input_error(path, "there is no such file", "check the name");
  const cv::Mat picture = track::with_opencv([&] { return cv::imread(path, cv::IMREAD_UNCHANGED); },
                                             [](const std::string&) { return cv::Mat(); });  // e.g. too large
  if (picture.empty()) throw input_error(path, "it can't be read as a picture", "give a PNG, TIFF or JPEG file");
  return picture;
}

}  // namespace

matte::GreyMatte read_grey(const std::string& path) {
  const cv::Mat picture = read_picture(path);
  const double largest = picture.depth() == CV_8U ? 255 : picture.depth() == CV_16U ? 65535 : 0;
  if (largest == 0) throw input_error(path, "has neither 8 nor 16 bits a channel", "convert it to PNG");
  cv::Mat grey;
  if (picture.channels() == 4) {
    cv::extractChannel(picture, grey, 3);
  } else {
    cv::extractChannel(picture, grey, 0);
    for (int channel = 1; channel < picture.channels(); ++channel) {
      cv::Mat other;
      cv::extractChannel(picture, other, channel);
      if (cv::countNonZero(other != grey) > 0) {
        throw input_error(path, "is a colour picture without alpha", "give a grey one, or one with an alpha channel");
      }
    }
  }
  cv::Mat alpha;
  grey.convertTo(alpha, CV_32F, 1 / largest);
  return {alpha.cols, alpha.rows, std::vector<float>(alpha.begin<float>(), alpha.end<float>())};
}

std::string png_bytes(const std::string& path, int width_px, int height_px, const std::uint8_t* grey) {
  const cv::Mat picture(height_px, width_px, CV_8U, const_cast<std::uint8_t*>(grey));
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", picture, bytes)) throw runtime_failure(path, "the PNG could not be made");
  return {bytes.begin(), bytes.end()};
}

}  // namespace rinkaku::app

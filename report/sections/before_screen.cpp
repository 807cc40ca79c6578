#include "report/sections/before_screen.h"

#include <algorithm>
#include <cstdint>

#include <opencv2/core.hpp>

#include "pipeline/matte/picture.h"

namespace rinkaku::report {

Frame before_screen(const Frame& frame, const Frame& clean, const Matte& truth) {
  matte::PictureReader reader, clean_reader;
  const matte::Picture& picture = reader.read(frame);
  const cv::Mat room = matte::recoded(clean_reader.read(clean), picture.ycc_from_rgb);
  FramePool pool;
  Frame out = pool.allocate(frame.format);
  out.number = frame.number;
  const int width = frame.format.width_px, height = frame.format.height_px;
  cv::Mat mixed(height, width, CV_32FC3);
  for (int y = 0; y < height; ++y) {
    const float light = 1.15f - 0.3f * static_cast<float>(y) / static_cast<float>(height);
    const cv::Vec3f screen(16 + 110 * light, 128 - 45 * light, 128 - 55 * light);
    for (int x = 0; x < width; ++x) {
      const float rest = 1 - static_cast<float>(truth.alpha_row(y)[x]) / 255;
      mixed.at<cv::Vec3f>(y, x) = picture.ycc(x, y) + rest * (screen - room.at<cv::Vec3f>(y, x));
      if (rest > 0.999f) mixed.at<cv::Vec3f>(y, x) = screen;
    }
  }
  const auto level = [](float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 255.f) + 0.5f); };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const cv::Vec3f& c = mixed.at<cv::Vec3f>(y, x);
      out.planes[0].data[y * out.planes[0].stride_bytes + x] = level(c[0]);
      if (y % 2 != 0 || x % 2 != 0) continue;
      const cv::Vec3f mean = 0.25f * (c + mixed.at<cv::Vec3f>(y, x + 1) + mixed.at<cv::Vec3f>(y + 1, x) +
                                      mixed.at<cv::Vec3f>(y + 1, x + 1));
      out.planes[1].data[y / 2 * out.planes[1].stride_bytes + x / 2] = level(mean[1]);
      out.planes[2].data[y / 2 * out.planes[2].stride_bytes + x / 2] = level(mean[2]);
    }
  }
  return out;
}

}  // namespace rinkaku::report

#pragma once

#include <cstdio>
#include <string>

#include <opencv2/core.hpp>

namespace rinkaku::recordings {

/// How the sensor and the camera's electronics turn light into a picture.
struct FilmOptions {
  float exposure = 1;
  float vignette = 0.25f;    ///< light lost in the corners
  float electrons = 3500;    ///< at white: shot noise is its root
  float read_electrons = 6;  ///< standard deviation
  unsigned seed = 1;
};

/// Linear RGB light to non-linear RGB in [0, 1]: vignette, noise (a function of seed, frame and pixel), the tone curve.
cv::Mat3f develop(const cv::Mat3f& light, const FilmOptions& options, int frame);

/// Non-linear RGB to limited-range BT.709 in planar 4:2:0, chroma sited left as MPEG has it.
cv::Mat1b to_yuv420(const cv::Mat3f& rgb);
/// Non-linear RGB to 8-bit BGR, for image files.
cv::Mat3b to_bgr(const cv::Mat3f& rgb);

/// Writes raw pictures of one layout to the ffmpeg program, which encodes them into `file`; the same bytes come out
/// every time.
class Encoder {
 public:
  enum class Kind { Video, Matte };
  Encoder(const std::string& file, int width_px, int height_px, double rate, Kind kind, int quality);
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  void write(const cv::Mat1b& picture);
  void finish();

 private:
  std::FILE* pipe_ = nullptr;
  std::string file_;
};

}  // namespace rinkaku::recordings

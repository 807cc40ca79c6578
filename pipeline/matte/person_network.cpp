#include "pipeline/matte/person_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/matte/count.h"

namespace rinkaku::matte {
namespace {

namespace fs = std::filesystem;

const std::array<cv::Size, 3> sizes{cv::Size(256, 144), cv::Size(192, 192), cv::Size(144, 256)};

// OpenCV writes what it finds wrong with a file to standard error by itself; the Error says it in one line.
class SilentOpenCv {
 public:
  SilentOpenCv() : before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~SilentOpenCv() { cv::utils::logging::setLogLevel(before_); }
  SilentOpenCv(const SilentOpenCv&) = delete;
  SilentOpenCv& operator=(const SilentOpenCv&) = delete;

 private:
  cv::utils::logging::LogLevel before_;
};

// A part of a plane, stretched.
void stretch(const cv::Mat& plane, const cv::Rect& part, const cv::Size& size, cv::Mat& out) {
  const bool shrinks = part.width > size.width && part.height > size.height;
  cv::resize(plane(part), out, size, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
}

}  // namespace

struct PersonNetwork::State {
  struct AtSize {
    cv::dnn::Net net;
    cv::Mat input, output;
  };
  std::array<AtSize, sizes.size()> at;
  cv::Mat y, cb, cr;

  void fill(const Picture& picture, const cv::Size& size, cv::Mat& input) const;
};

// The stretched planes as R, G and B in 0..1.
void PersonNetwork::State::fill(const Picture& picture, const cv::Size& size, cv::Mat& input) const {
  const cv::Matx34f m = picture.rgb_from_ycc * (1 / 255.0f);
  float* out[3];
  for (int c = 0; c < 3; ++c) out[c] = input.ptr<float>(0, c);
  std::size_t at_pixel = 0;
  for (int row = 0; row < size.height; ++row) {
    const auto *luma = y.ptr<std::uint8_t>(row), *blue = cb.ptr<std::uint8_t>(row), *red = cr.ptr<std::uint8_t>(row);
    for (int x = 0; x < size.width; ++x, ++at_pixel) {
      for (int c = 0; c < 3; ++c) {
        const float value = m(c, 0) * luma[x] + m(c, 1) * blue[x] + m(c, 2) * red[x] + m(c, 3);
        out[c][at_pixel] = std::clamp(value, 0.0f, 1.0f);
      }
    }
  }
}

PersonNetwork::PersonNetwork(const std::string& model_file) : state_(std::make_unique<State>()) {
  ++counters().networks;
  const SilentOpenCv silent;
  const char* const remedy = "run scripts/fetch-model, or convert one by scripts/tflite-to-onnx";
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    State::AtSize& at = state_->at[i];
    bool fits = false;
    try {
      at.net = cv::dnn::readNetFromONNX(model_file);
      at.net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
      at.net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
      const int shape[] = {1, 3, sizes[i].height, sizes[i].width};
      at.input = cv::Mat::zeros(4, shape, CV_32F);
      at.net.setInput(at.input);
      at.net.forward(at.output);
      fits = at.output.type() == CV_32F && at.output.dims == 4 && at.output.size[0] == 1 && at.output.size[1] == 1 &&
             at.output.size[2] == sizes[i].height && at.output.size[3] == sizes[i].width;
    } catch (const cv::Exception&) {
      throw input_error(model_file, "is no model that OpenCV's DNN module can run", remedy);
    }
    if (!fits) throw input_error(model_file, "the model doesn't give one value for each pixel", remedy);
  }
}

PersonNetwork::PersonNetwork(PersonNetwork&&) noexcept = default;
PersonNetwork::~PersonNetwork() = default;

void PersonNetwork::find(const Picture& picture, const PixelRect& part, cv::Mat& likely) {
  const double aspect = std::log(static_cast<double>(part.width_px) / part.height_px);
  const auto distortion = [&](std::size_t i) {
    return std::abs(aspect - std::log(static_cast<double>(sizes[i].width) / sizes[i].height));
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < sizes.size(); ++i) best = distortion(i) < distortion(best) ? i : best;

  State& s = *state_;
  const cv::Size size = sizes[best];
  const cv::Rect luma_part(part.x_px, part.y_px, part.width_px, part.height_px);
  const int left = part.x_px >> picture.log2_chroma_width, top = part.y_px >> picture.log2_chroma_height;
  const cv::Rect chroma_part(left, top, ((part.right_px() - 1) >> picture.log2_chroma_width) + 1 - left,
                             ((part.bottom_px() - 1) >> picture.log2_chroma_height) + 1 - top);
  stretch(picture.luma, luma_part, size, s.y);
  stretch(picture.cb, chroma_part, size, s.cb);
  stretch(picture.cr, chroma_part, size, s.cr);
  State::AtSize& at = s.at[best];
  s.fill(picture, size, at.input);
  at.net.setInput(at.input);
  at.net.forward(at.output);
  cv::Mat(size, CV_32F, at.output.data).copyTo(likely);
}

std::string installed_model() {
  const auto folder = [](const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path path = value != nullptr ? fs::path(value) : fs::path();
    return path.is_absolute() ? path
                              : fs::path();  // relative ones are to be ignored (XDG Base Directory Specification)
  };
  fs::path data = folder("XDG_DATA_HOME");
  if (data.empty() && !folder("HOME").empty()) data = folder("HOME") / ".local/share";
  const fs::path model = data / "rinkaku/models/selfie_segmentation.onnx";
  std::error_code ignored;
  if (data.empty() || !fs::is_regular_file(model, ignored)) {
    throw input_error(model.string(), "the model for method \"segmentation\" isn't there",
                      "get it by scripts/fetch-model, or name one: segmentation = { model = \"...\" }");
  }
  return model.string();
}

}  // namespace rinkaku::matte

#pragma once

#include <functional>
#include <memory>
#include <string>

#include <opencv2/core.hpp>

#include "pipeline/frame/pixel_rect.h"
#include "pipeline/matte/picture.h"

namespace rinkaku::matte {

/// Looks for persons in a part of a picture. `likely`: CV_32F, how likely each pixel shows one, 0 to 1, the part
/// stretched to a size of the function's own.
using FindPersons = std::function<void(const Picture&, const PixelRect& part, cv::Mat& likely)>;

/// A neural network for persons, run on the CPU by OpenCV's DNN module.
///
/// The model takes RGB in 0..1 (1 x 3 x height x width) and gives as many likelihoods (1 x 1 x height x width), and
/// must take other sizes than its own, as networks of convolutions do: it sees each part of a picture at the one of
/// three sizes that distorts it least, all of some 37,000 pixels. MediaPipe's selfie segmentation (a MobileNetV3 with a
/// decoder; Apache-2.0) is such a one, as scripts/fetch-model converts it.
class PersonNetwork {
 public:
  /// Throws Error (Input) if the file isn't such a model. Takes some 50 ms, which includes a first run at each size.
  explicit PersonNetwork(const std::string& model_file);
  PersonNetwork(PersonNetwork&&) noexcept;
  ~PersonNetwork();

  /// About 7 ms of one core with MediaPipe's model.
  void find(const Picture& picture, const PixelRect& part, cv::Mat& likely);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Where the model lies that is used if the scene names none: $XDG_DATA_HOME/rinkaku/models/selfie_segmentation.onnx,
/// or in ~/.local/share. Throws Error (Input) saying how to get it if it isn't there.
std::string installed_model();

}  // namespace rinkaku::matte

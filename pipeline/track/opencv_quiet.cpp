#include "pipeline/track/opencv_quiet.h"

namespace rinkaku::track {

void silence_opencv() {
  [[maybe_unused]] static const auto once =
      cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
}

std::string short_message(const cv::Exception& error) {
  std::string message = error.err;
  while (!message.empty() && (message.back() == '\n' || message.back() == ' ' || message.back() == '.')) {
    message.pop_back();
  }
  return message;
}

}  // namespace rinkaku::track

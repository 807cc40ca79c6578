#pragma once

#include <string>
#include <utility>

#include <opencv2/core.hpp>

namespace rinkaku::track {

/// Keeps OpenCV from printing its exceptions to standard error; they are caught and told in our own words. For the
/// whole process, from the first call on. Thread-safe.
void silence_opencv();

/// The part of an OpenCV exception that a user can read.
std::string short_message(const cv::Exception& error);

/// Calls `f`; if OpenCV throws, calls `on_error(message)`, which must throw or return f's type.
template <typename F, typename OnError>
auto with_opencv(F&& f, OnError&& on_error) -> decltype(f()) {
  silence_opencv();
  try {
    return std::forward<F>(f)();
  } catch (const cv::Exception& error) {
    return std::forward<OnError>(on_error)(short_message(error));
  }
}

}  // namespace rinkaku::track

#pragma once

#include <string_view>

#include <opencv2/aruco.hpp>

namespace rinkaku::track {

/// OpenCV's dictionary of this name (see dictionary.h). Throws Error (Input), naming `where`, if there is none.
cv::Ptr<cv::aruco::Dictionary> opencv_dictionary(std::string_view where, std::string_view dictionary);

}  // namespace rinkaku::track

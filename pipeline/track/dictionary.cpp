#include "pipeline/track/dictionary.h"

#include <algorithm>

#include <opencv2/aruco.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/toml/schema.h"
#include "pipeline/track/opencv_marker.h"

namespace rinkaku::track {
namespace {

std::string remedy(std::string_view dictionary) {
  if (dictionary.starts_with("DICT_")) dictionary.remove_prefix(5);  // as OpenCV's own constants begin
  const std::vector<std::string_view> names(dictionary_names().begin(), dictionary_names().end());
  const std::string_view near = toml::nearest(dictionary, names);
  if (near.empty()) return "use one such as 4X4_50, ARUCO_ORIGINAL or APRILTAG_36h11";
  return "did you mean \"" + std::string(near) + "\"?";
}

int dictionary_number(std::string_view where, std::string_view dictionary) {
  const auto& names = dictionary_names();
  const auto found = std::find(names.begin(), names.end(), dictionary);
  if (found == names.end()) {
    throw input_error(where, "there is no marker dictionary \"" + std::string(dictionary) + "\"", remedy(dictionary));
  }
  return static_cast<int>(found - names.begin());
}

}  // namespace

const std::vector<std::string>& dictionary_names() {
  static const std::vector<std::string> names = {
      "4X4_50",   "4X4_100",  "4X4_250",        "4X4_1000",      "5X5_50",        "5X5_100",        "5X5_250",
      "5X5_1000", "6X6_50",   "6X6_100",        "6X6_250",       "6X6_1000",      "7X7_50",         "7X7_100",
      "7X7_250",  "7X7_1000", "ARUCO_ORIGINAL", "APRILTAG_16h5", "APRILTAG_25h9", "APRILTAG_36h10", "APRILTAG_36h11"};
  return names;
}

cv::Ptr<cv::aruco::Dictionary> opencv_dictionary(std::string_view where, std::string_view dictionary) {
  return cv::aruco::getPredefinedDictionary(dictionary_number(where, dictionary));
}

int dictionary_size(std::string_view where, std::string_view dictionary) {
  return opencv_dictionary(where, dictionary)->bytesList.rows;
}

void check_marker(std::string_view where, std::string_view dictionary, int id) {
  const int size = dictionary_size(where, dictionary);
  if (id < 0 || id >= size) {
    throw input_error(where, "dictionary " + std::string(dictionary) + " has no marker of id " + std::to_string(id),
                      "its ids run from 0 to " + std::to_string(size - 1));
  }
}

}  // namespace rinkaku::track

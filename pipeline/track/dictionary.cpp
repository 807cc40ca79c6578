#include "pipeline/track/dictionary.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include <opencv2/aruco.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/track/opencv_marker.h"

namespace rinkaku::track {
namespace {

// Edit distance in half edits: letters that differ only in case cost one, everything else two.
int edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<int> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(2 * j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = std::exchange(row[0], static_cast<int>(2 * i));
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = a[i - 1] == b[j - 1] ? 0 : lower(a[i - 1]) == lower(b[j - 1]) ? 1 : 2;
      const int best = std::min({row[j] + 2, row[j - 1] + 2, diagonal + change});
      diagonal = std::exchange(row[j], best);
    }
  }
  return row[b.size()];
}

int dictionary_number(std::string_view where, std::string_view dictionary) {
  const auto& names = dictionary_names();
  const auto found = std::find(names.begin(), names.end(), dictionary);
  if (found == names.end()) {
    throw input_error(where, "there is no marker dictionary \"" + std::string(dictionary) + "\"",
                      "did you mean \"" + nearest_name(dictionary, names) + "\"?");
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

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  return *std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
}

}  // namespace rinkaku::track

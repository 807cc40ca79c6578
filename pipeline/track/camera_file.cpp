#include "pipeline/track/camera_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "pipeline/files/pending_file.h"
#include "pipeline/files/read_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/track/opencv_quiet.h"

namespace rinkaku::track {
namespace {

// A camera file is a few kilobytes; calibrations that list every corner reach some megabytes.
constexpr std::size_t most_bytes = 64u << 20;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

class CameraReader {
 public:
  CameraReader(const std::string& name, const cv::FileNode& root) : name_(name), root_(root) {}

  CameraModel read() const {
    refuse_fisheye();
    CameraModel camera;
    camera.width_px = size("image_width");
    camera.height_px = size("image_height");
    read_matrix(camera);
    read_distortion(camera);
    return camera;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy = {}) const {
    throw input_error(name_, what, remedy);
  }

  void refuse_fisheye() const {
    const std::string remedy = "calibrate with the pinhole model (cv::calibrateCamera)";
    for (const char* key : {"distortion_model", "camera_model", "model", "model_type", "camera_type"}) {
      const cv::FileNode node = root_[key];
      if (!node.isString()) continue;
      const std::string model = lower(static_cast<std::string>(node));
      for (const char* other : {"fisheye", "equidistant", "kannala", "omni", "mei", "double_sphere"}) {
        if (model.find(other) != std::string::npos) fail("the camera model \"" + model + "\" is not supported", remedy);
      }
    }
    for (const char* key : {"fisheye", "fisheye_model"}) {
      const cv::FileNode node = root_[key];
      if (node.empty()) continue;
      const bool off = (node.isInt() && static_cast<int>(node) == 0) ||
                       (node.isString() && lower(static_cast<std::string>(node)) == "false");
      if (!off) fail("fisheye cameras are not supported", remedy);
    }
    // OpenCV's samples name the fisheye flags in words.
    for (const auto& entry : root_) {
      if (entry.isString() && entry.name().find("flags") != std::string::npos &&
          lower(static_cast<std::string>(entry)).find("fisheye") != std::string::npos) {
        fail("fisheye cameras are not supported", remedy);
      }
    }
  }

  cv::FileNode need(const std::string& key) const {
    if (const cv::FileNode node = root_[key]; !node.empty()) return node;
    for (const std::string& other : root_.keys()) {
      if (lower(other) == key)
        fail("key \"" + other + "\" should be \"" + key + "\"", "keys are written in lower case");
    }
    fail("key \"" + key + "\" is missing",
         "a camera file holds camera_matrix, distortion_coefficients, image_width "
         "and image_height, as `rinkaku calibrate` writes it");
  }

  int size(const std::string& key) const {
    const cv::FileNode node = need(key);
    if (!node.isInt() && !node.isReal()) fail("\"" + key + "\" is not a number");
    const double value = static_cast<double>(node);
    if (!(value >= 1 && value <= 65536) || value != std::floor(value)) {
      fail("\"" + key + "\" is not a whole number of pixels between 1 and 65536");
    }
    return static_cast<int>(value);
  }

  cv::Mat matrix(const std::string& key) const {
    const cv::FileNode node = need(key);
    cv::Mat values;
    if (node.isMap()) {
      node >> values;
    } else if (node.isSeq()) {
      const bool nested = node.size() > 0 && (*node.begin()).isSeq();
      for (const auto& row : node) {
        std::vector<double> numbers;
        if (nested) {
          row >> numbers;
        } else {
          row >> numbers.emplace_back();
        }
        cv::Mat line(1, static_cast<int>(numbers.size()), CV_64F, numbers.data());
        if (!values.empty() && values.cols != line.cols) fail("\"" + key + "\" has rows of different lengths");
        values.push_back(line);
      }
    }
    if (values.empty() || values.dims != 2 || values.channels() != 1)
      fail("\"" + key + "\" is not a matrix of numbers");
    values.convertTo(values, CV_64F);
    for (int i = 0; i < static_cast<int>(values.total()); ++i) {
      if (!std::isfinite(values.at<double>(i / values.cols, i % values.cols))) {
        fail("\"" + key + "\" holds a value that is not finite");
      }
    }
    return values;
  }

  void read_matrix(CameraModel& camera) const {
    const cv::Mat k = matrix("camera_matrix");
    if (k.rows != 3 || k.cols != 3) {
      fail("camera_matrix is " + std::to_string(k.rows) + "x" + std::to_string(k.cols) + ", not 3x3");
    }
    const auto at = [&](int row, int column) { return k.at<double>(row, column); };
    if (at(0, 1) != 0) fail("camera_matrix has skew, which is not supported", "calibrate with OpenCV's pinhole model");
    if (at(1, 0) != 0 || at(2, 0) != 0 || at(2, 1) != 0 || std::abs(at(2, 2) - 1) > 1e-9) {
      fail("camera_matrix is not of the form [fx 0 cx; 0 fy cy; 0 0 1]");
    }
    if (!(at(0, 0) > 0) || !(at(1, 1) > 0)) fail("the focal lengths in camera_matrix are not positive");
    camera.fx_px = at(0, 0);
    camera.fy_px = at(1, 1);
    camera.cx_px = at(0, 2);
    camera.cy_px = at(1, 2);
  }

  void read_distortion(CameraModel& camera) const {
    const cv::Mat d = matrix("distortion_coefficients");
    const std::size_t count = d.total();
    const bool is_vector = d.rows == 1 || d.cols == 1;
    if (!is_vector || (count != 4 && count != 5 && count != 8 && count != 12 && count != 14)) {
      fail("distortion_coefficients holds " + std::to_string(count) + " values", "OpenCV writes 4, 5, 8, 12 or 14");
    }
    for (std::size_t i = 0; i < count; ++i) camera.distortion[i] = d.ptr<double>()[i];
    if (camera.distortion[12] != 0 || camera.distortion[13] != 0) {
      fail("a tilted sensor (tau, the last two distortion coefficients) is not supported",
           "calibrate without CALIB_TILTED_MODEL");
    }
  }

  const std::string& name_;
  cv::FileNode root_;
};

}  // namespace

CameraModel read_camera(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string text = files::read_file(file, most_bytes);
  return with_opencv(
      [&] {
        // OpenCV reads "%YAML" only at the very start; a byte order mark or blank lines before it are harmless.
        std::size_t start = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
        const bool yaml = start != std::string::npos && text[start] != '{' && text[start] != '<' &&
                          text.compare(start, 5, "%YAML") != 0;
        // A YAML file without the version line, as other tools write it.
        const std::string whole =
            start == std::string::npos ? std::string() : (yaml ? "%YAML:1.0\n" : "") + text.substr(start);
        if (whole.empty()) throw input_error(name, "the camera file is empty");
        cv::FileStorage storage(whole, cv::FileStorage::READ | cv::FileStorage::MEMORY);
        const cv::FileNode root = storage.root();
        if (!root.isMap()) throw input_error(name, "this is not a camera file", "write one with `rinkaku calibrate`");
        return CameraReader(name, root).read();
      },
      [&](const std::string& message) -> CameraModel {
        throw input_error(name, "this is not a camera file OpenCV can read (" + message + ")",
                          "write one with `rinkaku calibrate`");
      });
}

void write_camera(const std::filesystem::path& file, const CameraModel& camera,
                  const std::optional<CalibrationNote>& note) {
  const auto& k = camera.distortion;
  const bool prism = std::any_of(k.begin() + 8, k.begin() + 12, [](double v) { return v != 0; });
  const bool rational = std::any_of(k.begin() + 5, k.begin() + 8, [](double v) { return v != 0; });
  const int count = prism ? 12 : rational ? 8 : 5;
  const std::string text = with_opencv(
      [&] {
        const std::string ending = lower(file.extension().string());
        const std::string format = ending == ".xml" || ending == ".json" ? ending : ".yml";
        cv::FileStorage storage(format, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
        storage << "image_width" << camera.width_px << "image_height" << camera.height_px;
        const cv::Mat matrix =
            (cv::Mat_<double>(3, 3) << camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
        storage << "camera_matrix" << matrix;
        storage << "distortion_coefficients" << cv::Mat(1, count, CV_64F, const_cast<double*>(k.data())).clone();
        if (note) storage << "avg_reprojection_error" << note->rms_px << "nr_of_frames" << note->views;
        return storage.releaseAndGetString();
      },
      [&](const std::string& message) -> std::string { throw runtime_failure(file.string(), message); });
  files::write_file(file.string(), text);
}

void check_resolution(const CameraModel& camera, const std::filesystem::path& file, int width_px, int height_px) {
  if (camera.width_px == width_px && camera.height_px == height_px) return;
  const auto size = [](int width, int height) { return std::to_string(width) + "x" + std::to_string(height); };
  throw input_error(file.string(),
                    "the camera was calibrated at " + size(camera.width_px, camera.height_px) +
                        ", but the picture is " + size(width_px, height_px),
                    "calibrate at the picture's size, or film at the camera file's");
}

}  // namespace rinkaku::track

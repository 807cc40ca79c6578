#include "pipeline/track/camera_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>
#include <yaml-cpp/yaml.h>

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

// A number as OpenCV and others write it; empty for a word or anything else.
std::optional<double> number(const YAML::Node& node) {
  if (!node || !node.IsScalar() || node.Tag() == "!") return {};  // "!" is what quotes make of it
  const std::string text = lower(node.Scalar());
  double value = 0;
  const std::size_t sign = !text.empty() && (text.front() == '+' || text.front() == '-') ? 1 : 0;
  if (text.compare(sign, std::string::npos, ".nan") == 0) return std::numeric_limits<double>::quiet_NaN();
  if (text.compare(sign, std::string::npos, ".inf") == 0) return std::numeric_limits<double>::infinity();
  const char* last = text.data() + text.size();
  const auto [end, problem] = std::from_chars(text.data() + (sign && text.front() == '+'), last, value);
  if (problem != std::errc() || end != last) return {};
  return value;
}

// YAML, and JSON, which is YAML as well. OpenCV's version line "%YAML:1.0" isn't.
YAML::Node from_yaml(std::string text) {
  if (text.front() == '%') text.erase(0, std::min(text.find('\n'), text.size()));
  return YAML::Load(text);
}

YAML::Node from_xml_node(const pugi::xml_node& node, int depth) {
  constexpr int deepest = 8;  // a camera file has three
  if (depth > deepest) throw std::runtime_error("it is nested too deeply");
  YAML::Node result;
  if (!node.first_child().first_child() && !node.first_child().next_sibling()) {
    std::istringstream words(node.child_value());
    std::vector<std::string> all{std::istream_iterator<std::string>(words), {}};
    // A matrix's numbers, or one word.
    if (std::string_view(node.name()) != "data") return YAML::Node(std::string(node.child_value()));
    for (const std::string& word : all) result.push_back(word);
    return result;
  }
  for (const pugi::xml_node& child : node.children()) {
    if (child.type() == pugi::node_element) result[child.name()] = from_xml_node(child, depth + 1);
  }
  return result;
}

YAML::Node from_xml(const std::string& text) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) throw std::runtime_error(parsed.description());
  return from_xml_node(document.document_element(), 0);
}

class CameraReader {
 public:
  CameraReader(const std::string& name, const YAML::Node& root) : name_(name), root_(root) {}

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

  // What a key that holds one word says, in small letters; empty if there is none.
  std::string word(const char* key) const {
    const YAML::Node node = root_[key];
    return node && node.IsScalar() ? lower(node.Scalar()) : std::string();
  }

  void refuse_fisheye() const {
    const std::string remedy = "calibrate with the pinhole model (cv::calibrateCamera)";
    for (const char* key : {"distortion_model", "camera_model", "model", "model_type", "camera_type"}) {
      const std::string model = word(key);
      for (const char* other : {"fisheye", "equidistant", "kannala", "omni", "mei", "double_sphere"}) {
        if (model.find(other) == std::string::npos) continue;
        fail("the camera model \"" + quotable(model) + "\" is not supported", remedy);
      }
    }
    for (const char* key : {"fisheye", "fisheye_model"}) {
      if (!root_[key]) continue;
      const std::string value = word(key);
      if (value != "0" && value != "false") fail("fisheye cameras are not supported", remedy);
    }
    // OpenCV's samples name the fisheye flags in words.
    for (const auto& entry : root_) {
      if (entry.first.IsScalar() && entry.first.Scalar().find("flags") != std::string::npos &&
          entry.second.IsScalar() && lower(entry.second.Scalar()).find("fisheye") != std::string::npos) {
        fail("fisheye cameras are not supported", remedy);
      }
    }
  }

  YAML::Node need(const std::string& key) const {
    if (const YAML::Node node = root_[key]) return node;
    for (const auto& entry : root_) {
      if (entry.first.IsScalar() && lower(entry.first.Scalar()) == key) {
        fail("key \"" + quotable(entry.first.Scalar()) + "\" should be \"" + key + "\"",
             "keys are written in lower case");
      }
    }
    fail("key \"" + key + "\" is missing",
         "a camera file holds camera_matrix, distortion_coefficients, image_width "
         "and image_height, as `rinkaku calibrate` writes it");
  }

  int size(const std::string& key) const {
    const std::optional<double> value = number(need(key));
    if (!value) fail("\"" + key + "\" is not a number");
    if (!(*value >= 1 && *value <= 65536) || *value != std::floor(*value)) {
      fail("\"" + key + "\" is not a whole number of pixels between 1 and 65536");
    }
    return static_cast<int>(*value);
  }

  struct Matrix {
    std::size_t rows = 0, columns = 0;
    std::vector<double> values;  // row by row
    double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
  };

  // OpenCV's map of rows, cols and data; a list of rows; or a list of numbers.
  Matrix matrix(const std::string& key) const {
    const YAML::Node node = need(key);
    Matrix matrix;
    if (node.IsMap()) {
      const auto count = [&](const char* name) {
        const double value = number(node[name]).value_or(0);
        return value >= 1 && value <= 1000 && value == std::floor(value) ? static_cast<std::size_t>(value) : 0;
      };
      matrix.rows = count("rows");
      matrix.columns = count("cols");
      append(key, node["data"], matrix.values);
    } else if (node.IsSequence() && node.size() > 0 && node[0].IsSequence()) {
      for (const YAML::Node& row : node) {
        append(key, row, matrix.values);
        if (++matrix.rows == 1) matrix.columns = matrix.values.size();
        if (matrix.values.size() != matrix.rows * matrix.columns) {
          fail("\"" + key + "\" has rows of different lengths");
        }
      }
    } else if (node.IsSequence()) {
      append(key, node, matrix.values);
      matrix.rows = matrix.values.size();
      matrix.columns = 1;
    }
    if (matrix.values.empty() || matrix.values.size() != matrix.rows * matrix.columns) {
      fail("\"" + key + "\" is not a matrix of numbers");
    }
    return matrix;
  }

  void append(const std::string& key, const YAML::Node& list, std::vector<double>& values) const {
    if (!list || !list.IsSequence() || list.size() > 1000) fail("\"" + key + "\" is not a matrix of numbers");
    for (const YAML::Node& entry : list) {
      const std::optional<double> value = number(entry);
      if (!value) fail("\"" + key + "\" is not a matrix of numbers");
      if (!std::isfinite(*value)) fail("\"" + key + "\" holds a value that is not finite");
      values.push_back(*value);
    }
  }

  void read_matrix(CameraModel& camera) const {
    const Matrix k = matrix("camera_matrix");
    if (k.rows != 3 || k.columns != 3) {
      fail("camera_matrix is " + std::to_string(k.rows) + "x" + std::to_string(k.columns) + ", not 3x3");
    }
    const auto at = [&](std::size_t row, std::size_t column) { return k.at(row, column); };
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
    const Matrix d = matrix("distortion_coefficients");
    const std::size_t count = d.values.size();
    const bool is_vector = d.rows == 1 || d.columns == 1;
    if (!is_vector || (count != 4 && count != 5 && count != 8 && count != 12 && count != 14)) {
      fail("distortion_coefficients holds " + std::to_string(count) + " values", "OpenCV writes 4, 5, 8, 12 or 14");
    }
    for (std::size_t i = 0; i < count; ++i) camera.distortion[i] = d.values[i];
    if (camera.distortion[12] != 0 || camera.distortion[13] != 0) {
      fail("a tilted sensor (tau, the last two distortion coefficients) is not supported",
           "calibrate without CALIB_TILTED_MODEL");
    }
  }

  const std::string& name_;
  YAML::Node root_;
};

}  // namespace

CameraModel read_camera(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string text = files::read_file(file, most_bytes);
  const std::size_t start = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (start == std::string::npos) throw input_error(name, "the camera file is empty");
  YAML::Node root;
  try {
    root = text[start] == '<' ? from_xml(text.substr(start)) : from_yaml(text.substr(start));
  } catch (const std::exception& error) {
    throw input_error(name, std::string("this is not a camera file that can be read (") + quotable(error.what()) + ")",
                      "write one with `rinkaku calibrate`");
  }
  if (!root.IsMap()) throw input_error(name, "this is not a camera file", "write one with `rinkaku calibrate`");
  return CameraReader(name, root).read();
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

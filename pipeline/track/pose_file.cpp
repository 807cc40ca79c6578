#include "pipeline/track/pose_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "pipeline/files/read_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/track/dictionary.h"

namespace rinkaku::track {
namespace {

// 24 hours at 60 frames a second take 700 MB.
constexpr std::size_t most_bytes = std::size_t{1} << 30;

enum Column { FrameNumber, Time, Tx, Ty, Tz, Qx, Qy, Qz, Qw, ColumnCount };
const std::vector<std::string>& column_names() {
  static const std::vector<std::string> names = {"frame", "time_s", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};
  return names;
}

std::string_view trim(std::string_view text) {
  const auto start = text.find_first_not_of(" \t\r");
  if (start == std::string_view::npos) return {};
  return text.substr(start, text.find_last_not_of(" \t\r") - start + 1);
}

struct Line {
  std::string_view text;
  int number = 0;
};

class PoseReader {
 public:
  PoseReader(std::string file, std::string_view text) : file_(std::move(file)), rest_(text) {
    if (rest_.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
  }

  std::vector<FilePose> read() {
    std::optional<Line> line = next();
    if (!line) throw input_error(file_, "the file holds no poses");
    csv_ = line->text.find(',') != std::string_view::npos;
    if (csv_) {
      read_header(*line);
      line = next();
    } else {
      columns_ = {Time, Tx, Ty, Tz, Qx, Qy, Qz, Qw};
    }
    for (; line; line = next()) {
      poses_.push_back(read_pose(*line));
      line_of_.push_back(line->number);
    }
    if (poses_.empty()) throw input_error(file_, "the file holds no poses");
    return sorted();
  }

 private:
  std::string at(int line) const { return file_ + ":" + std::to_string(line); }

  // The next line that holds something.
  std::optional<Line> next() {
    while (!rest_.empty()) {
      const auto end = rest_.find('\n');
      std::string_view text = rest_.substr(0, end);
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++line_;
      text = trim(text.substr(0, text.find('#')));
      if (!text.empty()) return Line{text, line_};
    }
    return {};
  }

  std::vector<std::string_view> split(std::string_view text) const {
    std::vector<std::string_view> fields;
    if (csv_) {
      for (;;) {
        const auto comma = text.find(',');
        fields.push_back(trim(text.substr(0, comma)));
        if (comma == std::string_view::npos) return fields;
        text.remove_prefix(comma + 1);
      }
    }
    for (text = trim(text); !text.empty(); text = trim(text)) {
      const auto end = std::min(text.find_first_of(" \t"), text.size());
      fields.push_back(text.substr(0, end));
      text.remove_prefix(end);
    }
    return fields;
  }

  void read_header(const Line& line) {
    const auto& names = column_names();
    for (const std::string_view field : split(line.text)) {
      const auto found = std::find(names.begin(), names.end(), field);
      if (found == names.end()) {
        throw input_error(at(line.number), "unknown column \"" + quotable(field) + "\"",
                          "the first line names the columns: frame,time_s,tx,ty,tz,qx,qy,qz,qw");
      }
      const auto column = static_cast<Column>(found - names.begin());
      if (std::count(columns_.begin(), columns_.end(), column)) {
        throw input_error(at(line.number), "column \"" + std::string(field) + "\" comes twice");
      }
      columns_.push_back(column);
    }
    const auto has = [&](Column c) { return std::count(columns_.begin(), columns_.end(), c) > 0; };
    for (int c = Tx; c < ColumnCount; ++c) {
      if (has(static_cast<Column>(c))) continue;
      throw input_error(at(line.number), "column \"" + names[static_cast<std::size_t>(c)] + "\" is missing");
    }
    if (!has(FrameNumber) && !has(Time)) {
      throw input_error(at(line.number), "neither of the columns \"frame\" and \"time_s\" is there",
                        "give one of them");
    }
  }

  FilePose read_pose(const Line& line) const {
    const std::vector<std::string_view> fields = split(line.text);
    if (fields.size() != columns_.size()) {
      throw input_error(at(line.number),
                        std::to_string(fields.size()) + " fields instead of " + std::to_string(columns_.size()),
                        csv_ ? "as many as the first line names"
                             : "a line holds timestamp tx ty tz qx qy qz qw (or write a CSV with a header)");
    }
    std::array<double, ColumnCount> value{};
    FilePose pose;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const Column column = columns_[i];
      if (fields[i].empty() && (column == FrameNumber || column == Time)) continue;
      double& number = value[column];
      const char* first = fields[i].data() + (fields[i].starts_with('+') ? 1 : 0);
      const char* last = fields[i].data() + fields[i].size();
      const auto [end, problem] = std::from_chars(first, last, number);
      if (problem != std::errc() || end != last || !std::isfinite(number)) {
        throw input_error(at(line.number), "\"" + quotable(fields[i]) + "\" in column " + column_names()[column] +
                                               " is not a finite number");
      }
      if (column == FrameNumber) {
        if (number < 0 || number > 9e15 || number != std::floor(number)) {
          throw input_error(at(line.number), "\"" + quotable(fields[i]) + "\" is not a frame number",
                            "frames are counted from 0");
        }
        pose.frame = static_cast<std::int64_t>(number);
      }
      if (column == Time) pose.time_s = number;
    }
    if (!pose.frame && !pose.time_s) throw input_error(at(line.number), "the pose has neither frame nor time");
    const double scale = std::max({std::abs(value[Qx]), std::abs(value[Qy]), std::abs(value[Qz]), std::abs(value[Qw])});
    if (!(scale > 1e-6)) throw input_error(at(line.number), "the quaternion is zero", "0,0,0,1 is no rotation");
    pose.world_from_camera.rotation =
        glm::normalize(glm::dquat(value[Qw] / scale, value[Qx] / scale, value[Qy] / scale, value[Qz] / scale));
    pose.world_from_camera.translation_m = {value[Tx], value[Ty], value[Tz]};
    return pose;
  }

  std::vector<FilePose> sorted() {
    const auto count = [&](auto member) {
      return static_cast<std::size_t>(
          std::count_if(poses_.begin(), poses_.end(), [&](const FilePose& p) { return (p.*member).has_value(); }));
    };
    const bool by_frame = count(&FilePose::frame) == poses_.size();
    if (!by_frame && count(&FilePose::time_s) != poses_.size()) {
      throw input_error(file_, "some poses have no frame number and others no time",
                        "fill one of the columns in every line");
    }
    std::vector<std::size_t> order(poses_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto before = [&](std::size_t a, std::size_t b) {
      return by_frame ? *poses_[a].frame < *poses_[b].frame : *poses_[a].time_s < *poses_[b].time_s;
    };
    std::stable_sort(order.begin(), order.end(), before);
    std::vector<FilePose> result;
    result.reserve(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i > 0 && !before(order[i - 1], order[i])) {
        throw input_error(at(line_of_[order[i]]), std::string(by_frame ? "this frame number" : "this time") +
                                                      " was given before, in line " +
                                                      std::to_string(line_of_[order[i - 1]]));
      }
      result.push_back(poses_[order[i]]);
    }
    return result;
  }

  std::string file_;
  std::string_view rest_;
  int line_ = 0;
  bool csv_ = false;
  std::vector<Column> columns_;
  std::vector<FilePose> poses_;
  std::vector<int> line_of_;
};

class PoseFileTracker final : public Tracker {
 public:
  PoseFileTracker(PoseTable poses, double first_time_s) : poses_(std::move(poses)), first_time_s_(first_time_s) {}

  std::optional<TrackedPose> track(const Frame& frame) override {
    const auto world_from_camera = poses_.world_from_camera(frame.number, frame.time_s() - first_time_s_);
    if (!world_from_camera) return {};
    TrackedPose pose;
    pose.frame_number = frame.number;
    pose.camera_from_world = inverse(*world_from_camera);
    return pose;
  }

 private:
  PoseTable poses_;
  double first_time_s_;
};

}  // namespace

PoseTable::PoseTable(std::vector<FilePose> poses)
    : poses_(std::move(poses)),
      by_frame_(std::all_of(poses_.begin(), poses_.end(), [](const FilePose& p) { return p.frame.has_value(); })) {}

std::optional<RigidTransform> PoseTable::world_from_camera(std::int64_t frame, double time_s) const {
  if (poses_.empty()) return {};
  if (by_frame_) {
    const auto found = std::lower_bound(poses_.begin(), poses_.end(), frame,
                                        [](const FilePose& p, std::int64_t number) { return *p.frame < number; });
    if (found == poses_.end() || *found->frame != frame) return {};
    return found->world_from_camera;
  }
  // Times go through decimal text: half a microsecond is what six digits keep.
  constexpr double slack_s = 0.5e-6;
  const double first = *poses_.front().time_s, last = *poses_.back().time_s;
  if (!(time_s >= first - slack_s && time_s <= last + slack_s)) return {};
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), time_s, [](const FilePose& p, double t) { return *p.time_s < t; });
  if (after == poses_.begin()) return poses_.front().world_from_camera;
  if (after == poses_.end()) return poses_.back().world_from_camera;
  const FilePose &a = *(after - 1), &b = *after;
  const double part = (time_s - *a.time_s) / (*b.time_s - *a.time_s);
  RigidTransform between;
  between.rotation = glm::normalize(glm::slerp(a.world_from_camera.rotation, b.world_from_camera.rotation, part));
  between.translation_m = glm::mix(a.world_from_camera.translation_m, b.world_from_camera.translation_m, part);
  return between;
}

PoseTable read_poses(const std::filesystem::path& file) {
  const std::string text = files::read_file(file, most_bytes);
  return PoseTable(PoseReader(file.string(), text).read());
}

std::unique_ptr<Tracker> make_pose_file_tracker(PoseTable poses, double first_time_s) {
  return std::make_unique<PoseFileTracker>(std::move(poses), first_time_s);
}

}  // namespace rinkaku::track

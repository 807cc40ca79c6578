#include "pipeline/session/log.h"

#include <mutex>
#include <system_error>

#include <nlohmann/json.hpp>

#include "pipeline/files/read_file.h"
#include "pipeline/frame/error.h"

namespace rinkaku::session {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* log_name = "session.jsonl";
constexpr std::size_t most_bytes = std::size_t{1} << 30;

json to_json(const TrackedPose& pose) {
  const glm::dquat& q = pose.camera_from_world.rotation;
  const glm::dvec3& t = pose.camera_from_world.translation_m;
  // Numbers are written so that the very same double is read back.
  return {{"rotation_wxyz", {q.w, q.x, q.y, q.z}},
          {"translation_m", {t.x, t.y, t.z}},
          {"opacity", pose.opacity},
          {"rms_px", pose.reprojection_rms_px},
          {"held", pose.held}};
}

TrackedPose pose_of(const json& logged, std::int64_t frame) {
  TrackedPose pose;
  pose.frame_number = frame;
  const auto at = [&logged](const char* key, std::size_t i) { return logged.at(key).at(i).get<double>(); };
  pose.camera_from_world.rotation =
      glm::dquat(at("rotation_wxyz", 0), at("rotation_wxyz", 1), at("rotation_wxyz", 2), at("rotation_wxyz", 3));
  pose.camera_from_world.translation_m = {at("translation_m", 0), at("translation_m", 1), at("translation_m", 2)};
  pose.opacity = logged.at("opacity").get<double>();
  pose.reprojection_rms_px = logged.at("rms_px").get<double>();
  pose.held = logged.at("held").get<bool>();
  return pose;
}

LoggedFrame frame_of(const json& line) {
  LoggedFrame frame;
  frame.number = line.at("frame").get<std::int64_t>();
  frame.pts = line.at("pts").get<std::int64_t>();
  frame.duration = line.at("duration").get<std::int64_t>();
  frame.time_base = {line.at("time_base").at(0).get<std::int64_t>(), line.at("time_base").at(1).get<std::int64_t>()};
  if (frame.time_base.num <= 0 || frame.time_base.den <= 0) throw std::out_of_range("time_base must be above 0");
  frame.captured_ns = line.at("captured_ns").get<std::int64_t>();
  if (line.contains("pose")) frame.pose = pose_of(line.at("pose"), frame.number);
  return frame;
}

void take(const json& line, Session& session) {
  if (line.contains("session")) {
    session.scene = line.at("scene").get<std::string>();
    session.text = line.at("text").get<std::string>();
  } else if (line.contains("frame")) {
    session.frames.push_back(frame_of(line));
  } else {
    session.changes.push_back({line.at("from_frame").get<std::int64_t>(), line.at("text").get<std::string>()});
  }
}

}  // namespace

bool is_session(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / log_name, error);
}

Session read_session(const fs::path& folder) {
  const fs::path file = folder / log_name;
  const std::string all = files::read_file(file, most_bytes);
  Session session;
  session.folder = folder;
  int number = 0;
  for (std::size_t begin = 0, end; (end = all.find('\n', begin)) != std::string::npos; begin = end + 1) {
    ++number;
    try {
      take(
          json::parse(all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end)),
          session);
    } catch (const std::exception&) {
      throw input_error(file.string() + ":" + std::to_string(number), "is no line of a session's log",
                        "take the session as it was written");
    }
  }
  if (session.text.empty() || session.frames.empty()) throw input_error(file.string(), "the session holds no frame");
  return session;
}

// One line after the other, each whole on the disk before the next.
class SessionWriter::Lines {
 public:
  explicit Lines(const fs::path& file) : name_(file.string()), out_(file, std::ios::binary) {
    if (!out_) throw input_error(name_, "can't be written", "choose another folder");
  }
  void add(const json& line) {
    std::lock_guard lock(mutex_);
    out_ << line.dump(-1, ' ', false, json::error_handler_t::replace) << '\n' << std::flush;
    if (!out_) throw runtime_failure(name_, "can't be written", "make room on the disk");
  }

 private:
  std::string name_;
  std::mutex mutex_;
  std::ofstream out_;
};

SessionWriter::SessionWriter(const fs::path& folder, const fs::path& scene, const std::string& text,
                             const sink::Incoming& incoming) {
  std::error_code error;
  if (fs::exists(folder, error)) throw input_error(folder.string(), "exists already", "name a new folder");
  if (!fs::create_directories(folder, error)) {
    throw input_error(folder.string(), "can't be made: " + error.message(), "choose another folder");
  }
  sink::Options options;
  options.path = (folder / "plate.mkv").string();
  options.codec = "ffvhuff";
  options.recording = true;
  plate_ = sink::open(options, incoming);
  if (!plate_->notice().empty()) {
    throw input_error(folder.string(), "the session can't be kept without loss: " + plate_->notice());
  }
  lines_ = std::make_unique<Lines>(folder / log_name);
  lines_->add({{"session", 1}, {"scene", fs::absolute(scene).lexically_normal().string()}, {"text", text}});
}

SessionWriter::~SessionWriter() = default;

void SessionWriter::write(const Frame& frame, const std::optional<TrackedPose>& pose) {
  plate_->write(frame);
  begun_ = true;
  json line = {{"frame", frame.number},
               {"pts", frame.pts},
               {"duration", frame.duration},
               {"time_base", {frame.time_base.num, frame.time_base.den}},
               {"captured_ns", frame.captured_ns}};
  if (pose) line["pose"] = to_json(*pose);
  lines_->add(line);
}

void SessionWriter::change(std::int64_t from_frame, const std::string& text) {
  lines_->add({{"from_frame", from_frame}, {"text", text}});
}

void SessionWriter::finish() {
  if (begun_) plate_->finish();
}

}  // namespace rinkaku::session

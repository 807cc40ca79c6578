#include "pipeline/source/v4l2/camera.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <poll.h>

#include "pipeline/frame/error.h"
#include "pipeline/source/v4l2/capture.h"
#include "pipeline/source/v4l2/unpack.h"

namespace rinkaku::source::v4l2 {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t first_picture_ns = 5 * second_ns;  // cameras take a second or two to measure the light
constexpr std::int64_t silence_ns = second_ns;            // worth a notice
constexpr std::int64_t restart_ns = 3 * second_ns;        // the stream is started anew
constexpr int poll_ms = 50;
constexpr std::chrono::milliseconds look_again{100};

std::string size_text(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

std::string rate_text(Rational rate) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g/s", rate.value());
  return text;
}

std::string agreed_text(const Agreed& agreed) {
  return size_text(agreed.width_px, agreed.height_px) + " " + name_of(agreed.format) +
         (agreed.rate.num > 0 ? " at " + rate_text(agreed.rate) : std::string());
}

// What was wished and not got; empty if nothing.
std::string shortfall(const ModeWish& wish, const Agreed& agreed) {
  std::string line;
  const auto add = [&line](const std::string& part) { line += (line.empty() ? "" : ", ") + part; };
  if (wish.width_px > 0 && (wish.width_px != agreed.width_px || wish.height_px != agreed.height_px)) {
    add(size_text(wish.width_px, wish.height_px));
  }
  if (wish.rate.num > 0 && agreed.rate.num > 0 && std::abs(wish.rate.value() / agreed.rate.value() - 1) > 0.01) {
    add(rate_text(wish.rate));
  }
  return line;
}

// Waits a moment for a picture or an error, which is found by taking the picture.
bool something_comes(const Capture& capture) {
  pollfd polled{capture.poll_descriptor(), POLLIN, 0};
  return ::poll(&polled, 1, poll_ms) > 0;
}

Device find_device(const std::string& wanted) {
  if (wanted.find('/') != std::string::npos) return open_device(wanted);
  for (const std::string& path : device_paths()) {
    try {
      Device device = open_device(path);
      if (device.identity.card == wanted) return device;
    } catch (const Error&) {
      // Not a camera, or not ours to open: the next.
    }
  }
  throw input_error(wanted, "there is no camera of that name", "'rinkaku devices' lists the cameras there are");
}

Choice choose(const Device& device, const ModeWish& wish) {
  const std::vector<Mode> modes = modes_of(device);
  if (const auto choice = best_choice(modes, wish)) return *choice;
  std::string has;
  for (const Mode& mode : modes) {
    const std::string name = name_of(mode.format);
    if ((", " + has + ",").find(", " + name + ",") == std::string::npos) has += (has.empty() ? "" : ", ") + name;
  }
  const std::string wished = wish.format != 0 ? "no format " + name_of(wish.format) : "no format that can be read";
  throw input_error(device.path, device.identity.card + " has " + wished,
                    has.empty() ? "it tells none at all" : "it has " + has);
}

class Camera final : public Source {
 public:
  explicit Camera(const CameraOptions& options);

  const Description& description() const override { return description_; }
  std::optional<Frame> next() override;
  std::string damage() const override;
  void stop_when(const std::atomic<bool>& stop) override { stop_ = &stop; }
  Health health() const override;

 private:
  bool stopped() const { return stop_ && *stop_; }
  void start(Device device, const Choice& choice);
  std::optional<Frame> take();
  void begin();
  void look_for_it();
  void lose(const std::string& why);
  void notice(const std::string& line);
  void stamp(Frame& frame, const Taken& taken);
  void describe();

  CameraOptions options_;
  Identity identity_;
  std::string path_;
  Choice choice_;
  const std::atomic<bool>* stop_ = nullptr;
  std::optional<Capture> capture_;
  std::optional<Unpacker> unpacker_;
  std::optional<std::uint32_t> last_sequence_;
  std::int64_t heard_ns_ = 0;
  std::optional<std::int64_t> first_ns_;
  std::int64_t next_number_ = 0, last_pts_ = -1;
  bool returning_ = false;  // lost, and no picture came since
  std::optional<Frame> first_;
  Description description_;

  mutable std::mutex mutex_;  // of health_
  Health health_;
};

Camera::Camera(const CameraOptions& options) : options_(options) {
  Device device = find_device(options.device);
  identity_ = device.identity;
  path_ = device.path;
  const Choice choice = choose(device, options.wish);
  set_controls(device, options.controls);
  start(std::move(device), choice);
  const std::int64_t give_up_ns = monotonic_ns() + first_picture_ns;
  while (!first_) {
    if (monotonic_ns() > give_up_ns || !capture_) {
      throw runtime_failure(path_, identity_.card + " sends no picture",
                            "check its cover and cable, or choose another format");
    }
    if (something_comes(*capture_)) first_ = take();
  }
  describe();
}

void Camera::describe() {
  const Agreed& agreed = capture_->agreed();
  description_.name = path_;
  description_.format = first_->format;
  description_.time_base = {1, 1'000'000};
  description_.frame_rate = agreed.rate;
  description_.variable_frame_rate = true;
  description_.live = true;
  description_.notice = path_ + ": " + identity_.card + ", " + agreed_text(agreed);
  if (const std::string missing = shortfall(options_.wish, agreed); !missing.empty()) {
    description_.notice += " (it can't do the " + missing + " asked for)";
  }
}

void Camera::start(Device device, const Choice& choice) {
  choice_ = choice;
  path_ = device.path;
  capture_.emplace(std::move(device), choice);
  unpacker_.emplace(capture_->agreed());
  last_sequence_.reset();
  heard_ns_ = monotonic_ns();
}

std::optional<Frame> Camera::next() {
  if (first_) begin();
  while (!stopped()) {
    if (!capture_) {
      std::this_thread::sleep_for(look_again);
      look_for_it();
      continue;
    }
    if (something_comes(*capture_)) {
      if (auto frame = take()) return frame;
      if (!capture_) continue;
      // Nothing came although something happened: an error that lasts must not be asked about all the time.
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    const std::int64_t silent_ns = monotonic_ns() - heard_ns_;
    if (silent_ns > restart_ns) {
      lose("sends no picture any more; it is started anew");
    } else if (silent_ns > silence_ns) {
      notice("sends no picture");
    }
  }
  return std::nullopt;
}

// What came while the rest was set up is old by now, and nobody's loss.
void Camera::begin() {
  first_.reset();
  Taken taken;
  while (capture_ && capture_->take(taken) == Capture::Failure::None) capture_->give_back(taken);
  last_sequence_.reset();
  first_ns_.reset();
  heard_ns_ = monotonic_ns();
  next_number_ = 0;
  last_pts_ = -1;
  std::lock_guard lock(mutex_);
  health_ = {};
}

std::optional<Frame> Camera::take() {
  Taken taken;
  switch (capture_->take(taken)) {
    case Capture::Failure::None:
      break;
    case Capture::Failure::NothingYet:
      return std::nullopt;
    case Capture::Failure::Gone:
      lose("is unplugged; the last picture stays until it is back");
      return std::nullopt;
    case Capture::Failure::Broken:
      lose("reports an error; it is started anew");
      return std::nullopt;
  }
  heard_ns_ = monotonic_ns();
  std::optional<Frame> frame;
  if (!taken.damaged) frame = unpacker_->frame(taken.bytes);
  const bool alike = frame && (description_.live ? frame->format == description_.format : true);
  capture_->give_back(taken);  // if the device is gone, the next take says so
  {
    std::lock_guard lock(mutex_);
    if (last_sequence_ && taken.sequence > *last_sequence_) health_.missed += taken.sequence - *last_sequence_ - 1;
    last_sequence_ = taken.sequence;
    if (!alike) {
      ++health_.damaged;
      return std::nullopt;
    }
    ++health_.frames;
    health_.notice.clear();
    if (std::exchange(returning_, false)) ++health_.reconnects;
  }
  stamp(*frame, taken);
  return frame;
}

void Camera::stamp(Frame& frame, const Taken& taken) {
  if (!first_ns_) first_ns_ = taken.captured_ns;
  frame.number = next_number_++;
  frame.time_base = {1, 1'000'000};
  frame.pts = std::max((taken.captured_ns - *first_ns_) / 1000, last_pts_ + 1);
  last_pts_ = frame.pts;
  const Agreed& agreed = capture_->agreed();
  frame.duration = agreed.rate.num > 0 ? agreed.rate.den * 1'000'000 / agreed.rate.num : 0;
  frame.captured_ns = taken.captured_ns;
  frame.interlaced = agreed.interlaced;
  frame.top_field_first = agreed.top_field_first;
}

void Camera::lose(const std::string& why) {
  notice(why);
  returning_ = true;
  unpacker_.reset();
  capture_.reset();
}

void Camera::notice(const std::string& line) {
  std::lock_guard lock(mutex_);
  health_.notice = identity_.card + " " + line;
}

void Camera::look_for_it() {
  std::optional<Device> best;
  int best_likeness = 0;
  std::vector<std::string> paths = device_paths();
  if (std::find(paths.begin(), paths.end(), path_) == paths.end()) paths.push_back(path_);
  for (const std::string& path : paths) {
    try {
      Device device = open_device(path);
      const int like = likeness(identity_, device.identity);
      if (like <= best_likeness) continue;
      best_likeness = like;
      best.emplace(std::move(device));
    } catch (const Error&) {
      // No camera, or not yet.
    }
  }
  if (!best) return;
  try {
    set_controls(*best, options_.controls);
    start(std::move(*best), choice_);
    const Agreed& agreed = capture_->agreed();
    if (agreed.width_px != description_.format.width_px || agreed.height_px != description_.format.height_px) {
      lose("came back with pictures of " + size_text(agreed.width_px, agreed.height_px) + ", which don't fit");
    }
  } catch (const Error& error) {
    capture_.reset();
    notice(std::string("is back, but can't be used: ") + error.what());
  }
}

Health Camera::health() const {
  std::lock_guard lock(mutex_);
  return health_;
}

std::string Camera::damage() const {
  const Health now = health();
  std::string line;
  const auto add = [&line](std::int64_t count, const char* what) {
    if (count > 0) line += (line.empty() ? "" : ", ") + std::to_string(count) + what;
  };
  add(now.missed, " pictures were lost before they came here");
  add(now.damaged, " came damaged");
  add(now.reconnects, " times it was gone and came back");
  if (!now.notice.empty()) line += (line.empty() ? "" : "; ") + now.notice;
  return line.empty() ? line : path_ + ": " + line;
}

}  // namespace

std::unique_ptr<Source> open_camera(const CameraOptions& options) { return std::make_unique<Camera>(options); }

}  // namespace rinkaku::source::v4l2

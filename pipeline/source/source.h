#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/frame/frame.h"

namespace rinkaku::source {

/// What is known of a source before its first frame.
struct Description {
  std::string name{};                ///< path or device, for messages
  PictureFormat format;              ///< of the frames as they will come
  Rational time_base{1, 1};          ///< of Frame::pts
  std::int64_t first_pts = 0;        ///< of frame 0; many containers don't start at 0
  Rational frame_rate{0, 1};         ///< average, 0/1 if unknown
  bool variable_frame_rate = false;  ///< as far as the container tells
  std::int64_t frame_count = 0;      ///< an estimate, 0 if unknown
  int rotation_deg = 0;  ///< anticlockwise turn that players apply on show; samples are as stored, never turned
  bool live = false;
  /// One line on how the frames differ from what is stored (a pixel format that had to be converted); else empty.
  std::string notice{};

  double first_time_s() const { return static_cast<double>(first_pts) * time_base.value(); }
};

/// How a camera fares, counted since it was opened.
struct Health {
  std::string notice{};         ///< one line while something is wrong (unplugged, silent); empty while all is well
  std::int64_t frames = 0;      ///< delivered
  std::int64_t missed = 0;      ///< that the camera took and nobody got: gaps in its own count
  std::int64_t damaged = 0;     ///< that came with the driver's error mark or could not be decoded
  std::int64_t reconnects = 0;  ///< how often it came back after it was gone
};

/// Where filmed frames come from. Used from one thread at a time, but for what says otherwise.
class Source {
 public:
  virtual ~Source() = default;

  virtual const Description& description() const = 0;

  /// The next frame, numbered from 0; empty at the end of the stream.
  /// Throws Error if the device or file fails altogether; damaged frames are counted, not thrown.
  virtual std::optional<Frame> next() = 0;

  /// Once `stop` is true a next() that waits for a camera returns nothing within 0.1 s; files don't wait and ignore it.
  /// `stop` must outlive the source.
  virtual void stop_when(const std::atomic<bool>& /*stop*/) {}

  /// Any thread; recordings are always well.
  virtual Health health() const { return {}; }

  /// One line on what was damaged or missing so far; empty if nothing was.
  virtual std::string damage() const { return {}; }
};

struct OpenOptions {
  int threads = 0;             ///< decoder threads, 0 for as many as there are cores
  Rational image_rate{25, 1};  ///< frames per second of an image sequence, which carries no times
};

/// Opens a video file (anything the FFmpeg libraries decode) or an image sequence, told apart by the name: a printf
/// pattern ("frames/%04d.png") or a glob ("frames/*.png") is a sequence, in the pattern's or the names' order. A
/// pattern starts at the lowest number there is and stops before the first that is missing. A file of exactly that name
/// comes first. One still image is a video of one frame.
///
/// Decodes the first picture at once, since only that tells the format. Frames are the decoder's own memory and not
/// writable; formats whose components are no samples of their own (palettes, floating point, ...) are converted.
/// Throws Error (Input) if it can't be read or holds no picture.
std::unique_ptr<Source> open(const std::string& path, const OpenOptions& options = {});

/// The files that open() takes by that name: itself, or all of a sequence that there are. Throws Error (Input) if the
/// sequence's folder can't be read.
std::vector<std::string> input_files(const std::string& path);

}  // namespace rinkaku::source

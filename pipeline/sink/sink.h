#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "pipeline/frame/frame.h"

namespace rinkaku::sink {

/// What a sink needs to know of the frames that will come.
struct Incoming {
  PictureFormat format;
  Rational time_base{1, 1};
  Rational frame_rate{0, 1};
  bool variable_frame_rate = false;
  int rotation_deg = 0;  ///< see source::Description
  /// A file whose other streams (sound, subtitles, data), chapters and metadata are copied; empty for none.
  std::string copy_streams_from{};
};

struct Options {
  /// A video file, an image, a printf pattern of images ("out/%04d.png"), or "-" for standard output.
  std::string path{};
  /// FFmpeg's name of the encoder or codec ("libx264", "h264", "mpeg4", "ffv1", "ffvhuff", ...). Empty: by the ending,
  /// which is libx264 for .mp4, .mov and .mkv, mpeg4 for .avi, VP9 for .webm.
  std::string codec{};
  /// "y4m" or "raw" for standard output, or FFmpeg's name of any muxer. Empty: by the ending.
  std::string container{};
  std::int64_t bit_rate =
      0;            ///< bits/s; 0: a constant quality that looks lossless (libx264: crf 18, mpeg4: quantiser 3)
  int threads = 0;  ///< encoder threads, 0 for as many as there are cores
  bool overwrite = false;
  /// Made as it happens: the file bears its name from the start and can be played up to the last second whenever it is
  /// cut off (MP4 and MOV in fragments, Matroska in short clusters), and the encoder holds no frames back.
  bool recording = false;
};

/// Where finished frames go. Used from one thread at a time.
class Sink {
 public:
  virtual ~Sink() = default;

  /// Frames must come with rising numbers and times. Throws Error (Runtime) if writing fails (disk full, ...).
  virtual void write(const Frame& frame) = 0;

  /// Ends the output and puts it under its final name. To be called once, also after an interrupt, so that what was
  /// written is kept. A sink destroyed without it leaves nothing behind.
  virtual void finish() = 0;

  /// One line on what could not be kept exactly (a pixel format the codec doesn't take, ...); empty if nothing.
  virtual std::string notice() const { return {}; }
};

/// Opens a sink.
///
/// Frames go to the encoder as they are where it takes their format, else they are converted, which notice() says.
/// Times are kept as exactly as the container can (Matroska: 1 ms). If the first frame's number is not 0 the output is
/// a part of a video, which starts at 0 and gets the sound of just that part. Image files bear their frames' numbers.
/// Files are written under a hidden name beside the final one; devices and pipes are written directly.
/// Throws Error (Input) if the path can't be written, exists already (unless `overwrite`), or the codec
/// and container don't take such frames.
std::unique_ptr<Sink> open(const Options& options, const Incoming& incoming);

}  // namespace rinkaku::sink

#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/ffmpeg/handles.h"
#include "pipeline/ffmpeg/log.h"

namespace rinkaku::sink {

/// A moment in units of a time base.
struct Moment {
  std::int64_t value = 0;
  AVRational unit{1, 1};
};
inline bool operator<(const Moment& a, const Moment& b) { return av_compare_ts(a.value, a.unit, b.value, b.unit) < 0; }

/// Copies to a muxer what another file holds beside its pictures: sound, subtitles, data, chapters and metadata, not
/// decoded. Reads that file with a demuxer of its own. Times are the file's; all are moved by one shift.
class StreamCopy {
 public:
  /// Adds the streams to `muxer`, whose first stream is the video. Throws Error (Input) if the file can't be read.
  StreamCopy(const std::string& path, AVFormatContext& muxer);

  /// What the container doesn't take, one line; empty if all is copied.
  const std::string& notice() const { return notice_; }

  /// The time at which the file starts, if its clock starts anywhere (MPEG transport streams and their like); else 0.
  Moment arbitrary_start() const;

  /// To be called once before the muxer's header: output time = time - shift. What lies before `cut_before` is left
  /// out, as the pictures there are.
  void start(Moment shift, Moment cut_before, bool cut);

  /// Writes all packets before `until`. Returns FFmpeg's error code, or 0.
  int write_until(Moment until);

  /// Writes the rest: to the end if the file has no picture after `last`, else what comes before `end`.
  int finish(Moment last, Moment end);

 private:
  bool add_stream(AVStream& stream);
  void copy_video_side_data(const AVStream& from, AVStream& to) const;
  void copy_metadata();
  bool read(bool video_too);
  int write(AVPacket& packet);
  Moment time_of(const AVPacket& packet) const;

  std::string path_;
  AVFormatContext& muxer_;
  ffmpeg::InputPtr demuxer_;
  std::unique_ptr<ffmpeg::LogListener> listener_;
  int video_ = -1;
  std::vector<int> target_;              ///< per stream of the file, -1 if not copied
  std::vector<std::int64_t> last_dts_;   ///< per stream of the muxer
  std::vector<std::int64_t> next_time_;  ///< per stream of the file, where one that has no times goes on
  ffmpeg::PacketPtr packet_;             ///< read but not yet due, if waiting_
  bool waiting_ = false;
  bool cut_ = false;
  Moment shift_, cut_before_;
  std::string notice_;
};

}  // namespace rinkaku::sink

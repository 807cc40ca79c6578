#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pipeline/sink/sink.h"
#include "tests/pipeline/source/media_tools.h"
#include "tests/support/test_data.h"

namespace rinkaku::test {

inline sink::Incoming incoming(const source::Source& source) {
  const source::Description& d = source.description();
  return {d.format, d.time_base, d.frame_rate, d.variable_frame_rate, d.rotation_deg, {}};
}

inline sink::Incoming incoming(const PictureFormat& format, Rational rate = {25, 1}) {
  return {format, {rate.den, rate.num}, rate, false, 0, {}};
}

/// Writes frames to a sink, finishes it and gives its notice.
inline std::string write_all(const sink::Options& options, const sink::Incoming& coming,
                             const std::vector<Frame>& frames) {
  auto sink = sink::open(options, coming);
  for (const Frame& frame : frames) sink->write(frame);
  sink->finish();
  return sink->notice();
}

/// The whole file `from` through source and sink, everything else copied; gives the notice.
inline std::string transcode(const std::string& from, const sink::Options& options) {
  auto source = source::open(from);
  sink::Incoming coming = incoming(*source);
  coming.copy_streams_from = from;
  auto sink = sink::open(options, coming);
  while (auto frame = source->next()) sink->write(*frame);
  sink->finish();
  return sink->notice();
}

inline std::vector<Frame> noise_frames(const PictureFormat& format, int count, Rational time_base = {1, 25}) {
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) frames.push_back(noise(format, i, time_base));
  return frames;
}

inline bool is_empty(const std::filesystem::path& folder) { return std::filesystem::is_empty(folder); }

}  // namespace rinkaku::test

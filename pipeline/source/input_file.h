#pragma once

#include <cstdint>
#include <string>

#include "pipeline/ffmpeg/handles.h"
#include "pipeline/ffmpeg/log.h"
#include "pipeline/source/source.h"

namespace rinkaku::source {

/// What to give to the demuxer.
struct Input {
  std::string name;  ///< as the user gave it, for messages
  std::string url;
  bool image_sequence = false;
  std::int64_t first_number = 0;  ///< of a numbered sequence, -1 for a glob
  std::int64_t pictures = 0;      ///< of an image sequence: read so many, then stop
  std::string missing;            ///< one line on pictures that are not there
};

/// Tells file, numbered sequence and glob apart and checks that it can be read. Throws Error (Input).
Input find_input(const std::string& path);

/// A demuxer with its streams known. `listener` hears it from now on.
struct Demuxer {
  ffmpeg::InputPtr context;
  std::unique_ptr<ffmpeg::LogListener> listener;
  int video_stream = -1;
};

/// Opens the demuxer and picks the stream of pictures, all others are discarded. Throws Error (Input).
Demuxer open_demuxer(const Input& input, const OpenOptions& options);

/// A decoder for the picked stream, threads on. Throws Error (Input) if FFmpeg has none.
ffmpeg::CodecPtr open_decoder(const Input& input, const Demuxer& demuxer, const OpenOptions& options);

}  // namespace rinkaku::source

#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/ffmpeg/formats.h"
#include "pipeline/frame/error.h"
#include "pipeline/frame/frame.h"
#include "pipeline/source/source.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

namespace rinkaku::test {

/// Runs a command and gives what it prints; fails the test if its exit status is not 0.
inline std::string shell(const std::string& command) {
  std::string out;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) return out;
  std::array<char, 65536> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) out.append(buffer.data(), n);
  EXPECT_EQ(::pclose(pipe), 0) << command;
  return out;
}

inline void ffmpeg(const std::string& arguments) { shell("ffmpeg -nostdin -v error -y " + arguments); }

inline std::string ffprobe(const std::string& arguments, const std::string& file) {
  return shell("ffprobe -v error -of csv=p=0 " + arguments + " '" + file + "'");
}

/// The frames' samples as the ffmpeg program decodes them, all in one.
inline std::string decoded_by_ffmpeg(const std::string& file, const std::string& options = {}) {
  return shell("ffmpeg -nostdin -v error -i '" + file + "' -map 0:v:0 -vsync passthrough " + options +
               " -f rawvideo -");
}

inline std::vector<Frame> all_frames(source::Source& source) {
  std::vector<Frame> frames;
  while (auto frame = source.next()) frames.push_back(std::move(*frame));
  return frames;
}

/// The samples of a frame without the padding of its rows.
inline std::string samples(const Frame& frame) {
  std::string out;
  for (int p = 0; p < frame.format.pixels.planes; ++p) {
    const Plane& plane = frame.planes[static_cast<std::size_t>(p)];
    for (int y = 0; y < plane.rows; ++y) {
      out.append(reinterpret_cast<const char*>(plane.data + y * plane.stride_bytes),
                 static_cast<std::size_t>(plane.row_bytes));
    }
  }
  return out;
}

inline PictureFormat picture(const std::string& pixels, int width, int height, ColourTags colour = {}) {
  PictureFormat format;
  format.width_px = width;
  format.height_px = height;
  format.pixels = rinkaku::ffmpeg::to_pixel_format(av_get_pix_fmt(pixels.c_str()));
  format.colour = colour;
  format.sample_aspect = {1, 1};
  return format;
}

/// A frame of noise, each sample within its depth. Precondition: no sample has bits left of its own.
inline Frame noise(const PictureFormat& format, std::int64_t number, Rational time_base = {1, 25}) {
  FramePool pool;
  Frame frame = pool.allocate(format);
  frame.number = frame.pts = number;
  frame.duration = 1;
  frame.time_base = time_base;
  std::mt19937 random(static_cast<unsigned>(number) + 1);
  const int depth = format.pixels.component[0].depth_bits;
  for (int p = 0; p < format.pixels.planes; ++p) {
    const Plane& plane = frame.planes[static_cast<std::size_t>(p)];
    for (int y = 0; y < plane.rows; ++y) {
      std::uint8_t* row = plane.data + y * plane.stride_bytes;
      for (int i = 0; i < plane.row_bytes; ++i) {
        const bool upper = depth > 8 && (i & 1) == (format.pixels.big_endian ? 0 : 1);
        row[i] = static_cast<std::uint8_t>(random() & (upper ? (1u << (depth - 8)) - 1 : 255u));
      }
    }
  }
  return frame;
}

/// The line of the Error that `call` throws, which must be of that kind and one line; fails the test otherwise.
template <class Call>
std::string error_of(Error::Kind kind, const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    const std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos);
    return line;
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace rinkaku::test

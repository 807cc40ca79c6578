#pragma once

#include <cstdint>

#include "pipeline/ffmpeg/handles.h"
#include "pipeline/frame/picture_format.h"

namespace rinkaku::source {

/// Frames per second, the average that the container tells or else a guess; 0/1 if unknown.
Rational frame_rate(AVFormatContext& container, AVStream& stream);

/// Whether frames come at uneven times, by the container's index where it has all frames, else by what its first
/// packets and its stated rate show (Matroska may claim an even rate for uneven frames).
bool variable_frame_rate(const AVFormatContext& container, AVStream& stream);

/// How many pictures there are, 0 if unknown.
std::int64_t frame_count(const AVFormatContext& container, AVStream& stream, Rational frame_rate);

/// The anticlockwise turn, in whole degrees of 0 to 359, that the stream's or the first picture's display matrix asks
/// for.
int rotation_deg(const AVStream& stream, const AVFrame& first);

/// By how many seconds the stream is shorter than its container says, `end` being the end of its last packet; 0 if it
/// is whole or nothing is known.
double missing_seconds(const AVFormatContext& container, const AVStream& stream, std::int64_t end);

}  // namespace rinkaku::source

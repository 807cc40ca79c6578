#pragma once

#include <cstdint>

namespace rinkaku::test {

/// A camera that isn't there: this object, linked into a test or preloaded into a program, answers for the path in
/// FAKE_CAMERA as a driver would. It takes pictures at an even beat and stamps them with the beat's own times.
///
///     FAKE_CAMERA=PATH            where it is
///     FAKE_CAMERA_FORMATS=YUYV    its formats, comma-separated, each at 640x480, 320x240 and FAKE_CAMERA_SIZE
///     FAKE_CAMERA_SIZE=WxH        one more size, its first
///     FAKE_CAMERA_FPS=30          its only rate
///     FAKE_CAMERA_FRAMES=FILE     its pictures, one after the other and again; without it fake_sample()
///     FAKE_CAMERA_UNPLUG_EVERY=N  it is gone after N pictures, for FAKE_CAMERA_AWAY_MS=200
///     FAKE_CAMERA_BREAK_EVERY=N   after N pictures the stream fails (EIO) until it is started anew
///     FAKE_CAMERA_SILENT_AFTER=N  after N pictures none comes until the stream is started anew
///     FAKE_CAMERA_LOSE_EVERY=N    every Nth picture is lost on the way: a gap in the count
///     FAKE_CAMERA_DAMAGE_EVERY=N  every Nth picture is marked as damaged
///
///     FAKE_OUTPUT=FILE            a file that answers as a video output device: what is written to it stays
///
/// For one open camera and one thread at a time.

/// Byte `i` of the pictures it makes up, by the driver's count.
inline std::uint8_t fake_sample(std::uint32_t sequence, std::size_t i) {
  return static_cast<std::uint8_t>(i * 7 + i / 251 + sequence * 13);
}

}  // namespace rinkaku::test

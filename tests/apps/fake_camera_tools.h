#pragma once

#include <string>

// Sanitizers must come first among preloaded libraries, and refuse to run.
#ifdef RINKAKU_SANITIZED
#define NEEDS_PRELOAD() GTEST_SKIP() << "sanitized programs take no preloaded library before their own"
#else
#define NEEDS_PRELOAD() static_cast<void>(0)
#endif

namespace rinkaku::test {

inline constexpr const char* fake_camera_path = "/dev/rinkaku_fake_camera";

/// What stands before a command in a shell so that it finds a camera that isn't there; see fake_camera.h.
inline std::string preloaded(const std::string& settings) {
  return "env LD_PRELOAD='" RINKAKU_FAKE_CAMERA "' FAKE_CAMERA=" + std::string(fake_camera_path) + " " + settings;
}

inline const std::string live_scene =
    "[plate]\ndevice = \"" + std::string(fake_camera_path) + "\"\nsize_px = [640, 480]\n";

}  // namespace rinkaku::test

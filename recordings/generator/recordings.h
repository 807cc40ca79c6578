#pragma once

#include <filesystem>

namespace rinkaku::recordings {

/// Frames to make; fewer are for trying out.
struct FrameRange {
  int first = 0;
  int last = 1 << 30;  ///< exclusive
};

/// recordings/desk: a board of markers among things on a desk, filmed by a hand-held camera.
void make_desk(const std::filesystem::path& folder, FrameRange frames);

/// recordings/tripod: a room from a locked camera, somebody walks through.
void make_tripod(const std::filesystem::path& folder, FrameRange frames);

/// recordings/brook: a dry brook below a cliff from a locked camera, for painted water.
void make_brook(const std::filesystem::path& folder, FrameRange frames);

}  // namespace rinkaku::recordings

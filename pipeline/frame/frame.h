#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "pipeline/frame/picture_format.h"

namespace rinkaku {

/// One plane of a picture in memory.
struct Plane {
  std::uint8_t* data = nullptr;
  std::ptrdiff_t stride_bytes = 0;
  int row_bytes = 0;  ///< bytes of a row that hold samples
  int rows = 0;
};

/// One filmed picture on its way from source to sink, under one number.
///
/// A value with shared storage: copying a Frame copies no sample. Whoever wants to write into the planes calls
/// FramePool::make_writable() first. Crosses threads freely.
struct Frame {
  std::int64_t number = 0;    ///< counted by the source from 0; the same everywhere in the pipeline
  std::int64_t pts = 0;       ///< presentation time in units of time_base
  std::int64_t duration = 0;  ///< in units of time_base, 0 if unknown
  Rational time_base{1, 1};
  /// When a camera took it, in nanoseconds of the system's monotonic clock; 0 for recordings.
  std::int64_t captured_ns = 0;
  /// The frame before once more, because what is drawn on it changed while it was looked at.
  bool repeated = false;
  bool key = false;  ///< a key frame in the source
  bool interlaced = false;
  bool top_field_first = false;
  PictureFormat format;
  std::array<Plane, 4> planes{};
  std::shared_ptr<void> storage;  ///< keeps the planes alive
  /// The storage is memory of our own, not a decoder's. It may be written as long as no copy of the frame shares it,
  /// which make_writable() sees to: the flag is copied along and says nothing about copies.
  bool writable = false;

  double time_s() const { return static_cast<double>(pts) * time_base.value(); }
};

/// Storage for pictures, reused once the frames that hold it are gone, so that a warm pipeline allocates nothing.
/// Thread-safe; frames may outlive the pool.
class FramePool {
 public:
  FramePool();

  /// A frame of this format with unset samples, rows aligned to 64 bytes, writable.
  Frame allocate(const PictureFormat& format);

  /// Gives the frame storage of its own (samples copied) unless it has it already: writable, and held by this frame
  /// alone. Copies made later share the storage again.
  void make_writable(Frame& frame);

 private:
  struct Shelf;
  std::shared_ptr<Shelf> shelf_;
};

/// Fills in row_bytes and rows of a frame's planes from its format.
void set_plane_sizes(Frame& frame);

}  // namespace rinkaku

#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "pipeline/gl/handle.h"

namespace rinkaku::gl {

/// Memory on the GL side that is filled once.
class StaticBuffer {
 public:
  StaticBuffer() = default;
  explicit StaticBuffer(std::span<const std::byte> bytes);
  GLuint name() const { return handle_.name(); }

 private:
  BufferHandle handle_;
};

/// Memory on the GL side that shaders or transform feedback write. Its contents are unset at first.
class StorageBuffer {
 public:
  StorageBuffer() = default;
  explicit StorageBuffer(std::size_t size_bytes);
  GLuint name() const { return handle_.name(); }
  /// Copies the first bytes.size() bytes to `bytes`. Waits for what was dispatched before to end.
  void read(std::span<std::byte> bytes) const;

 private:
  BufferHandle handle_;
};

/// Memory on the GL side that is filled anew every frame: several buffers in turn, so that writing does not wait for
/// drawing that still reads the last one, and nothing is allocated once they are large enough.
class StreamBuffer {
 public:
  StreamBuffer();
  /// Fills the next buffer and makes it the current one.
  void write(std::span<const std::byte> bytes);
  /// The same with what `write(std::span<std::byte>)` puts there, right into the driver's memory: every byte, and
  /// reading none. Throws Error (Failure) if the driver loses it again and again.
  template <typename Write>
  void fill(std::size_t size_bytes, const Write& write) {
    for (int tries = 0; tries < 3; ++tries) {
      write(map(size_bytes));
      if (unmap()) return;
    }
    lost();
  }
  /// The current buffer; another one after each write().
  GLuint name() const { return ring_[current_].handle.name(); }

 private:
  struct Slot {
    BufferHandle handle;
    std::size_t capacity_bytes = 0;
  };
  Slot& next(std::size_t size_bytes);
  std::span<std::byte> map(std::size_t size_bytes);
  /// False if the driver lost what was written.
  bool unmap();
  [[noreturn]] static void lost();

  std::array<Slot, 3> ring_;
  std::size_t current_ = 0;
  bool mapped_ = false;
};

}  // namespace rinkaku::gl

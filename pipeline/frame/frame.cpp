#include "pipeline/frame/frame.h"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <new>
#include <vector>

namespace rinkaku {
namespace {

constexpr std::size_t alignment = 64;  // a cache line, and the widest vector registers
// Codecs read whole vectors past a row's end.
constexpr std::size_t padding = 64;

struct AlignedFree {
  void operator()(std::uint8_t* p) const { ::operator delete[](p, std::align_val_t{alignment}); }
};

struct Block {
  std::size_t size = 0;
  std::unique_ptr<std::uint8_t[], AlignedFree> bytes;
};

std::ptrdiff_t aligned_stride(int row_bytes) {
  return static_cast<std::ptrdiff_t>((static_cast<std::size_t>(row_bytes) + alignment - 1) / alignment * alignment);
}

// Whether nobody else holds this storage. Taking a reference and giving it back (an atomic operation that acquires)
// makes sure that whoever held it before, on whichever thread, is done with the samples.
bool held_once(const std::shared_ptr<void>& storage) { return std::shared_ptr<void>(storage).use_count() == 2; }

bool always(const void*) { return true; }

}  // namespace

struct FramePool::Shelf {
  // More than a pipeline's queues hold is never kept.
  static constexpr std::size_t most_kept = 16;
  std::mutex mutex;
  std::vector<Block> free;

  Block take(std::size_t size) {
    {
      std::lock_guard lock(mutex);
      auto found = std::find_if(free.begin(), free.end(), [&](const Block& b) { return b.size == size; });
      if (found != free.end()) {
        Block block = std::move(*found);
        free.erase(found);
        return block;
      }
    }
    Block block;
    block.size = size;
    block.bytes.reset(static_cast<std::uint8_t*>(::operator new[](size, std::align_val_t{alignment})));
    return block;
  }

  void give_back(Block block) {
    std::lock_guard lock(mutex);
    if (free.size() >= most_kept) free.erase(free.begin());
    free.push_back(std::move(block));
  }
};

FramePool::FramePool() : shelf_(std::make_shared<Shelf>()) {}

void set_plane_sizes(Frame& frame) {
  const PixelFormat& pixels = frame.format.pixels;
  for (int p = 0; p < pixels.planes; ++p) {
    Plane& plane = frame.planes[p];
    plane.row_bytes = 0;
    plane.rows = 0;
    for (int c = 0; c < pixels.components; ++c) {
      const Component& component = pixels.component[c];
      if (component.plane != p) continue;
      // The widest component of the plane decides: packed 4:2:2 holds chroma at twice the step of luma.
      plane.row_bytes = std::max(plane.row_bytes, component.step_bytes * frame.format.component_width_px(c));
      plane.rows = std::max(plane.rows, frame.format.component_height_px(c));
    }
  }
}

Frame FramePool::allocate(const PictureFormat& format) {
  Frame frame;
  frame.format = format;
  set_plane_sizes(frame);
  std::size_t size = padding;
  std::array<std::size_t, 4> offset{};
  for (int p = 0; p < format.pixels.planes; ++p) {
    Plane& plane = frame.planes[p];
    plane.stride_bytes = aligned_stride(plane.row_bytes);
    offset[p] = size - padding;
    size += static_cast<std::size_t>(plane.stride_bytes) * plane.rows;
  }
  Block block = shelf_->take(size);
  for (int p = 0; p < format.pixels.planes; ++p) frame.planes[p].data = block.bytes.get() + offset[p];
  void* address = block.bytes.get();
  auto shelf = shelf_;
  auto shared_block = std::make_shared<Block>(std::move(block));
  frame.storage =
      std::shared_ptr<void>(address, [shelf, shared_block](void*) { shelf->give_back(std::move(*shared_block)); });
  frame.let_go = always;
  return frame;
}

void FramePool::make_writable(Frame& frame) {
  if (frame.let_go && held_once(frame.storage) && frame.let_go(frame.storage.get())) return;
  Frame own = allocate(frame.format);
  for (int p = 0; p < frame.format.pixels.planes; ++p) {
    const Plane& from = frame.planes[p];
    const Plane& to = own.planes[p];
    for (int y = 0; y < to.rows; ++y) {
      std::memcpy(to.data + y * to.stride_bytes, from.data + y * from.stride_bytes,
                  static_cast<std::size_t>(to.row_bytes));
    }
  }
  frame.planes = own.planes;
  frame.storage = std::move(own.storage);
  frame.let_go = always;
}

}  // namespace rinkaku

#include "pipeline/gl/buffer.h"

#include <string>
#include <utility>

#include "pipeline/frame/error.h"
#include "pipeline/gl/count.h"

namespace rinkaku::gl {
namespace {

GLuint create() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  ++counters().buffers;
  return name;
}

}  // namespace

StaticBuffer::StaticBuffer(std::span<const std::byte> bytes) : handle_(create()) {
  glNamedBufferStorage(handle_.name(), static_cast<GLsizeiptr>(bytes.size()), bytes.data(), 0);
}

StorageBuffer::StorageBuffer(std::size_t size_bytes) : handle_(create()) {
  glNamedBufferStorage(handle_.name(), static_cast<GLsizeiptr>(size_bytes), nullptr, 0);
}

void StorageBuffer::read(std::span<std::byte> bytes) const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(handle_.name(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

StreamBuffer::StreamBuffer() {
  for (Slot& slot : ring_) slot.handle = BufferHandle(create());
}

StreamBuffer::Slot& StreamBuffer::next(std::size_t size_bytes) {
  current_ = (current_ + 1) % ring_.size();
  Slot& slot = ring_[current_];
  if (size_bytes > slot.capacity_bytes) {
    slot.capacity_bytes = size_bytes + size_bytes / 2;
    glNamedBufferData(slot.handle.name(), static_cast<GLsizeiptr>(slot.capacity_bytes), nullptr, GL_STREAM_DRAW);
  }
  return slot;
}

void StreamBuffer::write(std::span<const std::byte> bytes) {
  const Slot& slot = next(bytes.size());
  if (!bytes.empty()) glNamedBufferSubData(slot.handle.name(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

std::span<std::byte> StreamBuffer::map(std::size_t size_bytes) {
  if (size_bytes == 0) return {};
  void* memory = glMapNamedBufferRange(next(size_bytes).handle.name(), 0, static_cast<GLsizeiptr>(size_bytes),
                                       GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
  if (memory == nullptr) {
    throw runtime_failure("OpenGL", "gives no memory for " + std::to_string(size_bytes) + " bytes",
                          "close other programs, or draw a smaller mesh");
  }
  mapped_ = true;
  return {static_cast<std::byte*>(memory), size_bytes};
}

void StreamBuffer::lost() { throw runtime_failure("OpenGL", "the driver loses what is written for it"); }

bool StreamBuffer::unmap() { return !std::exchange(mapped_, false) || glUnmapNamedBuffer(name()) == GL_TRUE; }

}  // namespace rinkaku::gl

#include "pipeline/gl/buffer.h"

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

void StreamBuffer::write(std::span<const std::byte> bytes) {
  current_ = (current_ + 1) % ring_.size();
  Slot& slot = ring_[current_];
  if (bytes.size() > slot.capacity_bytes) {
    slot.capacity_bytes = bytes.size() + bytes.size() / 2;
    glNamedBufferData(slot.handle.name(), static_cast<GLsizeiptr>(slot.capacity_bytes), nullptr, GL_STREAM_DRAW);
  }
  if (!bytes.empty()) glNamedBufferSubData(slot.handle.name(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

}  // namespace rinkaku::gl

#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

namespace rinkaku::pipeline {

/// What a full queue does with one value more: recordings wait for room, live pictures are worth nothing once old.
enum class WhenFull { Wait, DropOldest };

/// Hands values from one thread to the next and keeps at most `capacity` of them waiting: a full queue makes its
/// producer wait, or drops the value that waits longest. What a producer throws comes out at the consumer's side, after
/// the values before it.
template <typename T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}
  /// `dropped` counts what WhenFull::DropOldest drops, and outlives the queue.
  BoundedQueue(std::size_t capacity, WhenFull when_full, std::atomic<std::int64_t>& dropped)
      : capacity_(capacity), when_full_(when_full), dropped_(&dropped) {}

  /// False if the consumer has gone; the value is then dropped.
  bool push(T value) {
    std::unique_lock lock(mutex_);
    if (when_full_ == WhenFull::Wait) {
      room_.wait(lock, [this] { return abandoned_ || values_.size() < capacity_; });
    }
    if (abandoned_) return false;
    while (values_.size() >= capacity_) {
      values_.pop_front();
      ++*dropped_;
    }
    values_.push_back(std::move(value));
    lock.unlock();
    filled_.notify_one();
    return true;
  }

  /// The producer's last word: no value follows, because of `reason` if there is one.
  void end(std::exception_ptr reason = nullptr) {
    {
      std::lock_guard lock(mutex_);
      ended_ = true;
      reason_ = std::move(reason);
    }
    filled_.notify_all();
  }

  /// The next value; empty after the last. Throws what the producer ended with.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [this] { return ended_ || !values_.empty(); });
    if (values_.empty()) {
      if (reason_) std::rethrow_exception(reason_);
      return std::nullopt;
    }
    std::optional<T> value(std::move(values_.front()));
    values_.pop_front();
    lock.unlock();
    room_.notify_one();
    return value;
  }

  /// The consumer takes no more: push() returns false from now on.
  void abandon() {
    {
      std::lock_guard lock(mutex_);
      abandoned_ = true;
      values_.clear();
    }
    room_.notify_all();
  }

 private:
  const std::size_t capacity_;
  const WhenFull when_full_ = WhenFull::Wait;
  std::atomic<std::int64_t>* const dropped_ = nullptr;
  std::mutex mutex_;
  std::condition_variable room_, filled_;
  std::deque<T> values_;
  bool ended_ = false;
  bool abandoned_ = false;
  std::exception_ptr reason_;
};

}  // namespace rinkaku::pipeline

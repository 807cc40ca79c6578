#include "pipeline/bounded_queue.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace rinkaku::pipeline {
namespace {

using namespace std::chrono_literals;

// Long enough for a thread that is free to run to do so on a busy machine; a test that waits it out has not failed.
constexpr auto a_while = 50ms;

TEST(BoundedQueue, HandsOverInOrderAcrossThreads) {
  constexpr int count = 20000;
  BoundedQueue<int> queue(3);
  std::thread producer([&queue] {
    for (int i = 0; i < count; ++i) queue.push(i);
    queue.end();
  });
  std::vector<int> got;
  while (const auto value = queue.pop()) got.push_back(*value);
  producer.join();
  ASSERT_EQ(got.size(), static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) ASSERT_EQ(got[static_cast<std::size_t>(i)], i);
}

TEST(BoundedQueue, FullQueueMakesItsProducerWait) {
  BoundedQueue<int> queue(2);
  std::atomic<int> pushed{0};
  std::thread producer([&] {
    for (int i = 0; i < 5; ++i) {
      queue.push(i);
      ++pushed;
    }
    queue.end();
  });
  while (pushed < 2) std::this_thread::yield();
  std::this_thread::sleep_for(a_while);
  EXPECT_EQ(pushed, 2);  // the third waits
  EXPECT_EQ(queue.pop(), 0);
  while (pushed < 3) std::this_thread::yield();
  std::this_thread::sleep_for(a_while);
  EXPECT_EQ(pushed, 3);  // one place was made, one value came
  while (queue.pop()) {
  }
  producer.join();
}

TEST(BoundedQueue, LiveQueueDropsTheOldestAndNeverWaits) {
  std::atomic<std::int64_t> dropped{0};
  BoundedQueue<int> queue(2, WhenFull::DropOldest, dropped);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(queue.push(i));
  queue.end();
  EXPECT_EQ(dropped, 8);
  EXPECT_EQ(queue.pop(), 8);
  EXPECT_EQ(queue.pop(), 9);
  EXPECT_FALSE(queue.pop());
}

TEST(BoundedQueue, EmptyQueueMakesItsConsumerWait) {
  BoundedQueue<int> queue(2);
  std::atomic<bool> got{false};
  std::thread consumer([&] {
    EXPECT_EQ(queue.pop(), 7);
    got = true;
  });
  std::this_thread::sleep_for(a_while);
  EXPECT_FALSE(got);
  queue.push(7);
  consumer.join();
}

TEST(BoundedQueue, EndComesAfterTheLastValueAndStays) {
  BoundedQueue<int> queue(4);
  queue.push(1);
  queue.push(2);
  queue.end();
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(), std::nullopt);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, EndReleasesAWaitingConsumer) {
  BoundedQueue<int> queue(4);
  std::thread consumer([&queue] { EXPECT_EQ(queue.pop(), std::nullopt); });
  std::this_thread::sleep_for(a_while);
  queue.end();
  consumer.join();
}

TEST(BoundedQueue, ExceptionComesAfterTheValuesBeforeIt) {
  BoundedQueue<int> queue(4);
  std::thread producer([&queue] {
    try {
      queue.push(1);
      throw std::runtime_error("the disk is gone");
    } catch (...) {
      queue.end(std::current_exception());
    }
  });
  EXPECT_EQ(queue.pop(), 1);
  try {
    queue.pop();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the disk is gone");
  }
  producer.join();
}

TEST(BoundedQueue, AbandonReleasesAWaitingProducer) {
  BoundedQueue<int> queue(1);
  queue.push(1);
  std::thread producer([&queue] { EXPECT_FALSE(queue.push(2)); });
  std::this_thread::sleep_for(a_while);
  queue.abandon();
  producer.join();
  EXPECT_FALSE(queue.push(3));
}

TEST(BoundedQueue, AbandonFreesWhatWaited) {
  BoundedQueue<std::shared_ptr<int>> queue(2);
  const auto value = std::make_shared<int>(1);
  queue.push(value);
  EXPECT_EQ(value.use_count(), 2);
  queue.abandon();
  EXPECT_EQ(value.use_count(), 1);
}

TEST(BoundedQueue, TakesValuesThatOnlyMove) {
  BoundedQueue<std::unique_ptr<int>> queue(1);
  EXPECT_TRUE(queue.push(std::make_unique<int>(5)));
  const auto value = queue.pop();
  ASSERT_TRUE(value.has_value());
  EXPECT_EQ(**value, 5);
}

}  // namespace
}  // namespace rinkaku::pipeline

#include <atomic>
#include <cstdint>
#include <optional>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "pipeline/frame/frame.h"

namespace rinkaku {
namespace {

PictureFormat yuv420(int width_px, int height_px) {
  PictureFormat format;
  format.width_px = width_px;
  format.height_px = height_px;
  format.pixels.name = "yuv420p";
  format.pixels.log2_chroma_width = format.pixels.log2_chroma_height = 1;
  for (int c = 0; c < 3; ++c) format.pixels.component[c].plane = c;
  return format;
}

// Luma every two bytes, chroma every four, one plane.
PictureFormat yuyv(int width_px, int height_px) {
  PictureFormat format = yuv420(width_px, height_px);
  format.pixels.name = "yuyv422";
  format.pixels.planes = 1;
  format.pixels.log2_chroma_height = 0;
  format.pixels.component = {Component{0, 2, 0, 0, 8}, Component{0, 4, 1, 0, 8}, Component{0, 4, 3, 0, 8}, Component{}};
  return format;
}

void fill(const Frame& frame, int seed) {
  for (int p = 0; p < frame.format.pixels.planes; ++p) {
    for (int y = 0; y < frame.planes[p].rows; ++y) {
      for (int x = 0; x < frame.planes[p].row_bytes; ++x) {
        frame.planes[p].data[y * frame.planes[p].stride_bytes + x] =
            static_cast<std::uint8_t>(seed + p * 71 + y * 13 + x * 3);
      }
    }
  }
}

bool holds(const Frame& frame, int seed) {
  for (int p = 0; p < frame.format.pixels.planes; ++p) {
    for (int y = 0; y < frame.planes[p].rows; ++y) {
      for (int x = 0; x < frame.planes[p].row_bytes; ++x) {
        if (frame.planes[p].data[y * frame.planes[p].stride_bytes + x] !=
            static_cast<std::uint8_t>(seed + p * 71 + y * 13 + x * 3)) {
          return false;
        }
      }
    }
  }
  return true;
}

TEST(FramePool, PlanesOfOddSizesAreRoundedUp) {
  FramePool pool;
  const Frame frame = pool.allocate(yuv420(35, 29));
  EXPECT_EQ(frame.planes[0].row_bytes, 35);
  EXPECT_EQ(frame.planes[0].rows, 29);
  EXPECT_EQ(frame.planes[1].row_bytes, 18);
  EXPECT_EQ(frame.planes[2].rows, 15);
  const Frame packed = pool.allocate(yuyv(35, 29));
  EXPECT_EQ(packed.planes[0].row_bytes, 72);  // 18 groups of Y U Y V
  EXPECT_EQ(packed.planes[0].rows, 29);
}

TEST(FramePool, RowsAreAlignedAndApart) {
  FramePool pool;
  for (int width : {1, 35, 64, 65, 1280}) {
    const Frame frame = pool.allocate(yuv420(width, 7));
    EXPECT_TRUE(frame.let_go && frame.let_go(frame.storage.get()));
    const std::uint8_t* end = nullptr;
    for (int p = 0; p < 3; ++p) {
      const Plane& plane = frame.planes[p];
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(plane.data) % 64, 0u);
      EXPECT_EQ(plane.stride_bytes % 64, 0);
      EXPECT_GE(plane.stride_bytes, plane.row_bytes);
      EXPECT_GE(plane.data, end);
      end = plane.data + plane.stride_bytes * plane.rows;
    }
    fill(frame, width);
    EXPECT_TRUE(holds(frame, width));
  }
}

TEST(FramePool, FramesInUseNeverShareStorage) {
  FramePool pool;
  std::vector<Frame> frames;
  for (int i = 0; i < 20; ++i) {
    frames.push_back(pool.allocate(yuv420(40, 30)));
    fill(frames.back(), i);
  }
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(holds(frames[static_cast<std::size_t>(i)], i));
}

TEST(FramePool, AWarmPoolUsesTheSameStorageAgain) {
  FramePool pool;
  std::set<const std::uint8_t*> warm;
  for (int i = 0; i < 3; ++i) {
    const Frame a = pool.allocate(yuv420(40, 30)), b = pool.allocate(yuv420(40, 30));
    if (i == 0) {
      warm = {a.planes[0].data, b.planes[0].data};
    } else {
      EXPECT_TRUE(warm.contains(a.planes[0].data) && warm.contains(b.planes[0].data));
    }
  }
}

TEST(FramePool, AnotherSizeGetsStorageOfItsOwn) {
  FramePool pool;
  const std::uint8_t* small = pool.allocate(yuv420(40, 30)).planes[0].data;
  const Frame large = pool.allocate(yuv420(400, 300));
  fill(large, 3);  // a sanitizer would see it run over
  EXPECT_TRUE(holds(large, 3));
  EXPECT_EQ(pool.allocate(yuv420(40, 30)).planes[0].data, small);
}

TEST(FramePool, MakeWritableCopiesASharedFrameOnce) {
  FramePool pool;
  Frame source = pool.allocate(yuyv(35, 29));
  fill(source, 9);
  source.number = 12;
  source.pts = 99;
  source.let_go = nullptr;
  Frame own = source;
  pool.make_writable(own);
  EXPECT_TRUE(holds(own, 9));
  EXPECT_EQ(own.number, 12);
  EXPECT_EQ(own.pts, 99);
  EXPECT_NE(own.planes[0].data, source.planes[0].data);
  fill(own, 50);
  EXPECT_TRUE(holds(source, 9));
  const std::uint8_t* data = own.planes[0].data;
  pool.make_writable(own);
  EXPECT_EQ(own.planes[0].data, data);
}

TEST(FramePool, MakeWritableGivesACopyOfAWritableFrameItsOwnStorage) {
  FramePool pool;
  std::optional<Frame> first = pool.allocate(yuv420(35, 29));
  fill(*first, 9);
  Frame copy = *first;
  pool.make_writable(copy);
  EXPECT_NE(copy.planes[0].data, first->planes[0].data);
  fill(copy, 50);
  EXPECT_TRUE(holds(*first, 9));
  // Moved on, or left behind by its copies: again the only one, so nothing is copied.
  Frame last = *first;
  first.reset();
  const std::uint8_t* data = last.planes[0].data;
  pool.make_writable(last);
  EXPECT_EQ(last.planes[0].data, data);
  Frame moved = std::move(last);
  pool.make_writable(moved);
  EXPECT_EQ(moved.planes[0].data, data);
}

// Decoders hand out pictures whose rows run upwards.
TEST(FramePool, MakeWritableTurnsNegativeStridesRound) {
  FramePool pool;
  Frame source = pool.allocate(yuv420(35, 29));
  Frame flipped = source;
  flipped.let_go = nullptr;
  for (int p = 0; p < 3; ++p) {
    flipped.planes[p].data += flipped.planes[p].stride_bytes * (flipped.planes[p].rows - 1);
    flipped.planes[p].stride_bytes *= -1;
  }
  fill(flipped, 4);
  pool.make_writable(flipped);
  EXPECT_TRUE(holds(flipped, 4));
}

TEST(FramePool, FramesOutliveThePool) {
  std::optional<FramePool> pool(std::in_place);
  Frame frame = pool->allocate(yuv420(40, 30));
  pool.reset();
  fill(frame, 1);
  EXPECT_TRUE(holds(frame, 1));
}

TEST(FramePool, CopiesShareStorageUntilTheLastIsGone) {
  FramePool pool;
  Frame a = pool.allocate(yuv420(40, 30));
  fill(a, 5);
  const Frame b = a;
  EXPECT_EQ(b.planes[0].data, a.planes[0].data);
  a = {};
  const Frame other = pool.allocate(yuv420(40, 30));
  EXPECT_NE(other.planes[0].data, b.planes[0].data);
  EXPECT_TRUE(holds(b, 5));
}

// Frames are made on one thread and given back on another. A data race would show under ThreadSanitizer, a block handed
// out twice as a frame that lost its samples.
TEST(FramePool, ServesSeveralThreads) {
  FramePool pool;
  std::atomic<int> spoilt{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&pool, &spoilt, t] {
      for (int i = 0; i < 300; ++i) {
        const Frame a = pool.allocate(yuv420(24, 10));
        fill(a, t);
        Frame b = a;
        b.let_go = nullptr;
        pool.make_writable(b);
        if (!holds(a, t) || !holds(b, t)) ++spoilt;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(spoilt, 0);
}

}  // namespace
}  // namespace rinkaku

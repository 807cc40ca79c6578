#include "pipeline/matte/estimator.h"

#include <algorithm>
#include <cstring>

#include "pipeline/matte/count.h"

namespace rinkaku::matte {
namespace {

// The first pixel from `from` on that isn't 0, or `end`.
int first_covered(const std::uint8_t* row, int from, int end) {
  int x = from;
  for (std::uint64_t eight; x + 8 <= end; x += 8) {
    std::memcpy(&eight, row + x, 8);
    if (eight != 0) break;
  }
  while (x < end && row[x] == 0) ++x;
  return x;
}

int last_covered(const std::uint8_t* row, int from, int end) {
  int x = end;
  for (std::uint64_t eight; x - 8 >= from; x -= 8) {
    std::memcpy(&eight, row + x - 8, 8);
    if (eight != 0) break;
  }
  while (x > from && row[x - 1] == 0) --x;
  return x;
}

}  // namespace

void begin_matte(const Frame& frame, Matte& matte) {
  ++counters().mattes;
  matte.frame_number = frame.number;
  matte.width_px = frame.format.width_px;
  matte.height_px = frame.format.height_px;
  matte.rect = matte.line_rect = {};  // the matte may have been another thing's, which had a line
  matte.line.clear();
  matte.alpha.assign(static_cast<std::size_t>(matte.width_px) * matte.height_px, 0);
  matte.own_rgb.resize(matte.alpha.size() * 3);
}

void find_rect(Matte& matte) {
  int left = matte.width_px, right = 0, top = matte.height_px, bottom = 0;
  for (int y = 0; y < matte.height_px; ++y) {
    const std::uint8_t* row = matte.alpha_row(y);
    const int first = first_covered(row, 0, matte.width_px);
    if (first == matte.width_px) continue;
    left = std::min(left, first);
    right = std::max(right, last_covered(row, first, matte.width_px));
    top = std::min(top, y);
    bottom = y + 1;
  }
  matte.rect = right > left ? PixelRect{left, top, right - left, bottom - top} : PixelRect{};
}

}  // namespace rinkaku::matte

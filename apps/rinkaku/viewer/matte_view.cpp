#include "apps/rinkaku/viewer/matte_view.h"

#include <algorithm>
#include <cstring>

namespace rinkaku::app {
namespace {

void add_matte(const Matte& matte, const Plane& plane) {
  for (int y = matte.rect.y_px; y < matte.rect.bottom_px(); ++y) {
    const std::uint8_t* from = matte.alpha_row(y);
    std::uint8_t* to = plane.data + y * plane.stride_bytes;
    for (int x = matte.rect.x_px; x < matte.rect.right_px(); ++x) to[x] = std::max(to[x], from[x]);
  }
}

void add_layer(const passes::Layer& layer, const Plane& plane) {
  const PixelRect& rect = layer.rect;
  for (int y = 0; y < rect.height_px; ++y) {
    const std::uint8_t* from = layer.rgba.data() + static_cast<std::size_t>(y) * rect.width_px * 4;
    std::uint8_t* to = plane.data + (rect.y_px + y) * plane.stride_bytes + rect.x_px;
    for (int x = 0; x < rect.width_px; ++x) to[x] = from[4 * x + 3];
  }
}

}  // namespace

Frame matte_view(const pipeline::Work& work, FramePool& pool) {
  PictureFormat format = work.frame.format;
  format.pixels = grey8();
  format.colour.range = ColourTags::Range::Full;
  Frame view = pool.allocate(format);
  view.number = work.frame.number;
  view.pts = work.frame.pts;
  view.duration = work.frame.duration;
  view.time_base = work.frame.time_base;
  view.captured_ns = work.frame.captured_ns;
  view.repeated = work.frame.repeated;
  const Plane& plane = view.planes[0];
  for (int y = 0; y < plane.rows; ++y) std::memset(plane.data + y * plane.stride_bytes, 0, plane.row_bytes);
  for (const Matte& matte : work.mattes) add_matte(matte, plane);
  if (work.mattes.empty()) add_layer(work.layer, plane);
  return view;
}

}  // namespace rinkaku::app

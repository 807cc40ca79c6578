#include "silhouette/verify/matte_comparison.h"

#include <algorithm>

namespace rinkaku::silhouette {

glm::dmat4 clip_from_object(const CheckView& view) {
  const CameraModel& camera = view.view.camera;
  const passes::PixelRect picture{0, 0, camera.width_px, camera.height_px};
  // From right to left the camera's place and the object's cancel out in double before anything is rounded.
  return passes::clip_from_camera(camera, picture) * (to_matrix(view.view.camera_from_world) * view.world_from_object);
}

MatteComparison::MatteComparison(const Surface& surface) : full_(full_list(surface)), pass_(surface.points) {}

DrawTime MatteComparison::draw(const CheckView& view, std::span<const std::uint32_t> indices,
                               std::vector<std::uint8_t>& matte) {
  const int width_px = view.view.camera.width_px, height_px = view.view.camera.height_px;
  const glm::dmat4 matrix = clip_from_object(view);
  pass_.set_triangles(indices);
  const DrawTime time = draw_time([&] {
    target_.begin(width_px, height_px);
    pass_.draw(matrix);
  });
  matte.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  target_.read(width_px, height_px, matte.data());
  return time;
}

MatteDifference MatteComparison::compare(const CheckView& view, std::span<const std::uint32_t> indices) {
  MatteDifference out;
  out.full = draw(view, full_, full_matte_);
  out.other = draw(view, indices, other_matte_);
  if (full_matte_ != other_matte_) {
    for (std::size_t i = 0; i < full_matte_.size(); ++i) out.mismatch_px += full_matte_[i] != other_matte_[i] ? 1 : 0;
  }
  out.has_edge = std::adjacent_find(full_matte_.begin(), full_matte_.end(), std::not_equal_to<>()) != full_matte_.end();
  return out;
}

}  // namespace rinkaku::silhouette

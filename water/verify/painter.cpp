#include "water/verify/painter.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace rinkaku::water {

Painter::Painter(const River& river, const ReferencePicture& reference, const PaintingOptions& options)
    : river_(river),
      reference_(reference),
      painting_(*river.surface, river.arrows, {}, river.outlook(), options),
      renderer_({}, {0, 0, river.camera.width_px, river.camera.height_px}) {
  auto pass = std::make_unique<WaterPass>(line_brushes(), drop_brushes());
  pass_ = pass.get();
  renderer_.add(std::move(pass));
}

const Strokes& Painter::strokes(std::int64_t frame) {
  return painting_.paint(frame, river_.camera, river_.camera_from_world,
                         [this]() -> const ReferencePicture& { return reference_; });
}

const passes::Layer& Painter::draw(const Strokes& strokes) {
  const PaintedSurface painted{river_.surface.get(), strokes};
  pass_->show({&painted, 1}, {}, {});
  renderer_.draw({river_.camera, river_.camera_from_world}, layer_);
  return layer_;
}

void over_grey(const passes::Layer& layer, const CameraModel& camera, std::vector<glm::vec3>& picture) {
  const auto width = static_cast<std::size_t>(camera.width_px);
  picture.assign(width * camera.height_px, glm::vec3(0.5f));
  const std::uint8_t* s = layer.rgba.data();
  for (int y = 0; y < layer.rect.height_px; ++y) {
    for (int x = 0; x < layer.rect.width_px; ++x, s += 4) {
      picture[static_cast<std::size_t>(y + layer.rect.y_px) * width + x + layer.rect.x_px] =
          glm::vec3(s[0], s[1], s[2]) / 255.0f + 0.5f * (1 - s[3] / 255.0f);
    }
  }
}

}  // namespace rinkaku::water

#include "outline/fluffy/transmission.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pipeline/frame/error.h"

namespace rinkaku::fluffy {
namespace {

// How much a texel stands out, 0 to 1: its luminance, or what it lacks of white.
class Relief {
 public:
  Relief(const mesh::Texture& texture, bool darker) : width_(texture.width_px), height_(texture.height_px) {
    const std::size_t count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    values_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint8_t* c = texture.rgba.data() + i * 4;
      const float luminance = (0.2126f * static_cast<float>(c[0]) + 0.7152f * static_cast<float>(c[1]) +
                               0.0722f * static_cast<float>(c[2])) /
                              255.0f;
      values_[i] = darker ? 1 - luminance : luminance;
    }
    sorted_ = values_;
    std::sort(sorted_.begin(), sorted_.end());
  }

  std::size_t size() const { return values_.size(); }
  float operator[](std::size_t i) const { return values_[i]; }

  // By how much it changes from one texel to the next; the texture repeats.
  float slope(std::size_t i) const {
    const int x = static_cast<int>(i % static_cast<std::size_t>(width_));
    const int y = static_cast<int>(i / static_cast<std::size_t>(width_));
    const glm::vec2 twice(at((x + 1) % width_, y) - at((x + width_ - 1) % width_, y),
                          at(x, (y + 1) % height_) - at(x, (y + height_ - 1) % height_));
    return 0.5f * glm::length(twice);
  }

  double share_above(double threshold) const {
    const auto first = std::upper_bound(sorted_.begin(), sorted_.end(), static_cast<float>(threshold));
    return static_cast<double>(sorted_.end() - first) / static_cast<double>(sorted_.size());
  }

  // The threshold above which this share lies.
  float threshold_of(double share) const {
    const auto last = static_cast<double>(sorted_.size() - 1);
    return sorted_[static_cast<std::size_t>(std::clamp((1 - share) * last, 0.0, last))];
  }

 private:
  float at(int x, int y) const {
    return values_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }

  int width_, height_;
  std::vector<float> values_, sorted_;
};

std::uint8_t unorm(float value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255)); }

}  // namespace

TransmissionImage make_transmission(const mesh::Texture& texture, const TransmissionOptions& options,
                                    const char* where) {
  const bool darker = options.keep == TransmissionOptions::Keep::Below;
  const Relief relief(texture, darker);
  const double lowest = darker ? 1 - options.threshold : options.threshold;
  TransmissionImage image;
  image.width_px = texture.width_px;
  image.height_px = texture.height_px;
  image.layers = options.layers;
  image.kept = relief.share_above(lowest);
  if (image.kept <= 0) throw input_error(where, "the threshold leaves nothing of the texture", "move 'threshold'");
  if (image.kept >= 1) throw input_error(where, "the threshold leaves all of the texture", "move 'threshold'");

  // Flatter than this, texels are cut sharply.
  constexpr float least_slope = 1.0f / 128;
  std::vector<float> slopes(relief.size());
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = std::max(relief.slope(i), least_slope);
  image.rgba.resize(relief.size() * 4 * static_cast<std::size_t>(options.layers));
  std::uint8_t* out = image.rgba.data();
  for (int layer = 0; layer < options.layers; ++layer) {
    const double left = std::pow(1 - static_cast<double>(layer) / options.layers, options.taper);
    const float threshold = layer == 0 ? static_cast<float>(lowest) : relief.threshold_of(image.kept * left);
    for (std::size_t i = 0; i < relief.size(); ++i, out += 4) {
      const float alpha = std::clamp(0.5f + (relief[i] - threshold) / slopes[i], 0.0f, 1.0f);
      glm::vec3 colour(1 - static_cast<float>(options.contrast) * (1 - relief[i]));
      if (options.paint == TransmissionOptions::Paint::Texture) {
        const std::uint8_t* c = texture.rgba.data() + i * 4;
        colour = glm::vec3(c[0], c[1], c[2]) / 255.0f;
      }
      for (int c = 0; c < 3; ++c) out[c] = unorm(colour[c] * alpha);
      out[3] = unorm(alpha);
    }
  }
  return image;
}

}  // namespace rinkaku::fluffy

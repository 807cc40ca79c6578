#include "outline/fluffy/transmission.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "outline/fluffy/fur_textures.h"
#include "pipeline/frame/error.h"

namespace rinkaku::test {
namespace {

using fluffy::TransmissionImage;
using fluffy::TransmissionOptions;

// Grey from 0 at the left to 255 at the right, each column a shade.
mesh::Texture ramp() {
  mesh::Texture texture;
  texture.width_px = 256, texture.height_px = 4;
  for (int i = 0; i < 256 * 4; ++i) {
    const auto grey = static_cast<std::uint8_t>(i % 256);
    texture.rgba.insert(texture.rgba.end(), {grey, grey, grey, 255});
  }
  return texture;
}

int alpha_at(const TransmissionImage& image, int layer, int x) {
  return image.rgba[(static_cast<std::size_t>(layer) * image.height_px * image.width_px + x) * 4 + 3];
}

double mean_alpha(const TransmissionImage& image, int layer) {
  const std::size_t count = static_cast<std::size_t>(image.width_px) * image.height_px;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += image.rgba[(layer * count + i) * 4 + 3];
  return sum / 255 / static_cast<double>(count);
}

TEST(Transmission, KeepsWhatIsAboveTheThreshold) {
  TransmissionOptions options;
  options.layers = 1;
  options.threshold = 0.25;
  const TransmissionImage image = make_transmission(ramp(), options, "scene");
  EXPECT_EQ(alpha_at(image, 0, 62), 0);  // 0.25 is at 63.75; the edge is a texel wide
  EXPECT_EQ(alpha_at(image, 0, 65), 255);
  EXPECT_NEAR(image.kept, 0.75, 1.0 / 256);
}

TEST(Transmission, KeepsWhatIsBelowTheThreshold) {
  TransmissionOptions options;
  options.layers = 1;
  options.threshold = 0.25;
  options.keep = TransmissionOptions::Keep::Below;
  const TransmissionImage image = make_transmission(ramp(), options, "scene");
  EXPECT_EQ(alpha_at(image, 0, 62), 255);
  EXPECT_EQ(alpha_at(image, 0, 65), 0);
  EXPECT_NEAR(image.kept, 0.25, 1.0 / 256);
}

TEST(Transmission, LayersKeepAPowerOfWhatIsLeftAbove) {
  TransmissionOptions options;
  options.layers = 5;
  options.threshold = 0.4;
  options.taper = 2;
  const TransmissionImage image = make_transmission(fur_texture(fluffy::FurKind::Fur), options, "scene");
  for (int layer = 0; layer < 5; ++layer) {
    const double expected = 0.6 * std::pow(1 - layer / 5.0, 2);
    // Shades are 1/256 apart; half-transparent edges are as long inside as outside, but for curvature.
    EXPECT_NEAR(mean_alpha(image, layer), expected, 0.012) << layer;
  }
}

TEST(Transmission, IsPremultipliedSoTransparentTexelsHaveNoColour) {
  for (const auto paint : {TransmissionOptions::Paint::Tone, TransmissionOptions::Paint::Texture}) {
    TransmissionOptions options;
    options.paint = paint;
    options.layers = 3;
    const TransmissionImage image = make_transmission(fur_texture(fluffy::FurKind::Wool), options, "scene");
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
      ASSERT_LE(std::max({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]}), image.rgba[i + 3]);
    }
  }
}

TEST(Transmission, TextureKeepsItsOwnColour) {
  mesh::Texture texture = ramp();
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4) texture.rgba[i + 2] = 0;  // yellow
  TransmissionOptions options;
  options.layers = 1;
  options.paint = TransmissionOptions::Paint::Texture;
  const TransmissionImage image = make_transmission(texture, options, "scene");
  const std::size_t right = (256 - 10) * 4;
  EXPECT_EQ(image.rgba[right], 246);
  EXPECT_EQ(image.rgba[right + 1], 246);
  EXPECT_EQ(image.rgba[right + 2], 0);
}

TEST(Transmission, RefusesAThresholdThatCutsNothingOrEverything) {
  for (const double threshold : {0.0, 1.0}) {
    mesh::Texture grey = ramp();
    std::fill(grey.rgba.begin(), grey.rgba.end(), std::uint8_t{128});
    TransmissionOptions options;
    options.threshold = threshold;
    try {
      make_transmission(grey, options, "scene.toml:9:1: fluffy");
      FAIL() << threshold;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("scene.toml:9:1"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("threshold"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace rinkaku::test

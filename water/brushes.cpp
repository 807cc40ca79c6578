#include "water/brushes.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "water/scatter.h"

namespace rinkaku::water {
namespace {

double smooth(double edge0, double edge1, double x) {
  const double t = std::clamp((x - edge0) / (edge1 - edge0), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

struct Texel {
  double paint = 0, light = 0, weight = 0;
};

void store(BrushSheet& sheet, const std::vector<Texel>& texels) {
  for (const Texel& t : texels) {
    const double light = t.weight > 0 ? t.light / t.weight : 0;
    sheet.texels.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(t.paint, 0.0, 1.0))));
    sheet.texels.push_back(static_cast<std::uint8_t>(std::lround(128 + 127 * std::clamp(light, -1.0, 1.0))));
  }
  ++sheet.layers;
}

// One hair's line across the brush.
void add_line(std::vector<Texel>& texels, const BrushSheet& size, std::uint64_t seed, double middle, double width,
              double paint) {
  const double begin = 0.10 * scattered(seed, 1), end = 1 - 0.16 * scattered(seed, 2);
  const double light = 2 * scattered(seed, 3) - 1;
  const double wave = 0.02 * (scattered(seed, 4) - 0.5), phase = 6.28 * scattered(seed, 5);
  const double dry = scattered(seed, 6);  // where the hair runs out of paint
  for (int y = 0; y < size.height_px; ++y) {
    for (int x = 0; x < size.width_px; ++x) {
      const double u = (x + 0.5) / size.width_px, v = (y + 0.5) / size.height_px;
      const double off = std::abs(v - middle - wave * std::sin(3 * u + phase)) / width;
      if (off >= 1) continue;
      const double ends = smooth(begin, begin + 0.05, u) * (1 - smooth(end - 0.2 * dry - 0.03, end, u));
      const double p = paint * ends * (1 - smooth(0.45, 1, off));
      Texel& t = texels[static_cast<std::size_t>(y) * size.width_px + x];
      t.paint += (1 - t.paint) * p;
      t.light += light * p;
      t.weight += p;
    }
  }
}

}  // namespace

BrushSheet line_brushes() {
  BrushSheet sheet;
  for (int density = 0; density < brush_densities; ++density) {
    for (int variant = 0; variant < brush_variants; ++variant) {
      std::vector<Texel> texels(static_cast<std::size_t>(sheet.width_px) * sheet.height_px);
      const int lines = 7 + 4 * density;
      const std::uint64_t brush = static_cast<std::uint64_t>(density * brush_variants + variant) * 64;
      for (int i = 0; i < lines; ++i) {
        const std::uint64_t seed = brush + static_cast<std::uint64_t>(i);
        const double middle = 0.05 + 0.90 * (i + 0.2 + 0.6 * scattered(seed, 7)) / lines;
        const double width = (0.6 + 0.6 * scattered(seed, 8)) * (0.085 + 0.007 * density);
        add_line(texels, sheet, seed, middle, width, 0.6 + 0.4 * scattered(seed, 9));
      }
      store(sheet, texels);
    }
  }
  return sheet;
}

BrushSheet drop_brushes() {
  BrushSheet sheet;
  sheet.width_px = sheet.height_px = 64;
  for (int variant = 0; variant < brush_variants; ++variant) {
    std::vector<Texel> texels(static_cast<std::size_t>(sheet.width_px) * sheet.height_px);
    for (int i = 0; i < 22; ++i) {
      const std::uint64_t seed = 4096u + static_cast<std::uint64_t>(variant * 64 + i);
      const double angle = 6.2831853 * scattered(seed, 1), out = 0.36 * std::sqrt(scattered(seed, 2));
      const double cx = 0.5 + out * std::cos(angle), cy = 0.5 + out * std::sin(angle);
      const double radius = 0.03 + 0.09 * scattered(seed, 3) * (1 - out);
      for (int y = 0; y < sheet.height_px; ++y) {
        for (int x = 0; x < sheet.width_px; ++x) {
          const double d = std::hypot((x + 0.5) / sheet.width_px - cx, (y + 0.5) / sheet.height_px - cy) / radius;
          if (d >= 1) continue;
          Texel& t = texels[static_cast<std::size_t>(y) * sheet.width_px + x];
          const double p = 0.8 * (1 - smooth(0.5, 1, d));
          t.paint += (1 - t.paint) * p;
          t.weight += p;
        }
      }
    }
    store(sheet, texels);
  }
  return sheet;
}

BrushSheet own_brushes(std::span<const Picture> pictures) {
  BrushSheet sheet;
  for (const Picture& p : pictures) {
    std::vector<Texel> texels(static_cast<std::size_t>(sheet.width_px) * sheet.height_px);
    for (int y = 0; y < sheet.height_px; ++y) {
      for (int x = 0; x < sheet.width_px; ++x) {
        // The mean of what the texel covers.
        const int x0 = x * p.width_px / sheet.width_px, y0 = y * p.height_px / sheet.height_px;
        const int x1 = std::max(x0 + 1, (x + 1) * p.width_px / sheet.width_px);
        const int y1 = std::max(y0 + 1, (y + 1) * p.height_px / sheet.height_px);
        double sum = 0;
        for (int j = y0; j < y1; ++j) {
          for (int i = x0; i < x1; ++i) {
            const std::uint8_t* s = p.samples.data() + (static_cast<std::size_t>(j) * p.width_px + i) * p.channels;
            const double luma = (0.2126 * s[0] + 0.7152 * s[1] + 0.0722 * s[2]) / 255;
            sum += luma * (p.channels == 4 ? s[3] / 255.0 : 1);
          }
        }
        texels[static_cast<std::size_t>(y) * sheet.width_px + x] = {sum / ((x1 - x0) * (y1 - y0)), 0, 1};
      }
    }
    store(sheet, texels);
  }
  return sheet;
}

std::array<std::uint8_t, 4> brush_shares(std::span<const glm::dvec2> places, glm::dvec2 at) {
  std::array<double, 4> weight{};
  double sum = 0;
  const std::size_t count = std::min(places.size(), weight.size());
  for (std::size_t i = 0; i < count; ++i) {
    weight[i] = 1 / std::max(glm::distance(places[i], at), 1e-9);
    sum += weight[i];
  }
  std::array<std::uint8_t, 4> shares{};
  int left = 255;
  for (std::size_t i = 0; i < count; ++i) {
    shares[i] =
        static_cast<std::uint8_t>(i + 1 == count ? left : std::min<long>(left, std::lround(255 * weight[i] / sum)));
    left -= shares[i];
  }
  return shares;
}

}  // namespace rinkaku::water

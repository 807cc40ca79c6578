#include "recordings/generator/textures.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

#include "recordings/generator/noise.h"
#include "recordings/generator/parallel.h"
#include "recordings/generator/random.h"

namespace rinkaku::recordings {
namespace {

template <class Colour>
cv::Mat3b fill(int width_px, int height_px, const Colour& colour) {
  cv::Mat3b out(height_px, width_px);
  parallel_for(height_px, [&](int y) {
    for (int x = 0; x < width_px; ++x) {
      const cv::Vec3f c = colour(static_cast<float>(x), static_cast<float>(y));
      for (int i = 0; i < 3; ++i) out(y, x)[i] = cv::saturate_cast<uchar>(c[i]);
    }
  });
  return out;
}

cv::Vec3f mix(cv::Vec3f a, cv::Vec3f b, float t) { return a + (b - a) * std::clamp(t, 0.0f, 1.0f); }

// A line as a pen draws it by hand.
void pen(cv::Mat3b& page, cv::Point2f from, cv::Point2f to, cv::Scalar ink, float wobble_px, unsigned seed) {
  constexpr int steps = 24;
  std::vector<cv::Point> points;
  for (int i = 0; i <= steps; ++i) {
    const float t = static_cast<float>(i) / steps;
    const float w = wobble_px * noise({5 * t, static_cast<float>(seed) * 3.7f}, 77);
    const cv::Point2f p = from + (to - from) * t + cv::Point2f(-0.3f * w, w);
    points.emplace_back(cvRound(p.x * 16), cvRound(p.y * 16));
  }
  cv::polylines(page, points, false, ink, 2, cv::LINE_AA, 4);
}

void scribble_words(cv::Mat3b& page, cv::Rect area, float line_px, cv::Scalar ink, unsigned seed) {
  float y = static_cast<float>(area.y);
  for (unsigned row = 0; y < static_cast<float>(area.br().y); y += line_px, ++row) {
    float x = static_cast<float>(area.x);
    const float end = static_cast<float>(area.br().x) - static_cast<float>(area.width) * 0.35f * uniform({seed, row});
    for (unsigned word = 0; x < end; ++word) {
      const float length = line_px * (0.8f + 2.2f * uniform({seed, row, word}));
      std::vector<cv::Point> points;
      for (float s = 0; s < length; s += 1.5f) {
        const float wave = std::sin(s / line_px * 24 + 3 * noise({s / line_px * 5, static_cast<float>(word)}, seed));
        const float tall =
            0.16f + 0.26f * std::max(0.0f, noise({s / line_px * 4, static_cast<float>(row + 31 * word)}, seed + 1));
        points.emplace_back(cvRound((x + s + 0.05f * line_px * wave) * 16),
                            cvRound((y - line_px * (0.12f + tall * wave * 0.8f)) * 16));
      }
      if (points.size() > 1) cv::polylines(page, points, false, ink, 2, cv::LINE_AA, 4);
      x += length + 0.45f * line_px;
    }
  }
}

}  // namespace

cv::Mat3b wood(int width_px, int height_px, float px_per_m, cv::Vec3b light, cv::Vec3b dark, float plank_m,
               unsigned seed) {
  const cv::Vec3f pale(light), deep(dark);
  return fill(width_px, height_px, [&](float px, float py) {
    const float x = px / px_per_m, y = py / px_per_m;
    const float row = std::floor(y / plank_m), across = y - row * plank_m;
    const unsigned plank = static_cast<unsigned>(static_cast<int>(row) + 100);
    const float offset = 7.3f * static_cast<float>(plank);
    // Growth rings cut lengthwise: distance from a wandering heart, with finer streaks and pores on top.
    const float wander = 0.020f * noise({1.6f * x + offset, 0.7f * y + offset}, seed) +
                         0.005f * noise({7 * x, 9 * y + offset}, seed + 1);
    const float heart = plank_m * (0.2f + 0.6f * uniform({plank, seed}));
    const float radius =
        std::hypot((across - heart + wander) * 1.0f, 0.018f + 0.012f * noise({1.1f * x + offset, 3.0f}, seed + 2));
    const float cloud = fractal_noise({2.2f * x + offset, 9 * y}, 3, seed + 6);
    const float ring = 0.5f + 0.5f * std::sin(radius * 640 + 3.0f * noise({3 * x + offset, 40 * y}, seed + 3) +
                                              4 * noise({1.3f * x + offset, 14 * y}, seed + 8));
    const float streak = fractal_noise({5 * x + offset, 260 * y}, 4, seed + 4);
    const float pore = std::max(0.0f, noise({60 * x + offset, 1500 * y}, seed + 5) - 0.38f);
    const float tone = 0.30f * ring * ring * ring * (0.7f + 0.6f * cloud) + 0.26f * streak + 0.9f * pore +
                       0.16f * cloud + 0.24f * uniform({plank, seed, 9});
    const float seam = glm::smoothstep(0.0f, 0.0011f, std::min(across, plank_m - across));
    return mix(pale, deep, tone) * (0.45f + 0.55f * seam);
  });
}

cv::Mat3b plaster(int width_px, int height_px, float px_per_m, cv::Vec3b colour, float roughness, unsigned seed) {
  const cv::Vec3f base(colour);
  return fill(width_px, height_px, [&](float px, float py) {
    const glm::vec2 p(px / px_per_m, py / px_per_m);
    const float tone =
        1 + roughness * (0.6f * fractal_noise(p * 90.0f, 3, seed) + 0.5f * fractal_noise(p * 3.0f, 3, seed + 7));
    return base * tone;
  });
}

cv::Mat3b cloth(int width_px, int height_px, float px_per_thread, cv::Vec3b warp, cv::Vec3b weft, unsigned seed) {
  return fill(width_px, height_px, [&](float px, float py) {
    const float u = px / px_per_thread, v = py / px_per_thread;
    const bool over = (static_cast<int>(u) + static_cast<int>(v)) % 2 == 0;
    const float round = over ? std::sin(3.14159f * (u - std::floor(u))) : std::sin(3.14159f * (v - std::floor(v)));
    const float tone = 0.72f + 0.26f * round + 0.10f * fractal_noise({u * 0.2f, v * 0.2f}, 3, seed);
    return cv::Vec3f(over ? warp : weft) * tone;
  });
}

cv::Mat3b page_edges(int width_px, int height_px, unsigned seed) {
  return fill(width_px, height_px, [&](float x, float y) {
    const float line = noise({x * 0.004f, y * 0.9f}, seed);
    return cv::Vec3f(196, 218, 228) * (0.90f + 0.16f * line);
  });
}

cv::Mat3b book_cover(int width_px, int height_px, cv::Vec3b colour, const std::string& title, bool moon,
                     unsigned seed) {
  const float w = static_cast<float>(width_px), h = static_cast<float>(height_px);
  const cv::Vec3f base(colour);
  cv::Mat3b cover = fill(width_px, height_px, [&](float x, float y) {
    const float weave =
        0.05f * std::sin(x * 1.4f) * std::sin(y * 1.4f) + 0.05f * fractal_noise({x * 0.01f, y * 0.01f}, 3, seed);
    const float hinge = 1 - 0.35f * std::exp(-std::pow((x - 0.055f * w) / (0.008f * w), 2.0f));
    return base * ((1 + weave) * hinge);
  });
  const cv::Scalar foil(150, 205, 228);
  if (moon) {
    // Layered hills under a moon.
    cv::circle(cover, cv::Point2f(0.66f * w, 0.36f * h), cvRound(0.11f * h), cv::Scalar(170, 225, 245), -1,
               cv::LINE_AA);
    for (int hill = 0; hill < 3; ++hill) {
      std::vector<cv::Point> outline{{cvRound(0.12f * w), cvRound(0.93f * h)}};
      for (int i = 0; i <= 60; ++i) {
        const float t = static_cast<float>(i) / 60, level = 0.52f + 0.13f * static_cast<float>(hill);
        outline.emplace_back(cvRound((0.12f + 0.82f * t) * w),
                             cvRound((level + 0.10f * noise({4 * t, static_cast<float>(hill) * 9}, seed)) * h));
      }
      outline.emplace_back(cvRound(0.94f * w), cvRound(0.93f * h));
      const double shade = 0.85 - 0.22 * hill;
      cv::fillPoly(cover, std::vector{outline}, cv::Scalar(base[0], base[1] * 1.15, base[2] * 1.3) * shade,
                   cv::LINE_AA);
    }
  }
  cv::rectangle(cover, cv::Rect2f(0.12f * w, 0.07f * h, 0.82f * w, 0.86f * h), foil, 3, cv::LINE_AA);
  const double scale = h / 620.0 * 2.0;
  int baseline = 0;
  const cv::Size size = cv::getTextSize(title, cv::FONT_HERSHEY_COMPLEX, scale, 4, &baseline);
  cv::putText(cover, title, {cvRound(0.53f * w) - size.width / 2, cvRound(0.22f * h)}, cv::FONT_HERSHEY_COMPLEX, scale,
              foil, 4, cv::LINE_AA);
  cv::GaussianBlur(cover, cover, {}, 0.8);
  return cover;
}

cv::Mat3b notebook_page(int width_px, int height_px, unsigned seed) {
  cv::Mat3b page = plaster(width_px, height_px, 3000, {228, 242, 246}, 0.025f, seed);
  const float line = static_cast<float>(height_px) / 30;
  for (int i = 3; i < 30; ++i) {
    const int y = cvRound(line * static_cast<float>(i));
    cv::line(page, {0, y}, {width_px, y}, cv::Scalar(222, 208, 190), 1, cv::LINE_AA);
  }
  cv::line(page, {width_px / 7, 0}, {width_px / 7, height_px}, cv::Scalar(170, 160, 225), 2, cv::LINE_AA);
  const cv::Scalar ink(118, 62, 40);
  scribble_words(page, {width_px / 6, cvRound(5 * line), width_px * 7 / 10, cvRound(7.2f * line)}, line, ink, seed);
  scribble_words(page, {width_px / 6, cvRound(22 * line), width_px * 7 / 10, cvRound(5.2f * line)}, line, ink,
                 seed + 5);
  // A sketch of a box in perspective, with arrows.
  const float w = static_cast<float>(width_px), x = 0.32f * w, y = 14.2f * line, s = 4.4f * line;
  const cv::Point2f a(x, y), b(x + 1.3f * s, y - 0.1f * s), c(x + 1.35f * s, y + 1.2f * s),
      d(x + 0.02f * s, y + 1.3f * s);
  const cv::Point2f back(0.55f * s, -0.5f * s);
  unsigned stroke = 0;
  for (const auto& [p, q] : {std::pair{a, b},
                             {b, c},
                             {c, d},
                             {d, a},
                             {a + back, b + back},
                             {b + back, c + back},
                             {a, a + back},
                             {b, b + back},
                             {c, c + back}}) {
    pen(page, p, q, ink, 5, seed + stroke++);
  }
  cv::circle(page, cv::Point2f(x + 2.7f * s, y + 0.5f * s), cvRound(0.5f * s), cv::Scalar(70, 80, 200), 2, cv::LINE_AA);
  pen(page, {x + 2.7f * s, y + 0.5f * s}, {x + 1.45f * s, y + 0.6f * s}, cv::Scalar(70, 80, 200), 4, seed + 40);
  return page;
}

cv::Mat3b sticky_note(int size_px, const std::string& words, unsigned seed) {
  cv::Mat3b note = plaster(size_px, size_px, 3000, {112, 222, 250}, 0.02f, seed);
  const double scale = size_px / 230.0;
  int row = 0;
  for (std::size_t start = 0; start < words.size(); ++row) {
    const std::size_t end = std::min(words.find('\n', start), words.size());
    cv::putText(note, words.substr(start, end - start), {size_px / 9, cvRound(size_px * (0.30 + 0.23 * row))},
                cv::FONT_HERSHEY_SCRIPT_SIMPLEX, scale, cv::Scalar(70, 50, 45), std::max(2, size_px / 130),
                cv::LINE_AA);
    start = end + 1;
  }
  return note;
}

cv::Mat3b glazed_mug(int width_px, int height_px, unsigned seed) {
  const float h = static_cast<float>(height_px), w = static_cast<float>(width_px);
  return fill(width_px, height_px, [&](float x, float y) {
    // Around the mug the noise closes up.
    const float a = 6.2831853f * x / w;
    const glm::vec3 p(2.2f * std::cos(a), 2.2f * std::sin(a), 3 * y / h);
    const float edge = 0.40f + 0.035f * fractal_noise(p, 3, seed);
    const float speck = glm::smoothstep(0.50f, 0.62f, noise(p * 22.0f, seed + 4));
    const cv::Vec3f glaze = mix({138, 116, 52}, {176, 152, 84}, 0.5f + 0.5f * fractal_noise(p * 1.5f, 3, seed + 2));
    const cv::Vec3f clay = mix({206, 222, 232}, {120, 150, 176}, speck * 0.7f);
    return mix(glaze, clay, glm::smoothstep(edge, edge + 0.025f, y / h));
  });
}

cv::Mat3b leaf(int width_px, int height_px, unsigned seed) {
  return fill(width_px, height_px, [&](float x, float y) {
    const float tone = 0.5f + 0.5f * fractal_noise({x * 0.03f, y * 0.05f}, 3, seed);
    return mix({92, 150, 104}, {70, 112, 66}, tone);
  });
}

}  // namespace rinkaku::recordings

#include "pipeline/matte/chroma.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/matte/known_background.h"
#include "pipeline/matte/picture.h"

namespace rinkaku::matte {
namespace {

constexpr int cells_across = 32;
constexpr float least_chroma = 16;  // of a colour that can be a screen's, in 8-bit levels

std::uint8_t level(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f); }

// The commonest strong colour (Y, Cb, Cr); pixels at the left, right and top border count four times.
std::optional<cv::Vec3f> commonest_colour(const Picture& picture) {
  constexpr int bins = 64;
  struct Bin {
    double weight = 0;
    cv::Vec3d sum{0, 0, 0};
  };
  std::vector<Bin> histogram(bins * bins);
  const int width = picture.width_px(), height = picture.height_px();
  for (int y = 0; y < height; y += 2) {
    for (int x = 0; x < width; x += 2) {
      const cv::Vec3f c = picture.ycc(x, y);
      const float cb = c[1] - 128, cr = c[2] - 128;
      if (cb * cb + cr * cr < least_chroma * least_chroma) continue;
      const bool border = x < width / 10 || x > width * 9 / 10 || y < height / 10;
      Bin& bin = histogram[static_cast<std::size_t>(c[1] / 4) * bins + static_cast<std::size_t>(c[2] / 4)];
      bin.weight += border ? 4 : 1;
      bin.sum += cv::Vec3d(c) * (border ? 4.0 : 1.0);
    }
  }
  const auto most = std::max_element(histogram.begin(), histogram.end(),
                                     [](const Bin& a, const Bin& b) { return a.weight < b.weight; });
  const double all = static_cast<double>(width) * height / 4;
  if (most->weight < 0.02 * all) return std::nullopt;
  return cv::Vec3f(most->sum / most->weight);
}

// A hue to be keyed.
struct Key {
  cv::Vec3f colour;    // Y Cb Cr
  float u = 0, v = 0;  // the hue's direction in (Cb, Cr)
  float across;        // what chroma across the hue takes away

  Key(const cv::Vec3f& ycc, double hue_deg) : colour(ycc) {
    const float cb = ycc[1] - 128, cr = ycc[2] - 128, length = std::hypot(cb, cr);
    u = cb / length, v = cr / length;
    across = static_cast<float>(1 / std::tan(hue_deg * std::numbers::pi / 180));
  }
  // How much screen is in a chroma; above 0 only within hue_deg of the key's hue.
  float amount(float cb, float cr) const {
    const float x = (cb - 128) * u + (cr - 128) * v, z = (cr - 128) * u - (cb - 128) * v;
    return std::max(0.f, x - across * std::abs(z));
  }
};

}  // namespace

struct ChromaMatte::State {
  ChromaOptions options;
  PictureReader reader;
  std::optional<Key> key;
  cv::Mat raw;  // CV_32F on the chroma grid: 1 thing, 0 screen, not clipped
  cv::Mat alpha, full_alpha, core, core_alpha;
  KnownBackground known;
  cv::Mat rough, keyed, screen_wide;
  cv::Mat weight, screen, screen_cells, weight_cells, screen_here;  // of the screen's colour, place by place

  void measure_screen(const Picture& picture);
  void find_alpha(const Picture& picture);
  void solve_border(const Picture& picture, Matte& matte);
  void find_colours(const Picture& picture, Matte& matte) const;
};

ChromaMatte::ChromaMatte(const ChromaOptions& options) : state_(std::make_unique<State>()) {
  state_->options = options;
}
ChromaMatte::~ChromaMatte() = default;

// The screen's colour on the chroma grid, from where surely nothing else is.
void ChromaMatte::State::measure_screen(const Picture& picture) {
  const cv::Size size = picture.cb.size();
  weight.create(size, CV_32F);
  screen.create(size, CV_32FC3);
  const float whole = key->amount(key->colour[1], key->colour[2]);
  for (int y = 0; y < size.height; ++y) {
    const auto *cb = picture.cb.ptr<std::uint8_t>(y), *cr = picture.cr.ptr<std::uint8_t>(y);
    const auto* luma = picture.luma.ptr<std::uint8_t>(std::min(y << picture.log2_chroma_height, picture.luma.rows - 1));
    float* w = weight.ptr<float>(y);
    auto* s = screen.ptr<cv::Vec3f>(y);
    for (int x = 0; x < size.width; ++x) {
      // Of the key's strength, give or take its light.
      const float amount = key->amount(cb[x], cr[x]) / whole;
      w[x] = amount > 0.65f && amount < 1.6f ? 1.f : 0.f;
      s[x] = w[x] * cv::Vec3f(luma[x << picture.log2_chroma_width], cb[x], cr[x]);
    }
  }
  const cv::Size grid(std::min(cells_across, size.width),
                      std::clamp(cells_across * size.height / size.width, 1, size.height));
  cv::resize(screen, screen_cells, grid, 0, 0, cv::INTER_AREA);
  cv::resize(weight, weight_cells, grid, 0, 0, cv::INTER_AREA);
  // Where there is none, what is far around, and at last the key.
  for (const double reach : {1.0, 4.0}) {
    cv::Mat wide_screen, wide_weight;
    cv::GaussianBlur(screen_cells, wide_screen, {}, reach);
    cv::GaussianBlur(weight_cells, wide_weight, {}, reach);
    screen_cells += 0.05 * wide_screen;
    weight_cells += 0.05 * wide_weight;
  }
  for (int y = 0; y < grid.height; ++y) {
    auto* s = screen_cells.ptr<cv::Vec3f>(y);
    const float* w = weight_cells.ptr<float>(y);
    for (int x = 0; x < grid.width; ++x) s[x] = (s[x] + 1e-4f * key->colour) / (w[x] + 1e-4f);
  }
  cv::resize(screen_cells, screen_here, size, 0, 0, cv::INTER_LINEAR);
}

void ChromaMatte::State::find_alpha(const Picture& picture) {
  const cv::Size size = picture.cb.size();
  raw.create(size, CV_32F);
  alpha.create(size, CV_32F);
  const float low = static_cast<float>(options.clip_low);
  const float range = static_cast<float>(options.clip_high - options.clip_low);
  for (int y = 0; y < size.height; ++y) {
    const auto *cb = picture.cb.ptr<std::uint8_t>(y), *cr = picture.cr.ptr<std::uint8_t>(y);
    const auto* s = screen_here.ptr<cv::Vec3f>(y);
    float *r = raw.ptr<float>(y), *a = alpha.ptr<float>(y);
    for (int x = 0; x < size.width; ++x) {
      const float whole = std::max(key->amount(s[x][1], s[x][2]), 0.25f * least_chroma);
      r[x] = 1 - key->amount(cb[x], cr[x]) / whole;
      a[x] = std::clamp((r[x] - low) / range, 0.f, 1.f) * 255;
    }
  }
  // Well inside, where no screen is near, nothing shines through.
  const int reach = std::max(2, size.width / 80);
  cv::erode(alpha > 100, core, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
  cv::blur(core, core, {reach + 1, reach + 1});
  core.convertTo(core_alpha, CV_32F);
  cv::max(alpha, core_alpha, alpha);
  cv::resize(alpha, full_alpha, picture.luma.size(), 0, 0, cv::INTER_LINEAR);
}

// Along the border the thing's colour is known from within and the screen's from without. Strands that reach farther
// out keep what was keyed.
void ChromaMatte::State::solve_border(const Picture& picture, Matte& matte) {
  if (matte.rect.empty()) return;
  KnownBackground::Options border;
  border.band_px = 5;
  const int around = 3 * border.band_px;
  matte.rect = intersection({matte.rect.x_px - around, matte.rect.y_px - around, matte.rect.width_px + 2 * around,
                             matte.rect.height_px + 2 * around},
                            {0, 0, matte.width_px, matte.height_px});
  const cv::Rect rect(matte.rect.x_px, matte.rect.y_px, matte.rect.width_px, matte.rect.height_px);
  const cv::Mat whole(matte.height_px, matte.width_px, CV_8U, matte.alpha.data());
  whole(rect).copyTo(keyed);
  whole.copyTo(rough);
  cv::resize(screen_here, screen_wide, whole.size(), 0, 0, cv::INTER_LINEAR);
  known.solve(picture, rough, screen_wide(rect), border, matte);
  cv::Mat solved = whole(rect);
  keyed.copyTo(solved, known.reached() == 0);
}

// Own colours, less what the screen throws on the thing. Where that changes an opaque pixel, it is made the least bit
// transparent, so that its own colour is taken in place of the plate's.
void ChromaMatte::State::find_colours(const Picture& picture, Matte& matte) const {
  constexpr float visible = 4;  // levels of chroma
  for (int y = matte.rect.y_px; y < matte.rect.bottom_px(); ++y) {
    std::uint8_t* alpha_row = matte.alpha_row(y);
    std::uint8_t* own = matte.own_rgb.data() + static_cast<std::size_t>(y) * matte.width_px * 3;
    const int chroma_y = y >> picture.log2_chroma_height;
    const auto* s = screen_here.ptr<cv::Vec3f>(chroma_y);
    const std::uint8_t* inside = core.ptr<std::uint8_t>(chroma_y);
    for (int x = matte.rect.x_px; x < matte.rect.right_px(); ++x) {
      std::uint8_t& a = alpha_row[x];
      if (a == 0) continue;
      // Well inside, a colour like the screen's is the thing's own.
      const float despill =
          static_cast<float>(options.despill) * (1 - static_cast<float>(inside[x >> picture.log2_chroma_width]) / 255);
      cv::Vec3f colour = picture.ycc(x, y);
      if (a == 255) {
        if (despill <= 0 || key->amount(colour[1], colour[2]) * despill < visible) continue;
        a = 254;
      }
      const float share = static_cast<float>(a) / 255;
      const cv::Vec3f& behind = s[x >> picture.log2_chroma_width];
      colour = (colour - (1 - share) * behind) / share;
      const float spill = despill * key->amount(colour[1], colour[2]);
      colour[1] -= spill * key->u;
      colour[2] -= spill * key->v;
      const cv::Vec3f rgb = to_rgb(picture.rgb_from_ycc, colour);
      for (int c = 0; c < 3; ++c) own[3 * x + c] = level(rgb[c]);
    }
  }
}

void ChromaMatte::estimate(const Frame& frame, Matte& matte) {
  State& s = *state_;
  begin_matte(frame, matte);
  const Picture& picture = s.reader.read(frame);
  if (!s.key) {
    std::optional<cv::Vec3f> colour = commonest_colour(picture);
    if (s.options.key) {
      const auto& rgb = *s.options.key;
      const cv::Vec3f ycc =
          picture.ycc_from_rgb * cv::Vec4f(static_cast<float>(255 * rgb[0]), static_cast<float>(255 * rgb[1]),
                                           static_cast<float>(255 * rgb[2]), 1);
      if (std::hypot(ycc[1] - 128, ycc[2] - 128) < least_chroma) {
        throw input_error("chroma", "the key is no strong colour", "give the screen's own, such as \"#00b140\"");
      }
      colour = ycc;
    }
    if (!colour) {
      throw input_error("chroma", "the first frame shows no screen of one strong colour",
                        "give its colour: chroma = { key = \"#rrggbb\" }");
    }
    s.key.emplace(*colour, s.options.hue_deg);
  }
  s.measure_screen(picture);
  s.find_alpha(picture);
  for (int y = 0; y < matte.height_px; ++y) {
    const float* in = s.full_alpha.ptr<float>(y);
    std::uint8_t* out = matte.alpha_row(y);
    for (int x = 0; x < matte.width_px; ++x) out[x] = static_cast<std::uint8_t>(in[x] + 0.5f);
  }
  find_rect(matte);
  s.solve_border(picture, matte);
  find_rect(matte);
  s.find_colours(picture, matte);
}

}  // namespace rinkaku::matte

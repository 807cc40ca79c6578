#include "pipeline/matte/difference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "pipeline/matte/known_background.h"
#include "pipeline/matte/learnt_background.h"
#include "pipeline/matte/light_field.h"
#include "pipeline/matte/picture.h"
#include "pipeline/matte/rough_mask.h"

namespace rinkaku::matte {

struct DifferenceMatte::State {
  std::optional<Frame> clean;
  DifferenceOptions options;
  PictureReader reader, clean_reader;
  int factor = 0;            // how much smaller the rough pictures are; 0 before the first frame
  cv::Mat background;        // CV_32FC3, full size
  cv::Mat small_background;  // luma above black, Cb and Cr from their middle; small
  std::optional<LearntBackground> learnt;
  cv::Mat small;  // the frame likewise
  LightField light;
  RoughMask rough;
  KnownBackground known;
  cv::Mat mask, near, behind, shade;
  int next_row = 0;

  void begin(const Picture& picture);
  void shrink(const Picture& picture, cv::Mat& out) const;
  void find_behind(const Picture& picture, const PixelRect& rect);
  void keep_up(const Picture& picture);
};

namespace {

constexpr int small_width_px = 640;

}  // namespace

DifferenceMatte::DifferenceMatte(std::optional<Frame> clean, const DifferenceOptions& options)
    : state_(std::make_unique<State>()) {
  state_->clean = std::move(clean);
  state_->options = options;
}

DifferenceMatte::~DifferenceMatte() = default;

void DifferenceMatte::State::shrink(const Picture& picture, cv::Mat& out) const {
  const cv::Size size(picture.width_px() / factor, picture.height_px() / factor);
  cv::Mat planes[3], small_plane;
  for (int c = 0; c < 3; ++c) {
    const cv::Mat& plane = c == 0 ? picture.luma : c == 1 ? picture.cb : picture.cr;
    const bool shrinks = plane.cols > size.width;
    cv::resize(plane, small_plane, size, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
    small_plane.convertTo(planes[c], CV_32F, 1, c == 0 ? -picture.black : -128);
  }
  cv::merge(planes, 3, out);
}

void DifferenceMatte::State::begin(const Picture& picture) {
  factor = std::max(1, static_cast<int>(std::lround(picture.width_px() / static_cast<double>(small_width_px))));
  if (!clean) {
    learnt.emplace(options.memory_frames);
    return;
  }
  background = recoded(clean_reader.read(*clean), picture.ycc_from_rgb);
  cv::resize(background, small_background, {picture.width_px() / factor, picture.height_px() / factor}, 0, 0,
             cv::INTER_AREA);
  small_background -= cv::Scalar(picture.black, 128, 128);
  clean.reset();
}

// The background as this frame's light shows it, inside the rectangle.
void DifferenceMatte::State::find_behind(const Picture& picture, const PixelRect& rect) {
  const cv::Size size(picture.width_px(), picture.height_px());
  cv::resize(rough.shade(), shade, size, 0, 0, cv::INTER_LINEAR);
  behind.create(rect.height_px, rect.width_px, CV_32FC3);
  const cv::Vec3f middle(picture.black, 128, 128);
  for (int y = 0; y < rect.height_px; ++y) {
    const auto* in = background.ptr<cv::Vec3f>(rect.y_px + y) + rect.x_px;
    const float* light_here = shade.ptr<float>(rect.y_px + y) + rect.x_px;
    auto* out = behind.ptr<cv::Vec3f>(y);
    for (int x = 0; x < rect.width_px; ++x) out[x] = middle + light_here[x] * (in[x] - middle);
  }
}

// Where the room is seen now, the background takes on what the clean plate didn't have: the video's own sharpness and
// tones. Under the light of the clean plate, so that shadows don't stay behind. A few rows each frame.
void DifferenceMatte::State::keep_up(const Picture& picture) {
  constexpr int every = 4;
  constexpr float share = 0.3f, small_share = 0.1f;
  cv::dilate(rough.mask(), near, cv::getStructuringElement(cv::MORPH_RECT, {9, 9}));
  // Nor where a shadow lies now.
  for (int y = 0; y < near.rows; ++y) {
    const float *shade_here = rough.shade().ptr<float>(y), *gain = light.gain().ptr<float>(y);
    auto* out = near.ptr<std::uint8_t>(y);
    for (int x = 0; x < near.cols; ++x) out[x] |= std::abs(shade_here[x] / gain[x] - 1) > 0.04f ? 255 : 0;
  }
  const cv::Vec3f middle(picture.black, 128, 128);
  for (int y = next_row; y < picture.height_px(); y += every) {
    const int small_y = std::min(y / factor, near.rows - 1);
    const std::uint8_t* covered = near.ptr<std::uint8_t>(small_y);
    const float* light_here = rough.shade().ptr<float>(small_y);
    auto* out = background.ptr<cv::Vec3f>(y);
    for (int small_x = 0; small_x < near.cols; ++small_x) {
      if (covered[small_x] != 0) continue;
      const float to_plate = 1 / std::max(light_here[small_x], 0.2f);
      const int end = small_x + 1 == near.cols ? picture.width_px() : (small_x + 1) * factor;
      for (int x = small_x * factor; x < end; ++x) {
        out[x] += share * ((picture.ycc(x, y) - middle) * to_plate + middle - out[x]);
      }
    }
  }
  next_row = (next_row + 1) % every;
  for (int y = 0; y < near.rows; ++y) {
    const std::uint8_t* covered = near.ptr<std::uint8_t>(y);
    const float* light_here = rough.shade().ptr<float>(y);
    const auto* now = small.ptr<cv::Vec3f>(y);
    auto* out = small_background.ptr<cv::Vec3f>(y);
    for (int x = 0; x < near.cols; ++x) {
      if (covered[x] == 0) out[x] += small_share * (now[x] / std::max(light_here[x], 0.2f) - out[x]);
    }
  }
}

void DifferenceMatte::estimate(const Frame& frame, Matte& matte) {
  State& s = *state_;
  begin_matte(frame, matte);
  const Picture& picture = s.reader.read(frame);
  if (s.factor == 0) s.begin(picture);
  s.shrink(picture, s.small);
  if (s.learnt) {
    s.learnt->learn(picture, s.small);
    if (!s.learnt->ready()) return;
    s.background = s.learnt->background();
    s.small_background = s.learnt->small_background();
  }
  RoughMask::Options options;
  options.threshold = static_cast<float>(s.options.threshold);
  options.deepest_shadow = static_cast<float>(s.options.deepest_shadow);
  options.least_px = static_cast<int>(s.options.least_part * static_cast<double>(s.small.total()));
  options.find_faint = !s.learnt;  // a learnt background keeps traces of the thing
  s.rough.find(s.small, s.small_background, s.light, options);
  if (!s.learnt) s.keep_up(picture);
  cv::resize(s.rough.mask(), s.mask, {picture.width_px(), picture.height_px()}, 0, 0, cv::INTER_LINEAR);

  const KnownBackground::Options edges;
  const cv::Rect found = cv::boundingRect(s.mask);
  if (found.empty()) return;
  const int around = 3 * edges.band_px;
  matte.rect = intersection({found.x - around, found.y - around, found.width + 2 * around, found.height + 2 * around},
                            {0, 0, matte.width_px, matte.height_px});
  s.find_behind(picture, matte.rect);
  s.known.solve(picture, s.mask, s.behind, edges, matte);
  find_rect(matte);
}

}  // namespace rinkaku::matte

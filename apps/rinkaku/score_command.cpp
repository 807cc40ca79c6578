#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/grey_image.h"
#include "apps/rinkaku/json_output.h"
#include "apps/rinkaku/matte_commands.h"
#include "pipeline/frame/error.h"
#include "pipeline/matte/score.h"
#include "pipeline/source/source.h"

namespace rinkaku::app {
namespace {

using matte::GreyMatte;
using matte::Score;

void must_be_of_one_size(const GreyMatte& found, const GreyMatte& truth, const ScoreCall& call) {
  if (found.width_px == truth.width_px && found.height_px == truth.height_px) return;
  throw input_error(call.matte,
                    "is " + std::to_string(found.width_px) + "x" + std::to_string(found.height_px) + " and " +
                        call.truth + " " + std::to_string(truth.width_px) + "x" + std::to_string(truth.height_px),
                    "give two of one size");
}

nlohmann::json as_json(const Score& s) {
  return {{"mismatch_px", s.mismatch_px},
          {"iou", s.iou},
          {"sad", s.sad},
          {"mse", s.mse},
          {"grad", s.grad},
          {"conn", s.conn},
          {"boundary_f1", s.boundary_f1},
          {"boundary_f3", s.boundary_f3}};
}

void print(const Score& s) {
  std::printf("mismatch     %lld pixels\nIoU          %.6f\nSAD          %.4f\nMSE          %.8f\n",
              static_cast<long long>(s.mismatch_px), s.iou, s.sad, s.mse);
  std::printf("gradient     %.4f\nconnectivity %.4f\nboundary F   %.4f within 1 pixel, %.4f within 3\n", s.grad, s.conn,
              s.boundary_f1, s.boundary_f3);
}

Score mean(const std::vector<Score>& scores) {
  Score sum;
  sum.iou = sum.boundary_f1 = sum.boundary_f3 = 0;
  const auto count = static_cast<double>(scores.size());
  for (const Score& s : scores) {
    sum.mismatch_px += s.mismatch_px;
    sum.iou += s.iou / count;
    sum.sad += s.sad / count;
    sum.mse += s.mse / count;
    sum.grad += s.grad / count;
    sum.conn += s.conn / count;
    sum.boundary_f1 += s.boundary_f1 / count;
    sum.boundary_f3 += s.boundary_f3 / count;
  }
  sum.mismatch_px /= static_cast<std::int64_t>(scores.size());
  return sum;
}

// A video's or image sequence's mattes one by one.
class Mattes {
 public:
  explicit Mattes(const std::string& path) : source_(source::open(path)), next_(source_->next()) {
    if (!next_) throw input_error(path, "it holds no picture", "give a matte, or a video of mattes");
    after_ = source_->next();
  }
  bool is_one() const { return !after_; }
  std::optional<GreyMatte> next() {
    if (!next_) return {};
    GreyMatte grey = grey_of(*next_);
    next_ = std::move(after_);
    after_ = next_ ? source_->next() : std::nullopt;
    return grey;
  }

 private:
  std::unique_ptr<source::Source> source_;
  std::optional<Frame> next_, after_;
};

int score_pictures(const ScoreCall& call) {
  const GreyMatte found = read_grey(call.matte), truth = read_grey(call.truth);
  must_be_of_one_size(found, truth, call);
  const Score s = matte::score(found, truth);
  if (call.json) {
    print_json(as_json(s));
  } else {
    print(s);
  }
  return 0;
}

int score_videos(const ScoreCall& call, Mattes& found, Mattes& truth) {
  std::vector<Score> scores;
  double flicker = 0;
  std::optional<GreyMatte> last, last_truth;
  while (true) {
    std::optional<GreyMatte> now = found.next(), now_truth = truth.next();
    if (now.has_value() != now_truth.has_value()) {
      throw input_error(now ? call.truth : call.matte, "ends after " + std::to_string(scores.size()) + " frames",
                        "give as many mattes as there are true ones");
    }
    if (!now) break;
    must_be_of_one_size(*now, *now_truth, call);
    scores.push_back(matte::score(*now, *now_truth));
    if (last) flicker += matte::flicker(*last, *now, *last_truth, *now_truth);
    last = std::move(now);
    last_truth = std::move(now_truth);
  }
  flicker /= static_cast<double>(scores.size() - 1);
  if (call.json) {
    nlohmann::json each = nlohmann::json::array();
    for (const Score& s : scores) each.push_back(as_json(s));
    print_json({{"frames", scores.size()}, {"mean", as_json(mean(scores))}, {"flicker", flicker}, {"each", each}});
  } else {
    std::printf("mean of %zu frames\n", scores.size());
    print(mean(scores));
    std::printf("flicker      %.6f\n", flicker);
  }
  return 0;
}

}  // namespace

int score(const ScoreCall& call) {
  Mattes found(call.matte), truth(call.truth);
  if (found.is_one() && truth.is_one()) return score_pictures(call);
  return score_videos(call, found, truth);
}

}  // namespace rinkaku::app

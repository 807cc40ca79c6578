#include <cstdio>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/interrupt.h"
#include "apps/rinkaku/json_output.h"
#include "apps/rinkaku/progress_bar.h"
#include "pipeline/files/pending_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/source/source.h"
#include "pipeline/track/board.h"
#include "pipeline/track/calibrate.h"
#include "pipeline/track/camera_file.h"

namespace rinkaku::app {
namespace {

// The frames of several videos, one after the other.
class Frames {
 public:
  explicit Frames(const std::vector<std::string>& videos) {
    for (const std::string& video : videos) {
      // Stills are pictures of their own, none too near to the last: as if taken a second apart.
      sources_.push_back(source::open(video, {.image_rate = {1, 1}}));
      total_ += sources_.back()->description().frame_count;
    }
  }
  std::optional<Frame> next() {
    while (at_ < sources_.size() && !interrupted()) {
      if (std::optional<Frame> frame = sources_[at_]->next()) {
        bar_.update(++done_, total_);
        return frame;
      }
      ++at_;
    }
    return std::nullopt;
  }

 private:
  std::vector<std::unique_ptr<source::Source>> sources_;
  std::size_t at_ = 0;
  std::int64_t done_ = 0, total_ = 0;
  ProgressBar bar_;
};

}  // namespace

int calibrate(const CalibrateCall& call) {
  const files::PendingFile checked(call.output, call.force);
  const track::Board board = track::read_board(call.board);
  track::Calibration found;
  {
    Frames frames(call.videos);
    found = track::calibrate(board, [&frames] { return frames.next(); });
  }
  if (interrupted()) throw runtime_failure(call.output, "interrupted: nothing was written");
  track::write_camera(call.output, found.camera, track::CalibrationNote{found.rms_px, found.views});
  for (const std::string& warning : found.warnings) std::fprintf(stderr, "rinkaku: note: %s\n", warning.c_str());
  const CameraModel& camera = found.camera;
  if (call.json) {
    print_json({{"output", call.output},
                {"rms_px", found.rms_px},
                {"views", found.views},
                {"views_rejected", found.views_rejected},
                {"frames_with_board", found.frames_with_board},
                {"coverage", found.coverage},
                {"most_tilt_deg", found.most_tilt_deg},
                {"fx_px", camera.fx_px},
                {"fy_px", camera.fy_px},
                {"cx_px", camera.cx_px},
                {"cy_px", camera.cy_px},
                {"distortion", camera.distortion},
                {"warnings", found.warnings}});
  } else {
    std::printf(
        "%s: %d views of %d frames with the board, reprojection error %.3f px rms, %.0f %% of the picture covered\n",
        call.output.c_str(), found.views, found.frames_with_board, found.rms_px, found.coverage * 100);
  }
  return 0;
}

}  // namespace rinkaku::app

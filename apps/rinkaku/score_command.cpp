#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/grey_image.h"
#include "apps/rinkaku/json_output.h"
#include "pipeline/frame/error.h"
#include "pipeline/matte/score.h"

namespace rinkaku::app {

int score(const ScoreCall& call) {
  const matte::GreyMatte found = read_grey(call.matte), truth = read_grey(call.truth);
  if (found.width_px != truth.width_px || found.height_px != truth.height_px) {
    throw input_error(call.matte,
                      "is " + std::to_string(found.width_px) + "x" + std::to_string(found.height_px) + " and " +
                          call.truth + " " + std::to_string(truth.width_px) + "x" + std::to_string(truth.height_px),
                      "give two pictures of one size");
  }
  const matte::Score s = matte::score(found, truth);
  if (call.json) {
    print_json({{"mismatch_px", s.mismatch_px},
                {"iou", s.iou},
                {"sad", s.sad},
                {"mse", s.mse},
                {"grad", s.grad},
                {"conn", s.conn},
                {"boundary_f1", s.boundary_f1},
                {"boundary_f3", s.boundary_f3}});
    return 0;
  }
  std::printf("mismatch     %lld pixels\nIoU          %.6f\nSAD          %.4f\nMSE          %.8f\n",
              static_cast<long long>(s.mismatch_px), s.iou, s.sad, s.mse);
  std::printf("gradient     %.4f\nconnectivity %.4f\nboundary F   %.4f within 1 pixel, %.4f within 3\n", s.grad, s.conn,
              s.boundary_f1, s.boundary_f3);
  return 0;
}

}  // namespace rinkaku::app

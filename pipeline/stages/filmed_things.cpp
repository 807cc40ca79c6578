#include "pipeline/stages/filmed_things.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "pipeline/frame/error.h"
#include "pipeline/matte/file_matte.h"
#include "pipeline/matte/person_network.h"
#include "pipeline/matte/segmentation.h"

namespace rinkaku::pipeline {
namespace {

std::string size(const PictureFormat& format) {
  return std::to_string(format.width_px) + "x" + std::to_string(format.height_px);
}

// The first picture of a file, which must be of the plate's size.
Frame clean_plate(const std::string& file, const source::Description& plate) {
  const auto source = source::open(file);
  std::optional<Frame> frame = source->next();
  if (!frame) throw input_error(file, "it holds no picture", "give a picture of the empty scene");
  if (frame->format.width_px != plate.format.width_px || frame->format.height_px != plate.format.height_px) {
    throw input_error(file, "the clean plate is " + size(frame->format) + " and the plate " + size(plate.format),
                      "give one of the same size, from the same camera");
  }
  return std::move(*frame);
}

struct MakeEstimator {
  const source::Description& plate;
  std::unique_ptr<matte::MatteEstimator> operator()(const matte::ChromaOptions& options) const {
    return std::make_unique<matte::ChromaMatte>(options);
  }
  std::unique_ptr<matte::MatteEstimator> operator()(const DifferenceMatteScene& scene) const {
    std::optional<Frame> clean;
    if (!scene.clean.empty()) clean = clean_plate(scene.clean, plate);
    return std::make_unique<matte::DifferenceMatte>(std::move(clean), scene.options);
  }
  std::unique_ptr<matte::MatteEstimator> operator()(const FileMatteScene& scene) const {
    std::shared_ptr<source::Source> source = source::open(scene.input);
    return std::make_unique<matte::FileMatte>(scene.input, [source] { return source->next(); });
  }
  std::unique_ptr<matte::MatteEstimator> operator()(const SegmentationScene& scene) const {
    const auto network =
        std::make_shared<matte::PersonNetwork>(scene.model.empty() ? matte::installed_model() : scene.model);
    return std::make_unique<matte::SegmentationMatte>(
        [network](const matte::Picture& picture, const PixelRect& part, cv::Mat& likely) {
          network->find(picture, part, likely);
        });
  }
};

}  // namespace

struct FilmedThings::Thing {
  matte::Foreground foreground;
  std::optional<double> distance_m;
  bool on_ground;
  matte::FootPoint foot;
  double last_m = 0;  // before everything, as long as nothing is known
};

FilmedThings::FilmedThings(const Prepared& prepared, const source::Description& described) : camera_(prepared.camera) {
  for (const ForegroundScene& scene : prepared.scene.foregrounds) {
    std::vector<std::unique_ptr<matte::MatteEstimator>> estimators;
    for (const ForegroundScene::Method& method : scene.methods) {
      estimators.push_back(std::visit(MakeEstimator{described}, method));
    }
    things_.push_back(std::make_unique<Thing>(
        Thing{matte::Foreground(std::move(estimators), scene.options), scene.distance_m, scene.on_ground, {}, 0}));
  }
}

FilmedThings::~FilmedThings() = default;

void FilmedThings::find(Work& work) {
  work.mattes.resize(things_.size());
  for (std::size_t i = 0; i < things_.size(); ++i) {
    Thing& thing = *things_[i];
    Matte& matte = work.mattes[i];
    thing.foreground.find(work.frame, matte);
    matte.thing = static_cast<int>(i);
    if (thing.on_ground && work.pose) {
      const auto found = thing.foot.distance_m(matte, *camera_, work.pose->camera_from_world);
      if (found) thing.last_m = *found;
    }
    matte.distance_m = thing.distance_m.value_or(thing.last_m);
  }
  std::stable_sort(work.mattes.begin(), work.mattes.end(),
                   [](const Matte& a, const Matte& b) { return cut_m(a) < cut_m(b); });
}

double cut_m(const Matte& matte) {
  return matte.rect.empty() ? std::numeric_limits<double>::infinity() : matte.distance_m;
}

}  // namespace rinkaku::pipeline

#include "pipeline/stages/layer_files.h"

#include <cctype>
#include <cstring>
#include <utility>

namespace rinkaku::pipeline {
namespace {

PictureFormat matte_format(const PictureFormat& plate) {
  PictureFormat format;
  format.width_px = plate.width_px;
  format.height_px = plate.height_px;
  format.sample_aspect = plate.sample_aspect;
  format.pixels = grey8();
  format.colour.range = ColourTags::Range::Full;
  return format;
}

// A name that is good in a file's name.
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name) out += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  return out;
}

}  // namespace

std::vector<std::string> layer_names(const Scene& scene) {
  std::vector<std::string> names = {"plate"};
  for (std::size_t i = 0; i < scene.foregrounds.size(); ++i) {
    std::string name = "matte_" + plain(scene.foregrounds[i].name);
    for (std::size_t k = 0; k < i; ++k) {
      if (plain(scene.foregrounds[k].name) != plain(scene.foregrounds[i].name)) continue;
      name += "-" + std::to_string(i + 1);
      break;
    }
    names.push_back(std::move(name));
  }
  if (scene.foregrounds.empty()) {
    names.emplace_back("cg");
  } else {
    for (std::size_t i = 0; i <= scene.foregrounds.size(); ++i) names.push_back("cg-" + std::to_string(i));
  }
  return names;
}

LayerFiles::LayerFiles(const Prepared& prepared, const RenderOptions& options, const source::Description& described)
    : names_(layer_names(prepared.scene)), things_(prepared.scene.foregrounds.size()) {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const PictureFormat format = i == 0         ? described.format
                                 : i <= things_ ? matte_format(described.format)
                                                : straight_alpha_format(described.format);
    files_.push_back(open_layer(prepared, options, described, names_[i], format));
  }
}

LayerFiles::~LayerFiles() {
  // The first one made the folder and takes it away again, once the others' files are gone.
  while (!files_.empty()) files_.pop_back();
}

void LayerFiles::write_matte(const Frame& plate, const Matte& matte) {
  Frame frame = pool_.allocate(matte_format(plate.format));
  frame.number = plate.number;
  frame.pts = plate.pts;
  frame.duration = plate.duration;
  frame.time_base = plate.time_base;
  for (int y = 0; y < matte.height_px; ++y) {
    std::memcpy(frame.planes[0].data + y * frame.planes[0].stride_bytes, matte.alpha_row(y),
                static_cast<std::size_t>(matte.width_px));
  }
  files_[1 + static_cast<std::size_t>(matte.thing)].sink->write(frame);
}

void LayerFiles::write(const Work& work, double opacity) {
  files_[0].sink->write(work.frame);
  for (const Matte& matte : work.mattes) write_matte(work.frame, matte);
  if (things_ == 0) {
    files_[1].sink->write(straight_alpha_frame(work.frame, work.layer, opacity, pool_));
    return;
  }
  for (std::size_t i = 0; i <= things_; ++i) {
    static const passes::Layer nothing;
    const passes::Layer& layer = i < work.slices.size() ? work.slices[i] : nothing;
    files_[1 + things_ + i].sink->write(straight_alpha_frame(work.frame, layer, opacity, pool_));
  }
}

std::vector<std::string> LayerFiles::finish() {
  std::vector<std::string> notices;
  for (std::size_t i = 0; i < files_.size(); ++i) {
    files_[i].sink->finish();
    // That the plate becomes RGB in a PNG is known.
    if (i > 0 && !files_[i].sink->notice().empty()) notices.push_back(files_[i].sink->notice());
  }
  return notices;
}

}  // namespace rinkaku::pipeline

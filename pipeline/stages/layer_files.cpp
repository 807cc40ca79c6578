#include "pipeline/stages/layer_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace rinkaku::pipeline {
namespace {

PictureFormat grey_format(const PictureFormat& plate, const PixelFormat& pixels) {
  PictureFormat format;
  format.width_px = plate.width_px;
  format.height_px = plate.height_px;
  format.sample_aspect = plate.sample_aspect;
  format.pixels = pixels;
  format.colour.range = ColourTags::Range::Full;
  return format;
}

PictureFormat matte_format(const PictureFormat& plate) { return grey_format(plate, grey8()); }
PictureFormat depth_format(const PictureFormat& plate) { return grey_format(plate, grey16be()); }

PictureFormat format_of(LayerFile::Holds holds, const PictureFormat& plate) {
  using H = LayerFile::Holds;
  if (holds == H::Plate) return plate;
  if (holds == H::Matte) return matte_format(plate);
  return holds == H::Depth ? depth_format(plate) : straight_alpha_format(plate);
}

std::uint16_t millimetres(float depth_m) {
  if (depth_m <= 0) return 0;
  // What was drawn is told from what wasn't, however near.
  return static_cast<std::uint16_t>(std::clamp(std::round(depth_m * 1000.0f), 1.0f, 65535.0f));
}

// A name that is good in a file's name.
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name) out += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  return out;
}

}  // namespace

std::vector<LayerFile> layer_files(const Scene& scene) {
  using H = LayerFile::Holds;
  std::vector<LayerFile> layers = {{H::Plate, 0, "plate"}};
  const auto& things = scene.foregrounds;
  for (std::size_t i = 0; i < things.size(); ++i) {
    std::string name = plain(things[i].name);
    for (std::size_t k = 0; k < i; ++k) {
      if (plain(things[k].name) != name) continue;
      name += "-" + std::to_string(i + 1);
      break;
    }
    layers.push_back({H::Matte, i, "matte_" + name});
    if (things[i].options.line) layers.push_back({H::ThingLine, i, "line_" + name});
  }
  const bool lines =
      std::any_of(scene.objects.begin(), scene.objects.end(), [](const ObjectScene& o) { return o.outline; });
  const bool depth = !scene.objects.empty() || scene.water;
  for (std::size_t i = 0; i <= things.size(); ++i) {
    const std::string number = things.empty() ? "" : "-" + std::to_string(i);
    layers.push_back({H::Cg, i, "cg" + number});
    if (lines) layers.push_back({H::Lines, i, "line" + number});
    if (depth) layers.push_back({H::Depth, i, "depth" + number});
  }
  return layers;
}

LayerFiles::LayerFiles(const Prepared& prepared, const RenderOptions& options, const source::Description& described)
    : layers_(layer_files(prepared.scene)) {
  for (const LayerFile& layer : layers_) {
    files_.push_back(open_layer(prepared, options, described, layer.name, format_of(layer.holds, described.format)));
  }
}

LayerFiles::~LayerFiles() {
  // The first one made the folder and takes it away again, once the others' files are gone.
  while (!files_.empty()) files_.pop_back();
}

Frame LayerFiles::frame_like(const Frame& plate, const PictureFormat& format) {
  Frame frame = pool_.allocate(format);
  frame.number = plate.number;
  frame.pts = plate.pts;
  frame.duration = plate.duration;
  frame.time_base = plate.time_base;
  return frame;
}

void LayerFiles::write_matte(const Frame& plate, const Matte& matte, sink::Sink& to) {
  const Frame frame = frame_like(plate, matte_format(plate.format));
  for (int y = 0; y < matte.height_px; ++y) {
    std::memcpy(frame.planes[0].data + y * frame.planes[0].stride_bytes, matte.alpha_row(y),
                static_cast<std::size_t>(matte.width_px));
  }
  to.write(frame);
}

void LayerFiles::write_thing_line(const Frame& plate, const Matte& matte, sink::Sink& to) {
  thing_line_.rect = matte.line_rect;
  thing_line_.rgba.assign(matte.line.size() * 4, 0);
  for (std::size_t i = 0; i < matte.line.size(); ++i) {
    const int alpha = matte.line[i];
    for (std::size_t c = 0; c < 3; ++c) {
      thing_line_.rgba[4 * i + c] = static_cast<std::uint8_t>((matte.line_rgb[c] * alpha + 127) / 255);
    }
    thing_line_.rgba[4 * i + 3] = matte.line[i];
  }
  to.write(straight_alpha_frame(plate, thing_line_, 1, pool_));
}

void LayerFiles::write_depth(const Frame& plate, const passes::DepthLayer& depth, sink::Sink& to) {
  const Frame frame = frame_like(plate, depth_format(plate.format));
  const Plane& plane = frame.planes[0];
  for (int y = 0; y < plate.format.height_px; ++y) {
    std::memset(plane.data + y * plane.stride_bytes, 0, static_cast<std::size_t>(plate.format.width_px) * 2);
  }
  const float* from = depth.depth_m.data();
  for (int y = depth.rect.y_px; y < depth.rect.bottom_px(); ++y) {
    std::uint8_t* to_row = plane.data + y * plane.stride_bytes + std::ptrdiff_t{2} * depth.rect.x_px;
    for (int x = 0; x < depth.rect.width_px; ++x) {
      const std::uint16_t value = millimetres(*from++);
      to_row[2 * x] = static_cast<std::uint8_t>(value >> 8);
      to_row[2 * x + 1] = static_cast<std::uint8_t>(value & 255);
    }
  }
  to.write(frame);
}

void LayerFiles::write(const Work& work, double opacity) {
  using H = LayerFile::Holds;
  static const passes::Layer nothing;
  static const passes::LayerParts no_parts;
  const bool sliced = !work.mattes.empty();
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const LayerFile& layer = layers_[i];
    sink::Sink& to = *files_[i].sink;
    const passes::LayerParts& parts = layer.of < work.parts.size() ? work.parts[layer.of] : no_parts;
    const auto matte = std::find_if(work.mattes.begin(), work.mattes.end(),
                                    [&layer](const Matte& m) { return static_cast<std::size_t>(m.thing) == layer.of; });
    switch (layer.holds) {
      case H::Plate:
        to.write(work.frame);
        break;
      case H::Matte:
        if (matte != work.mattes.end()) write_matte(work.frame, *matte, to);
        break;
      case H::ThingLine:
        if (matte != work.mattes.end()) write_thing_line(work.frame, *matte, to);
        break;
      case H::Cg: {
        const passes::Layer& cg = !sliced                         ? work.layer
                                  : layer.of < work.slices.size() ? work.slices[layer.of]
                                                                  : nothing;
        to.write(straight_alpha_frame(work.frame, cg, opacity, pool_));
        break;
      }
      case H::Lines:
        to.write(straight_alpha_frame(work.frame, parts.lines, opacity, pool_));
        break;
      case H::Depth:
        write_depth(work.frame, parts.depth, to);
        break;
    }
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

#pragma once

#include <atomic>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "pipeline/pipeline.h"
#include "tests/pipeline/sink/sink_tools.h"

namespace rinkaku::test {

// Colour tags (H.273) as cameras write them.
inline constexpr ColourTags bt709_limited{1, 1, 1, ColourTags::Range::Limited, 1};
inline constexpr ColourTags bt709_full{1, 1, 1, ColourTags::Range::Full, 1};
inline constexpr ColourTags bt601_limited{6, 6, 6, ColourTags::Range::Limited, 1};
inline constexpr ColourTags bt601_full{6, 6, 6, ColourTags::Range::Full, 1};

/// A folder with a small shot: camera.yml, cube.obj (a metre each way) and scenes that name them.
class ShotFolder : public TemporaryFolder {
 public:
  explicit ShotFolder(int width = 64, int height = 48) {
    write("camera.yml", camera_text(width, height));
    write("cube.obj",
          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
          "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(*this / name, std::ios::binary) << text;
  }
  std::string file(const std::string& name) const { return (*this / name).string(); }

  /// A clip of noise, lossless: every sample of every frame is another.
  std::vector<Frame> noise_clip(const std::string& name, const PictureFormat& format, int count) const {
    std::vector<Frame> frames = noise_frames(format, count);
    write_all({.path = file(name), .codec = "ffv1"}, incoming(format), frames);
    return frames;
  }

  /// Writes and prepares the scene, then renders it.
  pipeline::RenderReport render(const std::string& scene, pipeline::RenderOptions options,
                                const pipeline::Progress& progress = {}) const {
    static const std::atomic<bool> never{false};
    return render(scene, std::move(options), never, progress);
  }
  pipeline::RenderReport render(const std::string& scene, pipeline::RenderOptions options,
                                const std::atomic<bool>& stop, const pipeline::Progress& progress) const {
    write("scene.toml", scene);
    options.output = file(options.output);
    const pipeline::Prepared prepared = pipeline::prepare(pipeline::read_scene(*this / "scene.toml"), options);
    return pipeline::render(prepared, options, stop, progress);
  }

  std::vector<Frame> frames(const std::string& name) const { return all_frames(*source::open(file(name))); }

  /// What a focal length of the picture's width sees; `distortion` is OpenCV's five coefficients.
  static std::string camera_text(int width, int height, const std::string& distortion = "0, 0, 0, 0, 0") {
    std::ostringstream text;
    text << "%YAML:1.0\n---\nimage_width: " << width << "\nimage_height: " << height
         << "\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ " << width << ", 0., "
         << (width - 1) / 2.0 << ", 0., " << width << ", " << (height - 1) / 2.0
         << ", 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [ "
         << distortion << " ]\n";
    return text.str();
  }
};

// Pieces of scenes.
inline const std::string plate = "[plate]\nvideo = \"in.mkv\"\ncamera = \"camera.yml\"\n";
inline const std::string locked = "[track]\nlocked = { position_m = [0.5, -2, 1], look_at_m = [0, 0, 0.3] }\n";
inline const std::string poses = "[track]\nposes = \"poses.csv\"\n";
/// About a quarter of the picture's width, in the middle.
inline const std::string cube = "[[object]]\nmesh = \"cube.obj\"\nheight_m = 0.5\nposition_m = [0, 0, 0]\n";
inline const std::string drawn_scene = plate + locked + cube;

/// The sample at (x, y) of a component's own grid.
inline int sample(const Frame& frame, int component, int x, int y) {
  const Component& c = frame.format.pixels.component[static_cast<std::size_t>(component)];
  const Plane& plane = frame.planes[static_cast<std::size_t>(c.plane)];
  const std::uint8_t* at = plane.data + y * plane.stride_bytes + x * c.step_bytes + c.offset_bytes;
  const bool wide = c.depth_bits + c.shift_bits > 8;
  return (wide ? at[0] | at[1] << 8 : at[0]) >> c.shift_bits;
}

}  // namespace rinkaku::test

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "report/growth.h"
#include "report/sections/recording.h"
#include "report/sections/rendered_scene.h"

namespace rinkaku::report {
namespace {

struct Size {
  int width_px, height_px;
};

// One program at one size.
struct Run {
  std::string way;
  std::string of;  // what grows: "pixels", "triangles", "objects"
  double size;
  std::string label;
  int frames;
  std::vector<std::string> command;
  Stopwatch watch{};  // per frame
  double peak_mib = 0;
  bool ours = false;
  std::vector<double> latency_ms{};
};

bool gstreamer_can_encode() {
  return in_path("gst-inspect-1.0") && run_child({"gst-inspect-1.0", "--exists", "avenc_mpeg4"}).status == 0 &&
         run_child({"gst-inspect-1.0", "--exists", "mp4mux"}).status == 0;
}

constexpr int kSide = 72;  // 41,472 triangles

class Runs {
 public:
  explicit Runs(const Settings& settings) : settings_(settings) {}

  void at_sizes(const std::vector<Size>& sizes) {
    const std::string mesh = mesh_of(kSide);
    for (const Size& size : sizes) {
      const std::string video = video_of(size),
                        label = std::to_string(size.width_px) + "x" + std::to_string(size.height_px);
      const double pixels = static_cast<double>(size.width_px) * size.height_px;
      const int frames = frames_at(size);
      const std::string scene = "[plate]\nvideo = \"" + video + "\"\n";
      add("ffmpeg transcode", "pixels", pixels, label, frames, ffmpeg(video, {}));
      add("rinkaku, empty scene", "pixels", pixels, label, frames,
          render_command(settings_, scratch_file(settings_, "empty" + label + ".toml", scene), ""));
      add("ffmpeg overlay", "pixels", pixels, label, frames,
          ffmpeg(video, {"-i", still_of(size), "-filter_complex",
                         "[0:v][1:v]overlay=" + std::to_string(size.width_px / 3) + ":" +
                             std::to_string(size.height_px / 4)}));
      if (gstreamer_) add("GStreamer compositor", "pixels", pixels, label, frames, gstreamer(video, size));
      add("rinkaku, object", "pixels", pixels, label, frames, object_scene(size, label, {mesh}));
    }
  }
  void at_triangles(const Size& size, const std::vector<int>& cuts) {
    for (const int n : cuts) {
      const std::string label = std::to_string(8 * n * n);
      add("rinkaku, triangles", "triangles", 8.0 * n * n, label, frames_at(size),
          object_scene(size, "t" + label, {mesh_of(n)}));
    }
  }
  void at_objects(const Size& size, const std::vector<int>& counts) {
    for (const int count : counts) {
      const std::vector<std::string> meshes(static_cast<std::size_t>(count), mesh_of(12));
      add("rinkaku, objects", "objects", count, std::to_string(count), frames_at(size),
          object_scene(size, "o" + std::to_string(count), meshes));
    }
  }
  // In turn, so that what else the machine does falls on all alike.
  void run(int rounds) {
    for (int round = 0; round < rounds; ++round) {
      for (Run& one : runs) {
        const ChildRun run = run_whole(settings_, one.command);
        one.watch.add(run.wall_ms / one.frames, run.cpu_ms / one.frames);
        one.peak_mib = std::max(one.peak_mib, run.peak_mib);
        if (one.ours) one.latency_ms.push_back(way_of_a_frame_ms());
      }
    }
  }
  bool gstreamer() const { return gstreamer_; }

  std::vector<Run> runs;

 private:
  void add(std::string way, std::string of, double size, std::string label, int frames,
           std::vector<std::string> command) {
    Run one{std::move(way), std::move(of), size, std::move(label), frames, std::move(command)};
    one.ours = one.way.starts_with("rinkaku");
    if (one.ours) one.command.insert(one.command.end(), {"--timings", timings().string()});
    runs.push_back(std::move(one));
  }
  // As many as take some seconds: start-up is in the times.
  int frames_at(const Size& size) const {
    if (settings_.quick) return 30;
    return std::clamp(300 * 1280 * 720 / (size.width_px * size.height_px), 75, 300);
  }
  std::filesystem::path timings() const { return settings_.scratch / "timings.json"; }
  // What the last run's stages took one after another, for the median frame: its latency where nothing waits.
  double way_of_a_frame_ms() const {
    const nlohmann::json told = nlohmann::json::parse(std::ifstream(timings()));
    double sum = 0;
    for (const nlohmann::json& stage : told.at("stages")) sum += stage.at("p50_ms").get<double>();
    return sum;
  }
  std::string mesh_of(int n) const {
    return scratch_file(settings_, "ball" + std::to_string(n) + ".obj", ball_obj(n)).string();
  }
  std::string video_of(const Size& size) const {
    const std::string file = (settings_.scratch / ("in" + std::to_string(size.height_px) + ".mp4")).string();
    run_whole(settings_,
              {"ffmpeg",
               "-v",
               "error",
               "-nostdin",
               "-y",
               "-stream_loop",
               "-1",
               "-i",
               recorded(settings_, "desk/video.mp4").string(),
               "-an",
               "-vf",
               "scale=" + std::to_string(size.width_px) + ":" + std::to_string(size.height_px) + ",setpts=N/30/TB",
               "-r",
               "30",
               "-frames:v",
               std::to_string(frames_at(size)),
               "-c:v",
               "mpeg4",
               "-b:v",
               "6000000",
               file});
    return file;
  }
  std::string still_of(const Size& size) const {
    const std::string file = (settings_.scratch / ("still" + std::to_string(size.height_px) + ".png")).string();
    const int side = size.height_px / 2;
    run_whole(settings_, {"ffmpeg", "-v", "error", "-nostdin", "-y", "-f", "lavfi", "-i",
                          "color=orange:s=" + std::to_string(side) + "x" + std::to_string(side) +
                              ",format=rgba,geq=r='r(X,Y)':g='g(X,Y)':b='b(X,Y)':a='255*lt(hypot(X-W/2,Y-H/2),W/2)'",
                          "-frames:v", "1", file});
    return file;
  }
  std::vector<std::string> ffmpeg(const std::string& video, const std::vector<std::string>& middle) const {
    std::vector<std::string> command = {"ffmpeg", "-v", "error", "-nostdin", "-y", "-i", video};
    command.insert(command.end(), middle.begin(), middle.end());
    command.insert(command.end(),
                   {"-an", "-c:v", "mpeg4", "-b:v", "6000000", (settings_.scratch / "other.mp4").string()});
    return command;
  }
  // The same overlay: decoded and encoded by the same libraries, composited by GStreamer's own element.
  std::vector<std::string> gstreamer(const std::string& video, const Size& size) const {
    std::vector<std::string> command = {"gst-launch-1.0"};
    const auto say = [&command](const std::string& text, const std::filesystem::path& location) {
      std::istringstream words(text);
      for (std::string word; words >> word;) command.push_back(word);
      if (!location.empty()) command.push_back("location=" + location.string());
    };
    // Queues part the line into threads; the still is converted once.
    say("-q compositor name=mix sink_1::xpos=" + std::to_string(size.width_px / 3) +
            " sink_1::ypos=" + std::to_string(size.height_px / 4) +
            " ! video/x-raw,format=I420 ! queue ! avenc_mpeg4 bitrate=6000000 ! mp4mux ! filesink",
        settings_.scratch / "gstreamer.mp4");
    say("filesrc", video);
    say("! qtdemux ! avdec_mpeg4 ! queue ! mix.sink_0 filesrc", still_of(size));
    say("! pngdec ! videoconvert ! imagefreeze num-buffers=" + std::to_string(frames_at(size)) +
            " ! video/x-raw,framerate=30/1 ! queue ! mix.sink_1",
        {});
    return command;
  }
  // Objects side by side that fill half of the picture's height together, or one that does so alone.
  std::vector<std::string> object_scene(const Size& size, const std::string& name,
                                        const std::vector<std::string>& meshes) const {
    const std::string camera = "camera" + std::to_string(size.height_px) + ".yml";
    scratch_file(settings_, camera, camera_yml(size.width_px, size.height_px));
    std::string scene = "[plate]\nvideo = \"in" + std::to_string(size.height_px) + ".mp4\"\ncamera = \"" + camera +
                        "\"\n[track]\nlocked = { position_m = [0, -3.5, 0.5], look_at_m = [0, 0, 0.5] }\n";
    int columns = 1;
    while (columns * columns < static_cast<int>(meshes.size())) ++columns;
    for (int i = 0; i < static_cast<int>(meshes.size()); ++i) {
      const double cell = 1.0 / columns;
      char place[160];
      std::snprintf(place, sizeof place, "height_m = %.4f\nposition_m = [%.4f, 0, %.4f]\n", 0.9 * cell,
                    (i % columns + 0.5) * cell - 0.5, i / columns * cell);
      scene += "[[object]]\nmesh = \"" + meshes[static_cast<std::size_t>(i)] + "\"\n" + place +
               "toon = { bands = 3 }\noutline = { width_px = 3 }\n";
    }
    return render_command(settings_, scratch_file(settings_, "scene" + name + ".toml", scene), "");
  }

  const Settings& settings_;
  bool gstreamer_ = gstreamer_can_encode();
};

Plot plot_of(const std::vector<Run>& runs, const std::string& of, const char* title, const char* x) {
  Plot plot;
  plot.title = title;
  plot.x.title = x;
  plot.y.title = "time a frame, ms";
  plot.front = false;
  for (const Run& run : runs) {
    if (run.of != of) continue;
    auto at = std::find_if(plot.series.begin(), plot.series.end(), [&](const Series& s) { return s.name == run.way; });
    if (at == plot.series.end()) at = plot.series.insert(at, Series{run.way, {}, true});
    at->points.push_back({of == "pixels" ? run.size / 1e6 : run.size, run.watch.timing().wall_ms.median, 0, 0, ""});
  }
  return plot;
}

// CPU time's, which hardly depends on what else the machine does.
std::map<std::string, double> exponents(const std::vector<Run>& runs) {
  std::map<std::string, std::vector<glm::dvec2>> points;
  for (const Run& run : runs) points[run.way].emplace_back(run.size, run.watch.timing().cpu_ms);
  std::map<std::string, double> found;
  for (const auto& [way, of] : points) {
    if (const auto exponent = growth_exponent(of)) found[way] = *exponent;
  }
  return found;
}

}  // namespace

Section whole_section(const Settings& settings) {
  Runs runs(settings);
  const Size hd{1280, 720};
  if (settings.quick) {
    runs.at_sizes({{640, 360}, hd});
    runs.at_triangles(hd, {24, 144});
    runs.at_objects(hd, {1, 16});
  } else {
    runs.at_sizes({{640, 360}, hd, {1920, 1080}, {3840, 2160}});
    runs.at_triangles(hd, {24, 48, 96, 192, 288});
    runs.at_objects(hd, {1, 4, 16, 64});
  }
  Section section;
  section.repetitions = settings.quick ? 1 : 3;
  runs.run(section.repetitions);
  const auto grows = exponents(runs.runs);
  section.intro =
      std::string("Whole programs on ") + (settings.quick ? "30 frames" : "75 to 300 frames (fewer of large ones)") +
      " of recordings/desk, decoded and encoded as MPEG-4 at 6 Mbit/s, in turn: rinkaku with an empty "
      "scene beside ffmpeg's transcoding, and with a toon-shaded, outlined ball half as high as the picture "
      "beside ffmpeg's and GStreamer's overlays of a still. Start-up is in the times. Latency is what the stages take "
      "one after another "
      "for the median frame, from decoding to the encoded packet. The growth exponent n says that "
      "CPU time a frame grows like size^n.";
  section.table.columns = {{"method", "Method"},        {"size", "Size"},
                           {"fps", "Frames a second"},  {"time_ms", "Time a frame, ms"},
                           {"time_low_ms", "low"},      {"time_high_ms", "high"},
                           {"cpu_ms", "CPU, ms"},       {"latency_ms", "Latency, ms"},
                           {"peak_mib", "Memory, MiB"}, {"growth", "Growth exponent"}};
  for (const Run& run : runs.runs) {
    const Timing time = run.watch.timing();
    const auto exponent = grows.find(run.way);
    section.table.rows.push_back({run.way, run.label + (run.of == "pixels" ? "" : " " + run.of),
                                  1000 / time.wall_ms.median, time.wall_ms.median, time.wall_ms.low, time.wall_ms.high,
                                  time.cpu_ms, run.ours ? Cell(spread(run.latency_ms).median) : Cell(), run.peak_mib,
                                  exponent != grows.end() ? Cell(exponent->second) : Cell()});
  }
  const auto told = [&grows](const char* way) {
    const auto at = grows.find(way);
    return at != grows.end() ? readable(at->second) : std::string("unknown");
  };
  section.plots = {
      plot_of(runs.runs, "pixels", "Against the size of the picture", "megapixels"),
      plot_of(runs.runs, "triangles", "Against the number of triangles", "triangles, at 1280x720"),
      plot_of(runs.runs, "objects", "Against the number of objects", "objects of 1,152 triangles, at 1280x720")};
  section.plots[0].says = "Growth exponents: " + told("rinkaku, object") + " with an object, " +
                          told("rinkaku, empty scene") + " empty, " + told("ffmpeg overlay") + " for ffmpeg's overlay.";
  section.plots[1].says = "Growth exponent " + told("rinkaku, triangles") + ": below 1 as long as pixels cost more.";
  section.plots[2].says =
      "Growth exponent " + told("rinkaku, objects") + "; together they cover the same part of the picture.";
  if (!runs.gstreamer()) {
    section.notes.emplace_back(
        "GStreamer's compositor is not among them: gst-launch-1.0 with libav and mp4mux (gstreamer1.0-libav, "
        "gstreamer1.0-plugins-good) isn't installed.");
  }
  return section;
}

}  // namespace rinkaku::report

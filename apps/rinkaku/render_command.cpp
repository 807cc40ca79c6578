#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/interrupt.h"
#include "apps/rinkaku/json_output.h"
#include "apps/rinkaku/progress_bar.h"
#include "pipeline/files/pending_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"
#include "pipeline/pipeline.h"
#include "pipeline/session/replay.h"

namespace rinkaku::app {
namespace {

std::int64_t frame_number(const std::string& range, std::string_view text, std::int64_t if_empty) {
  if (text.empty()) return if_empty;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) {
    throw input_error("--frames", "'" + range + "' is no range of frames", "write A:B with 0 <= A < B, e.g. 0:100");
  }
  return value;
}

void set_frames(const std::string& range, pipeline::RenderOptions& options) {
  if (range.empty()) return;
  const std::size_t colon = range.find(':');
  if (colon == std::string::npos) {
    throw input_error("--frames", "'" + range + "' is no range of frames", "write A:B with 0 <= A < B, e.g. 0:100");
  }
  const std::string_view text = range;
  options.first_frame = frame_number(range, text.substr(0, colon), 0);
  options.end_frame = frame_number(range, text.substr(colon + 1), options.end_frame);
  if (options.end_frame <= options.first_frame) {
    throw input_error("--frames", "'" + range + "' holds no frame", "write A:B with 0 <= A < B, e.g. 0:100");
  }
}

nlohmann::json to_json(const pipeline::RenderReport& report) {
  nlohmann::json stages = nlohmann::json::array();
  for (const pipeline::StageReport& stage : report.stages) {
    stages.push_back({{"name", stage.name},
                      {"p50_ms", stage.times.percentile_ms(0.5)},
                      {"p99_ms", stage.times.percentile_ms(0.99)},
                      {"max_ms", stage.times.max_ms()},
                      {"mean_ms", stage.times.mean_ms()},
                      {"frames", stage.times.count()}});
  }
  const gl::Made made = gl::made();
  return {{"output", report.output},
          {"frames", report.frames},
          {"posed_frames", report.posed_frames},
          {"fps", report.seconds > 0 ? static_cast<double>(report.frames) / report.seconds : 0.0},
          {"seconds", report.seconds},
          {"width", report.width_px},
          {"height", report.height_px},
          {"interrupted", report.interrupted},
          {"dropped", report.dropped.before + report.dropped.drawn},
          {"notices", report.notices},
          {"opengl", {{"programs", made.programs}, {"buffers", made.buffers}, {"textures", made.textures}}},
          {"stages", stages}};
}

session::Session read_session(const RenderCall& call) {
  if (!call.input.empty()) throw input_error("--input", "a session brings its own recording", "leave it out");
  return session::read_session(call.scene);
}

void print_summary(const pipeline::RenderReport& report, bool to_standard_output) {
  std::FILE* out = to_standard_output ? stdout : stderr;
  std::fprintf(out, "%s: %lld %s of %dx%d in %.1f s (%.1f fps)%s\n", report.output.c_str(),
               static_cast<long long>(report.frames), report.frames == 1 ? "frame" : "frames", report.width_px,
               report.height_px, report.seconds,
               report.seconds > 0 ? static_cast<double>(report.frames) / report.seconds : 0.0,
               report.interrupted ? ", interrupted" : "");
}

}  // namespace

int render(const RenderCall& call) {
  pipeline::RenderOptions options;
  options.output = call.output;
  options.codec = call.codec;
  options.container = call.format;
  options.bit_rate = call.bit_rate;
  options.layers_folder = call.layers;
  options.overwrite = call.force;
  options.tell = [](const std::string& line) { std::fprintf(stderr, "rinkaku: note: %s\n", line.c_str()); };
  set_frames(call.frames, options);
  std::optional<files::PendingFile> timings;
  if (!call.timings.empty()) timings.emplace(call.timings, call.force);

  std::optional<session::Session> session;
  if (session::is_session(call.scene)) session = read_session(call);
  std::optional<session::Replay> replay;
  if (session) replay.emplace(*session);
  const pipeline::Prepared prepared = pipeline::prepare(
      session ? session::scene_of(*session) : pipeline::read_scene(call.scene, {.input = call.input}), options);
  const bool pipes = prepared.scene.output.path == "-";
  if (pipes && call.json) {
    throw input_error("--json", "standard output already takes the frames", "use --timings FILE.json, or -o FILE");
  }
  if (timings) timings->must_not_be(prepared.scene.output.path);
  pipeline::RenderReport report;
  {
    ProgressBar bar;
    report = pipeline::render(
        prepared, options, interrupted(), [&bar](std::int64_t done, std::int64_t total) { bar.update(done, total); },
        replay ? &*replay : nullptr);
  }
  if (timings) timings->write(json_text(to_json(report), 2));
  for (const std::string& notice : report.notices) std::fprintf(stderr, "rinkaku: note: %s\n", notice.c_str());
  if (call.json) {
    print_json(to_json(report));
  } else {
    print_summary(report, !pipes);
  }
  return 0;
}

}  // namespace rinkaku::app

#include <cstdio>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/json_output.h"
#include "apps/rinkaku/viewer/view.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/shader_text.h"

namespace rinkaku::app {
namespace {

nlohmann::json times(const pipeline::StageTimes& times) {
  return {{"p50_ms", times.percentile_ms(0.5)},
          {"p99_ms", times.percentile_ms(0.99)},
          {"max_ms", times.max_ms()},
          {"frames", times.count()}};
}

nlohmann::json to_json(const ViewReport& report) {
  nlohmann::json stages = nlohmann::json::array();
  if (report.run) {
    for (const pipeline::StageReport& stage : report.run->stages) {
      nlohmann::json one = times(stage.times);
      one["name"] = stage.name;
      stages.push_back(one);
    }
  }
  return {{"frames", report.shown},
          {"seconds", report.seconds},
          {"fps", report.seconds > 0 ? static_cast<double>(report.shown) / report.seconds : 0.0},
          {"capture_to_screen", times(report.latency)},
          {"interval", times(report.interval)},
          {"captured", report.health.frames},
          {"missed", report.health.missed},
          {"damaged", report.health.damaged},
          {"reconnects", report.health.reconnects},
          {"dropped", report.dropped.before},
          {"unshown", report.unshown},
          {"dropped_recording", report.dropped.drawn},
          {"output", report.run ? report.run->output : std::string()},
          {"notices", report.run ? report.run->notices : std::vector<std::string>()},
          {"stages", stages}};
}

void print(const ViewReport& report) {
  std::printf("%lld frames in %.1f s (%.1f fps)\n", static_cast<long long>(report.shown), report.seconds,
              report.seconds > 0 ? static_cast<double>(report.shown) / report.seconds : 0.0);
  if (report.latency.count() > 0) {
    std::printf("capture to screen: %.1f ms at the median, %.1f ms at p99\n", report.latency.percentile_ms(0.5),
                report.latency.percentile_ms(0.99));
  }
  if (report.run) {
    for (const std::string& notice : report.run->notices) std::fprintf(stderr, "rinkaku: note: %s\n", notice.c_str());
  }
}

}  // namespace

int view(const ViewCall& call, bool live) {
  if (!call.shaders.empty()) {
    if (!std::filesystem::is_directory(call.shaders)) {
      throw input_error(call.shaders, "is no folder", "give one with shaders as rinkaku's sources have them");
    }
    gl::use_shaders_from(call.shaders);
  }
  SceneFile file(call.scene, {.input = call.input, .device = call.camera}, call.shaders);
  if (live && !file.scene().plate.device) {
    throw input_error(file.scene().file.string(), "films a recording, not a camera",
                      "give --camera /dev/video0, or 'device' in [plate]; 'rinkaku play' shows recordings");
  }
  if (!live && file.scene().plate.device) {
    throw input_error(file.scene().file.string(), "films with a camera", "show it with 'rinkaku live'");
  }
  ViewOptions options;
  options.run.watched = true;
  options.run.output = call.record;
  options.run.virtual_camera = call.virtual_camera;
  options.run.codec = call.codec;
  options.run.overwrite = call.force;
  options.run.predict_poses = call.lowest_latency;
  options.seconds = call.seconds;
  options.session = call.session;
  options.headless = call.headless;
  options.panel = !call.no_panel;
  if (!call.screenshots.empty()) options.screenshots = call.screenshots;
  const ViewReport report = view(file, options);
  if (call.json) {
    print_json(to_json(report));
  } else {
    print(report);
  }
  return 0;
}

}  // namespace rinkaku::app

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "pipeline/pipeline.h"
#include "report/sections/recording.h"
#include "report/sections/rendered_scene.h"

namespace rinkaku::report {
namespace {

// A scene that has one thing more than the one it is named after.
struct Case {
  std::string name;
  std::string beyond;
  std::filesystem::path scene{};
  std::vector<std::string> stages{};
  std::vector<double> start_ms{}, frame_ms{}, frame_cpu_ms{};
  double peak_mib = 0;
  double programs = 0, buffers_and_textures = 0;
};

std::vector<Case> cases_of(const Settings& settings) {
  const auto path = [&settings](const char* file) { return "\"" + recorded(settings, file).string() + "\"\n"; };
  const std::string plate = "[plate]\nvideo = " + path("desk/video.mp4");
  const std::string pinhole =
      "camera = \"" + scratch_file(settings, "pinhole.yml", camera_yml(1280, 720)).string() + "\"\n";
  const std::string lens = "camera = " + path("desk/camera.yml");
  const std::string locked = "[track]\nlocked = { position_m = [0, -3.5, 0.5], look_at_m = [0, 0, 0.5] }\n";
  const std::string ball = scratch_file(settings, "ball.obj", ball_obj(48)).string();
  const std::string object = "[[object]]\nmesh = \"" + ball + "\"\nheight_m = 0.9\ntoon = { bands = 3 }\n";
  // As large in the picture as the others.
  const std::string on_board = "[[object]]\nmesh = \"" + ball + "\"\nheight_m = 0.13\nposition_m = [0.12, 0.09, 0]\n";
  const std::string board = "[track]\nboard = " + path("desk/board.toml");
  const std::string line = "outline = { width_px = 3 }\n";
  const std::string lined = plate + pinhole + locked + object + line;
  const std::array<std::array<std::string, 3>, 10> scenes{{
      {"empty scene", "", plate},
      {"board that nothing follows", "empty scene", plate + lens + board},
      {"object", "empty scene", plate + pinhole + locked + object},
      {"outline", "object", lined},
      {"lens", "outline", plate + lens + locked + object + line},
      {"tracking a board", "lens", plate + lens + board + on_board + "toon = { bands = 3 }\n" + line},
      {"strokes for a line", "object", plate + pinhole + locked + object + "outline = { method = \"strokes\" }\n"},
      {"fluff", "object", plate + pinhole + locked + object + "fluffy = true\n"},
      {"filmed thing before it", "outline",
       lined + "[[foreground]]\nname = \"hand\"\nmethod = \"difference\"\ndistance_m = 1\n"},
      {"painted water", "empty scene",
       plate + pinhole + locked +
           "[water]\n[[water.surface]]\noutline_m = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]\n" +
           "[[water.surface.arrow]]\nfrom_m = [-0.5, 0.5, 0]\nto_m = [0.5, 0.5, 0]\n"},
  }};
  std::vector<Case> cases;
  for (const auto& [name, beyond, text] : scenes) {
    Case one{name, beyond};
    one.scene = scratch_file(settings, "case" + std::to_string(cases.size()) + ".toml", text);
    const pipeline::Prepared prepared = pipeline::prepare(pipeline::read_scene(one.scene), {});
    for (const pipeline::Stage& stage : prepared.plan.stages) {
      if (stage.runs) one.stages.push_back(stage.name);
    }
    cases.push_back(std::move(one));
  }
  return cases;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

Section left_out_section(const Settings& settings) {
  std::vector<Case> cases = cases_of(settings);
  const int frames = settings.quick ? 15 : 150;
  Section section;
  section.repetitions = settings.quick ? 1 : 7;
  const std::string timings = (settings.scratch / "timings.json").string();
  for (int round = 0; round < section.repetitions; ++round) {
    for (Case& one : cases) {
      const ChildRun first = run_whole(settings, render_command(settings, one.scene, ":1"));
      std::vector<std::string> command = render_command(settings, one.scene, ":" + std::to_string(frames));
      command.insert(command.end(), {"--timings", timings});
      const ChildRun all = run_whole(settings, command);
      const nlohmann::json made = nlohmann::json::parse(std::ifstream(timings)).at("opengl");
      one.programs = made.at("programs");
      one.buffers_and_textures = made.at("buffers").get<double>() + made.at("textures").get<double>();
      one.start_ms.push_back(first.cpu_ms);
      one.frame_ms.push_back((all.wall_ms - first.wall_ms) / (frames - 1));
      one.frame_cpu_ms.push_back((all.cpu_ms - first.cpu_ms) / (frames - 1));
      one.peak_mib = std::max(one.peak_mib, all.peak_mib);
    }
  }
  section.intro =
      "What each thing that a scene may have costs beyond a scene without it, rendered from recordings/desk "
      "as whole programs of " +
      std::to_string(frames) +
      " frames. A scene pays for what it says: the stages that run are told by the plan, as by 'rinkaku "
      "explain'. Start-up is the CPU time of rendering one frame.";
  section.table.columns = {{"scene", "Scene with"},
                           {"beyond", "Beyond"},
                           {"frame_ms", "A frame, ms"},
                           {"frame_cpu_ms", "A frame, CPU ms"},
                           {"more_cpu_ms", "more"},
                           {"start_cpu_ms", "Start-up, CPU ms"},
                           {"more_start_cpu_ms", "more"},
                           {"peak_mib", "Memory, MiB"},
                           {"more_mib", "more"},
                           {"programs", "Shader programs"},
                           {"gl_objects", "Buffers and textures"},
                           {"stages", "Stages that run"}};
  Plot plot;
  plot.title = "Memory and time of scenes that have more and more";
  plot.x.title = "CPU time a frame, ms";
  plot.y.title = "most memory resident, MiB";
  plot.y.log = false;
  plot.front = false;
  for (const Case& one : cases) {
    const auto base = std::find_if(cases.begin(), cases.end(), [&](const Case& c) { return c.name == one.beyond; });
    const double cpu = spread(one.frame_cpu_ms).median, start = spread(one.start_ms).median;
    const bool has_base = base != cases.end();
    section.table.rows.push_back({one.name, one.beyond, spread(one.frame_ms).median, cpu,
                                  has_base ? Cell(cpu - spread(base->frame_cpu_ms).median) : Cell(), start,
                                  has_base ? Cell(start - spread(base->start_ms).median) : Cell(), one.peak_mib,
                                  has_base ? Cell(one.peak_mib - base->peak_mib) : Cell(), one.programs,
                                  one.buffers_and_textures, joined(one.stages)});
    plot.series.push_back({one.name, {{cpu, one.peak_mib, 0, 0, one.name}}, false});
  }
  plot.says =
      "What a scene leaves out it doesn't pay for: an empty scene makes no OpenGL context, and a board that nothing "
      "follows isn't looked for.";
  section.plots.push_back(std::move(plot));
  section.notes.emplace_back(
      "rinkaku-bench-leaving-out compares with a program that is built without water, filmed things and fluff.");
  return section;
}

}  // namespace rinkaku::report

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/matte_commands.h"
#include "pipeline/frame/error.h"

namespace {

using namespace rinkaku::app;

constexpr int input_is_wrong = 2, failed_at_run_time = 1;

// The commands' options; each command's function runs after the whole line was understood.
struct CommandLine {
  CLI::App app{"rinkaku draws CG objects into filmed video, in front of and behind what was filmed, as a drawing."};
  std::function<int()> run;
  RenderCall render;
  ViewCall play, live;
  DevicesCall devices;
  ExplainCall explain;
  InspectCall inspect;
  BoardCall board;
  CalibrateCall calibrate;
  CurvatureCall curvature;
  SheetCall sheet;
  TraceCall trace;
  BakeCall bake;
  MatteCall matte;
  VerifyCall verify;
  ScoreCall score;
  ReportCall report;

  CommandLine() {
    app.name("rinkaku");
    app.require_subcommand(1);
    app.set_version_flag("--version", "rinkaku " RINKAKU_VERSION);
    app.footer("rinkaku COMMAND --help shows a command's options with an example.");
    add_render();
    add_play();
    add_live();
    add_devices();
    add_explain();
    add_inspect();
    add_board();
    add_calibrate();
    add_curvature();
    add_sheet();
    add_trace();
    add_bake();
    add_matte();
    add_verify();
    add_score();
    add_report();
  }

  CLI::App* add(const char* name, const char* description, const char* example, std::function<int()> command) {
    CLI::App* sub = app.add_subcommand(name, description);
    sub->footer(std::string("Example:\n  ") + example);
    sub->callback([this, command] { run = command; });
    return sub;
  }
  static void add_json(CLI::App* sub, bool& json) {
    sub->add_flag("--json", json, "Print one JSON object on standard output, and nothing else there");
  }
  static void add_force(CLI::App* sub, bool& force) {
    sub->add_flag("--force", force, "Write over outputs that exist");
  }

  void add_render() {
    RenderCall& c = render;
    CLI::App* sub =
        add("render", "Render a scene into a video or an image sequence.",
            "rinkaku render recordings/desk/scene.toml -o desk.mp4", [&c] { return rinkaku::app::render(c); });
    sub->add_option("SCENE", c.scene, "Scene file (TOML), or the folder of a session that live kept")->required();
    sub->add_option("--input", c.input, "Video to use in place of the scene's");
    sub->add_option("-o,--output", c.output,
                    "Video file, image pattern such as out/%04d.png, or - for standard output (see --format)");
    sub->add_option("--frames", c.frames,
                    "Only the frames A:B, counted from 0, B not included; A: and :B are fine too");
    sub->add_option("--layers", c.layers,
                    "Folder for each layer of each frame: plate, mattes, CG with straight alpha; PNG");
    sub->add_option("--timings", c.timings, "File for each stage's times (JSON)");
    sub->add_option("--codec", c.codec,
                    "Encoder: h264, mpeg4, ffv1, ffvhuff, or any name FFmpeg knows; else by the ending");
    sub->add_option("--bit-rate", c.bit_rate, "Bits per second; the encoder's good default quality if not given")
        ->check(CLI::Range(std::int64_t{1000}, std::int64_t{10'000'000'000}));
    sub->add_option("--format", c.format, "What goes to standard output")->check(CLI::IsMember({"y4m", "raw"}));
    add_force(sub, c.force);
    add_json(sub, c.json);
  }

  static void add_view(CLI::App* sub, ViewCall& c) {
    sub->add_option("SCENE", c.scene, "Scene file (TOML)")->required();
    sub->add_option("--seconds", c.seconds, "End by itself after so long")->check(CLI::Range(0.1, 1e9));
    sub->add_flag("--no-panel", c.no_panel, "Begin with the panel closed (Tab opens it)");
    sub->add_option("--shaders", c.shaders,
                    "Folder whose shaders take the place of those built in, e.g. rinkaku's own sources; read anew when "
                    "they change");
    sub->add_option("--screenshots", c.screenshots, "Folder for screenshots (key P); the current one if not given");
    add_json(sub, c.json);
  }

  void add_play() {
    ViewCall& c = play;
    CLI::App* sub =
        add("play",
            "Show a recording's scene in a window: space pauses, . steps, F fills the screen, Tab opens the "
            "panel, P takes a screenshot, Ctrl-S saves the scene, Home restarts, Q quits.",
            "rinkaku play recordings/desk/scene.toml", [&c] { return rinkaku::app::view(c, false); });
    add_view(sub, c);
    sub->add_option("--input", c.input, "Video to use in place of the scene's");
  }

  void add_live() {
    ViewCall& c = live;
    CLI::App* sub = add("live", "Show a camera's scene in a window, with the keys of play.",
                        "rinkaku live scene.toml --camera /dev/video0", [&c] { return rinkaku::app::view(c, true); });
    add_view(sub, c);
    sub->add_option("--camera", c.camera, "Camera to use in place of the scene's plate, as 'rinkaku devices' lists it");
    sub->add_option("--record", c.record,
                    "Video file to record what is shown to; playable at any moment, also if this is killed");
    sub->add_option("--codec", c.codec, "Encoder of the recording; else by its ending");
    sub->add_option("--session", c.session,
                    "New folder to keep the session in: 'rinkaku render FOLDER' makes the same frames again");
    sub->add_option("--virtual-camera", c.virtual_camera,
                    "Video output device (v4l2loopback), or pipewire, that other programs read as a camera");
    sub->add_flag("--lowest-latency", c.lowest_latency,
                  "Draw with poses that are predicted from the last ones, in place of waiting for a frame's own");
    sub->add_flag("--headless", c.headless, "Without a window, until Ctrl-C or --seconds");
    add_force(sub, c.force);
  }

  void add_devices() {
    DevicesCall& c = devices;
    CLI::App* sub = add("devices", "List the cameras there are, with their modes and controls.", "rinkaku devices",
                        [&c] { return rinkaku::app::devices(c); });
    sub->add_option("DEVICE", c.devices, "Only these, e.g. /dev/video0");
    add_json(sub, c.json);
  }

  void add_explain() {
    ExplainCall& c = explain;
    CLI::App* sub = add("explain", "Tell which stages a scene runs and why, and which it leaves out and why.",
                        "rinkaku explain recordings/desk/scene.toml", [&c] { return rinkaku::app::explain(c); });
    sub->add_option("SCENE", c.scene, "Scene file (TOML)")->required();
    sub->add_flag("--layers", c.layers, "As if rendered with --layers");
    sub->add_flag("--dot", c.dot, "Print the plan as a Graphviz graph");
    add_json(sub, c.json);
  }

  void add_inspect() {
    InspectCall& c = inspect;
    CLI::App* sub = add("inspect", "Look a mesh over: size, closed?, manifold?, slivers, winding, skins, clips.",
                        "rinkaku inspect cat.glb", [&c] { return rinkaku::app::inspect(c); });
    sub->add_option("MESH", c.mesh, "Mesh file (glTF, GLB, VRM, OBJ, PLY, OFF, STL, FBX, ...)")->required();
    add_json(sub, c.json);
  }

  void add_board() {
    BoardCall& c = board;
    CLI::App* sub = add("board", "Make a page to print from a board file, true to scale.",
                        "rinkaku board board.toml -o board.pdf", [&c] { return rinkaku::app::board(c); });
    sub->add_option("BOARD", c.board, "Board file (TOML)")->required();
    sub->add_option("-o,--output", c.output, "PDF to write")->required();
    sub->add_option("--page", c.page,
                    "A4, A3, A2, A1, A0, letter, or e.g. 200x150 in millimetres; the smallest A that fits");
    add_force(sub, c.force);
    add_json(sub, c.json);
  }

  void add_calibrate() {
    CalibrateCall& c = calibrate;
    CLI::App* sub = add("calibrate", "Measure a camera from videos of a board that is turned about before it.",
                        "rinkaku calibrate board.mp4 --board chessboard.toml -o camera.yml",
                        [&c] { return rinkaku::app::calibrate(c); });
    sub->add_option("VIDEO", c.videos, "One or more videos or image sequences of one camera")->required();
    sub->add_option("--board", c.board, "Board file (TOML)")->required();
    sub->add_option("-o,--output", c.output, "Camera file to write (OpenCV YAML)")->required();
    add_force(sub, c.force);
    add_json(sub, c.json);
  }

  void add_curvature() {
    CurvatureCall& c = curvature;
    CLI::App* sub =
        add("curvature", "Measure a mesh's curvature at each vertex, as a table and as a picture.",
            "rinkaku curvature cat.glb -o cat.csv --picture cat.png", [&c] { return rinkaku::app::curvature(c); });
    sub->add_option("MESH", c.mesh, "Mesh file (glTF, GLB, VRM, OBJ, PLY, OFF, STL, FBX, ...)")->required();
    sub->add_option("--method", c.method,
                    "meyer: cotangents; icnc: corrected curvature, robust; quadric: fitted to two rings; auto: icnc, "
                    "averaged where triangles are irregular")
        ->check(CLI::IsMember({"meyer", "icnc", "quadric", "auto"}))
        ->capture_default_str();
    sub->add_option("-o,--output", c.output,
                    "CSV file: vertex, x, y, z, mean, gauss, k1, k2; vertices at one position are one, convex is "
                    "positive, in the file's own units");
    sub->add_option("--picture", c.picture, "PNG file: convex red, flat white, concave blue");
    add_force(sub, c.force);
    add_json(sub, c.json);
  }

  void add_sheet() {
    SheetCall& c = sheet;
    CLI::App* sub = add("sheet", "Draw a mesh in every style of line, side by side.",
                        "rinkaku sheet cat.glb -o sheet.png", [&c] { return rinkaku::app::sheet(c); });
    sub->add_option("MESH", c.mesh, "Mesh file (glTF, GLB, VRM, OBJ, PLY, OFF, STL, FBX, ...)")->required();
    sub->add_option("-o,--output", c.output, "PNG to write")->required();
    sub->add_option("--styles", c.styles, "Only these, separated by commas: a method of a scene's outline each");
    sub->add_option("--width-px", c.width_px, "The lines' width")->check(CLI::Range(0.1, 100.0))->capture_default_str();
    sub->add_option("--cell-px", c.cell_px, "Size of one picture")->check(CLI::Range(64, 2048))->capture_default_str();
    sub->add_option("--columns", c.columns, "Pictures side by side")->check(CLI::Range(1, 16))->capture_default_str();
    sub->add_option("--turn-deg", c.turn_deg, "From how far to the side of the front it is seen")
        ->check(CLI::Range(-360.0, 360.0))
        ->capture_default_str();
    sub->add_option("--raise-deg", c.raise_deg, "From how far above the ground")
        ->check(CLI::Range(-89.0, 89.0))
        ->capture_default_str();
    sub->add_option("--clip", c.clip, "In motion: a moment of this clip of the mesh, else of its first");
    sub->add_option("--time-s", c.time_s, "Which moment")->check(CLI::Range(0.0, 1e6));
    add_force(sub, c.force);
    add_json(sub, c.json);
  }

  void add_trace() {
    TraceCall& c = trace;
    CLI::App* sub = add("trace", "Lay lines that were drawn on a frame onto the object seen there, to stay on it.",
                        "rinkaku trace scene.toml --frame 40 --lines drawn.txt -o marks.csv",
                        [&c] { return rinkaku::app::trace(c); });
    sub->add_option("SCENE", c.scene, "Scene file (TOML)")->required();
    sub->add_option("--frame", c.frame, "The frame that was drawn on, counted from 0")
        ->required()
        ->check(CLI::NonNegativeNumber);
    sub->add_option("--lines", c.lines, "Text file, one line a row, in pixels of the frame: 610,300 615,304 622,310")
        ->required();
    sub->add_option("--object", c.object, "Which object was drawn on, if the scene has several");
    sub->add_option("-o,--output", c.output, "File to write, for 'drawn' of the object's outline")->required();
    add_force(sub, c.force);
    add_json(sub, c.json);
  }

  void add_bake() {
    BakeCall& c = bake;
    CLI::App* sub =
        add("bake", "Reduce a mesh for every region of eyes, so that its mattes stay the same to the last pixel.",
            "rinkaku bake cat.obj -o cat.rgn", [&c] { return rinkaku::app::bake(c); });
    sub->add_option("MESH", c.mesh, "Mesh file")->required();
    sub->add_option("-o,--output", c.output, "Region file to write (.rgn)")->required();
    sub->add_option("--cells", c.cells, "Cells along an edge of the cube around the object; 6 N^2 a shell")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    sub->add_option("--shells", c.shells, "Shells of cells, the outermost reaching to infinity")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    sub->add_option("--inner", c.inner_radii, "Where regions begin, in radii of the object; nearer, all of it is drawn")
        ->check(CLI::Range(1.05, 100.0))
        ->capture_default_str();
    sub->add_option("--depth", c.depth_radii,
                    "Add lists that keep the depth within this distance, in radii of the object; 0: none")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    sub->add_flag("--drop-hidden", c.drop_hidden,
                  "Leave out of mattes what the front mesh hides from every eye of a region; takes twice as long");
    add_force(sub, c.force);
    add_json(sub, c.json);
  }

  void add_matte() {
    MatteCall& c = matte;
    CLI::App* sub = add("matte", "Draw which pixels of a picture a mesh covers.",
                        "rinkaku matte cat.obj --regions cat.rgn --method region --eye 0,0,4 --target 0,0,0 -o cat.png",
                        [&c] { return rinkaku::app::matte(c); });
    sub->add_option("MESH", c.mesh, "Mesh file")->required();
    sub->add_option("--regions", c.regions, "Region file that bake made of this mesh");
    sub->add_option("--eye", c.eye, "Where the eye is: X,Y,Z in the mesh's own coordinates")->required();
    sub->add_option("--target", c.target, "What it looks at: X,Y,Z")->required();
    sub->add_option("--fov-deg", c.fov_deg, "Field of view over the picture's height")
        ->check(CLI::Range(0.1, 170.0))
        ->capture_default_str();
    sub->add_option("--size", c.size, "The picture's size: WxH")->default_val("1280x720");
    sub->add_option("--method", c.method, "What is drawn: all triangles, the region's, or one of the rivals' choices")
        ->check(CLI::IsMember({"full", "region", "meshopt", "quadric", "cones"}))
        ->default_val("full");
    sub->add_option("--triangles", c.triangles, "For meshopt and quadric; as many as the region has if not given")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}));
    sub->add_option("-o,--output", c.output, "PNG to write: 255 where the mesh is, 0 elsewhere")->required();
    add_force(sub, c.force);
    add_json(sub, c.json);
  }

  void add_verify() {
    VerifyCall& c = verify;
    CLI::App* sub =
        add("verify", "Compare a region file's mattes with the whole mesh's from many eyes; status 1 if any differs.",
            "rinkaku verify cat.rgn --mesh cat.obj", [&c] { return rinkaku::app::verify(c); });
    sub->add_option("REGIONS", c.regions, "Region file (.rgn)")->required();
    sub->add_option("--mesh", c.mesh, "The mesh it was baked of")->required();
    sub->add_option("--eyes", c.eyes, "How many eyes")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}))
        ->capture_default_str();
    sub->add_option("--seed", c.seed, "Another number gives other eyes")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    sub->add_option("--size", c.size, "Size of all pictures: WxH; several from 640x480 to 3840x2160 if not given");
    add_json(sub, c.json);
  }

  void add_score() {
    ScoreCall& c = score;
    CLI::App* sub = add("score", "Measure how far a matte is from the true one.", "rinkaku score matte.png truth.png",
                        [&c] { return rinkaku::app::score(c); });
    sub->add_option("MATTE", c.matte, "Grey picture, or one with alpha; or a video or image sequence (m/%04d.png)")
        ->required();
    sub->add_option("TRUTH", c.truth, "The same of the truth, of the same size")->required();
    add_json(sub, c.json);
  }

  void add_report() {
    ReportCall& c = report;
    CLI::App* sub = add("report", "Measure error against run time on this machine: a page with plots, and tables.",
                        "rinkaku report -o report", [&c] { return rinkaku::app::report(c); });
    sub->add_option("-o,--output", c.output, "Folder for index.html and a CSV file for each section")->required();
    sub->add_flag("--quick", c.quick, "Fewer sizes and repetitions, in under a minute");
    sub->add_option("--sections", c.sections, "Only these, separated by commas");
    sub->add_option("--recordings", c.recordings, "The folder of the project's recordings, where it isn't found");
    sub->add_option("--seed", c.seed, "Of all that is random")->check(CLI::NonNegativeNumber)->capture_default_str();
    add_force(sub, c.force);
    add_json(sub, c.json);
  }
};

int say(std::string line, int status) {
  // What the user typed may hold line ends.
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  std::fprintf(stderr, "rinkaku: %s\n", line.c_str());
  return status;
}

// CLI11 would only say that a command is missing.
void check_command(CLI::App& app, int argc, char** argv) {
  const std::vector<CLI::App*> known = app.get_subcommands({});
  std::string remedy = "give ";
  for (const CLI::App* sub : known) remedy.append(sub->get_name()).append(", ");
  remedy += "or see rinkaku --help";
  if (argc < 2) throw rinkaku::input_error("", "no command was given", remedy);
  const std::string command = argv[1];
  const auto named_so = [&command](const CLI::App* sub) { return sub->get_name() == command; };
  if (command.starts_with("-") || std::any_of(known.begin(), known.end(), named_so)) return;
  throw rinkaku::input_error("", "there is no command '" + command + "'", remedy);
}

// Output that could not be written is an error where it is written, and the unfinished file is taken away.
void survive_failing_writes() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

int finish_output(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  return say("standard output: can't be written", failed_at_run_time);
}

}  // namespace

int main(int argc, char** argv) {
  survive_failing_writes();
  CommandLine line;
  try {
    check_command(line.app, argc, argv);
    line.app.parse(argc, argv);
    return finish_output(line.run());
  } catch (const CLI::Success& help) {
    return line.app.exit(help);
  } catch (const CLI::ParseError& wrong) {
    return say(std::string(wrong.what()) + "; see rinkaku --help", input_is_wrong);
  } catch (const rinkaku::Error& error) {
    return say(error.what(), error.exit_status());
  } catch (const std::bad_alloc&) {
    return say("out of memory; close other programs, or use a smaller picture or mesh", failed_at_run_time);
  } catch (const std::exception& unexpected) {
    return say(std::string("unexpected: ") + unexpected.what(), failed_at_run_time);
  }
}

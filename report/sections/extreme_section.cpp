#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "mesh/topology.h"
#include "outline/curvature.h"
#include "pipeline/gl/context.h"
#include "pipeline/objects/lone_mesh.h"
#include "report/sections/rendered_scene.h"
#include "report/sections/shapes.h"

namespace rinkaku::report {
namespace {

constexpr double kLine_px = 4;

// One case that no scene should hold and some will.
struct Case {
  std::string what, setting;
  std::string expected;
  std::string outcome{};
  double extreme = 0;                                       // what it is drawn against
  double error = std::numeric_limits<double>::quiet_NaN();  // in `unit`; none where a refusal is expected
  double allowed = 0;
  std::string unit{};
  double time_ms = 0;
};

void judge(Case& one, const char* seen) { one.outcome = one.error <= one.allowed ? seen : "WRONG"; }

struct Picture {
  int width_px = 400, height_px = 300;
  double focal_px = 300;
  double radius_px = 80;  // of the ball's contour
  double unit_m = 1;      // the ball's radius in the world
  double mesh_unit = 1;   // and in its file
  glm::dvec3 place_m{0};
};

double focal_for(double fov_deg, int width_px) { return width_px / 2.0 / std::tan(fov_deg / 360 * std::numbers::pi); }

mesh::Mesh ball(int n, double radius) {
  Ellipsoid shape;
  shape.axes = glm::dvec3(radius);
  return shape.mesh(n);
}

double area_px(const passes::Layer& layer) {
  double sum = 0;
  for (std::size_t i = 3; i < layer.rgba.size(); i += 4) sum += layer.rgba[i];
  return sum / 255;
}

bool sound(const passes::Layer& layer) {
  for (std::size_t i = 0; i < layer.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (layer.rgba[i + c] > layer.rgba[i + 3] + 1) return false;  // premultiplied colour is within its alpha
    }
  }
  return true;
}

// Draws an outlined ball straight before the camera, and compares the radius of what is covered with the circle that
// it is.
Case drawn(const Settings& settings, std::string what, std::string setting, double extreme, const Picture& p) {
  check_interrupted(settings);
  Case one{std::move(what), std::move(setting), "the circle, line included"};
  one.extreme = extreme;
  one.allowed = 0.25, one.unit = "px";
  passes::View view;
  view.camera.width_px = p.width_px, view.camera.height_px = p.height_px;
  view.camera.fx_px = view.camera.fy_px = p.focal_px;
  view.camera.cx_px = (p.width_px - 1) / 2.0, view.camera.cy_px = (p.height_px - 1) / 2.0;
  view.camera_from_world = {glm::dquat(1, 0, 0, 0), -p.place_m};
  const double distance = p.unit_m / std::sin(std::atan(p.radius_px / p.focal_px));
  const glm::dmat4 place = glm::scale(glm::translate(glm::dmat4(1), p.place_m + glm::dvec3(0, 0, distance)),
                                      glm::dvec3(p.unit_m / p.mesh_unit));
  // From so near that little of it is seen, its rim would have too few edges.
  const mesh::Mesh mesh = ball(p.radius_px / p.focal_px > 2 ? 256 : 96, p.mesh_unit);
  passes::ToonOptions toon;
  toon.bands = 0;
  pipeline::OutlineScene line;
  line.width_px = kLine_px;
  const auto renderer = pipeline::lone_mesh(mesh, place, toon, line, {0, 0, p.width_px, p.height_px});
  passes::Layer layer;
  Stopwatch watch;
  one.time_ms = watch.run([&] { renderer->draw(view, layer); });
  one.error = std::abs(std::sqrt(area_px(layer) / std::numbers::pi) - (p.radius_px + kLine_px));
  if (!sound(layer)) one.error = std::numeric_limits<double>::infinity();
  judge(one, "right");
  return one;
}

void draw_all(const Settings& settings, std::vector<Case>& cases) {
  char text[64];
  for (const double fov_deg : {1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 90.0, 120.0, 150.0, 160.0, 170.0}) {
    std::snprintf(text, sizeof text, "%g degrees", fov_deg);
    Picture p;
    p.focal_px = focal_for(fov_deg, p.width_px);
    cases.push_back(drawn(settings, "field of view", text, fov_deg, p));
  }
  for (const double metres : {1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3, 1e4, 1e5}) {
    std::snprintf(text, sizeof text, "%g m away", metres);
    Picture p;
    p.unit_m = metres * std::sin(std::atan(p.radius_px / p.focal_px));
    cases.push_back(drawn(settings, "distance", text, metres, p));
  }
  for (const double unit : {1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6}) {
    std::snprintf(text, sizeof text, "a radius of %g in its file", unit);
    Picture p;
    p.mesh_unit = unit;
    cases.push_back(drawn(settings, "size of the mesh", text, unit, p));
  }
  for (const double metres : {1.0, 1e2, 1e4, 1e5, 1e6}) {
    std::snprintf(text, sizeof text, "%g m from the origin", metres);
    Picture p;
    p.place_m = glm::dvec3(1, -0.6, 0.3) * metres;
    cases.push_back(drawn(settings, "place", text, metres, p));
  }
  const std::pair<int, int> largest = settings.quick ? std::pair{3840, 2160} : std::pair{8192, 4320};
  for (const auto& [width_px, height_px] : {std::pair{1, 1}, {17, 31}, {641, 479}, {1921, 1081}, largest}) {
    std::snprintf(text, sizeof text, "%dx%d", width_px, height_px);
    Picture p;
    p.width_px = width_px, p.height_px = height_px, p.focal_px = height_px;
    p.radius_px = 0.2 * std::min(width_px, height_px);
    Case one = drawn(settings, "picture", text, static_cast<double>(width_px) * height_px, p);
    if (height_px == 1) {
      // The line is wider than the picture: what can be seen is covered, and nothing else.
      one.error = std::abs(one.error - (p.radius_px + kLine_px - std::sqrt(1 / std::numbers::pi)));
      one.expected = "covered whole";
      judge(one, "right");
    }
    cases.push_back(one);
  }
}

// Curvature of a ball is known whatever its size; far from its origin float positions are what limits it.
void curve_all(const Settings& settings, std::vector<Case>& cases) {
  char text[64];
  for (const double radius : {1e-30, 1e-12, 1e-6, 1.0, 1e6, 1e12}) {
    check_interrupted(settings);
    std::snprintf(text, sizeof text, "a ball of radius %g", radius);
    Case one{"curvature", text, "1 over the radius everywhere"};
    one.extreme = radius, one.allowed = 0.02, one.unit = "of it";
    const mesh::Topology topology = mesh::topology(ball(48, radius));
    outline::CurvatureSolver solver(topology, outline::CurvatureMethod::Auto);
    Stopwatch watch;
    const outline::Curvature* found = nullptr;
    one.time_ms = watch.run([&] { found = &solver.solve(topology.points); });
    one.error = 0;
    for (const float mean : found->mean) {
      const double error = std::abs(static_cast<double>(mean) * radius - 1);
      one.error = std::isfinite(error) ? std::max(one.error, error) : std::numeric_limits<double>::infinity();
    }
    judge(one, "right");
    cases.push_back(one);
  }
}

constexpr const char* kObject = "[[object]]\nmesh = \"ball.obj\"\n";

// Calls of the program that it must refuse: exit status 2, and one line that names it.
void refuse_all(const Settings& settings, std::vector<Case>& cases) {
  if (settings.recordings.empty()) return;
  const std::string desk = (settings.recordings / "desk").string();
  const std::string plate = "[plate]\nvideo = \"" + desk + "/video.mp4\"\ncamera = \"" + desk + "/camera.yml\"\n";
  const std::string board = "[track]\nboard = \"" + desk + "/board.toml\"\n";
  scratch_file(settings, "ball.obj", ball_obj(4));
  scratch_file(settings, "empty.obj", "# nothing\n");
  scratch_file(settings, "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  scratch_file(settings, "torn.rgn", "RGN");
  scratch_file(settings, "poses.csv", "frame,tx,ty,tz,qx,qy,qz,qw\n0,0,0,nan,0,0,0,1\n");
  const std::string object = plate + board + kObject;
  const std::string water = plate + board + "[water]\n";
  const std::vector<std::array<std::string, 3>> scenes = {
      {"no such video", "gone.mp4", "[plate]\nvideo = \"gone.mp4\"\n"},
      {"a key that isn't one", "hieght_m", object + "hieght_m = 1\n"},
      {"a size that is no number", "height_m", object + "height_m = nan\n"},
      {"a height of zero", "height_m", object + "height_m = 0\n"},
      {"a line of -3 pixels", "width_px", object + "outline = { width_px = -3 }\n"},
      {"a place a thousand times too far", "position_m", object + "position_m = [1e9, 0, 0]\n"},
      {"a mesh without anything", "empty.obj", plate + board + "[[object]]\nmesh = \"empty.obj\"\n"},
      {"a mesh without triangles", "no faces", plate + board + "[[object]]\nmesh = \"points.obj\"\n"},
      {"a marker of no size", "size_m",
       plate + "[track]\nmarker = { dictionary = \"4X4_50\", id = 1, size_m = 0 }\n" + kObject},
      {"a pose that is no number", "poses.csv", plate + "[track]\nposes = \"poses.csv\"\n" + kObject},
      {"a region file cut short", "torn.rgn", object + "regions = \"torn.rgn\"\n"},
      {"water within no corners", "outline_m", water + "[[water.surface]]\noutline_m = []\n"},
  };
  int number = 0;
  for (const auto& [setting, word, text] : scenes) {
    check_interrupted(settings);
    Case one{"a scene with", setting, "refused in one line"};
    const std::filesystem::path scene = scratch_file(settings, "bad" + std::to_string(number) + ".toml", text);
    const std::filesystem::path prints = settings.scratch / ("bad" + std::to_string(number++) + ".txt");
    const ChildRun run = run_child(render_command(settings, scene, ""), prints);
    one.time_ms = run.wall_ms;
    std::ifstream in(prints);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    const bool named = lines.size() == 1 && lines[0].find(word) != std::string::npos;
    one.outcome = run.status == 2 && named ? "refused" : "WRONG";
    cases.push_back(one);
  }
}

Plot plot_of(const std::vector<Case>& cases, const char* title, const char* x, std::vector<std::string> whats) {
  Plot plot;
  plot.title = title;
  plot.x.title = x;
  plot.y.title = "error of the contour's radius, px";
  plot.front = false;
  for (const std::string& what : whats) {
    Series series{what, {}, true};
    for (const Case& one : cases) {
      if (one.what == what) series.points.push_back({one.extreme, one.error, 0, 0, ""});
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace

Section extreme_section(const Settings& settings) {
  std::vector<Case> cases;
  {
    const auto context = gl::Context::headless();
    draw_all(settings, cases);
  }
  curve_all(settings, cases);
  refuse_all(settings, cases);

  Section section;
  section.repetitions = 1;
  section.intro =
      "What no scene should hold and some will, each with what must come of it: the right result, or a refusal in one "
      "line with exit status 2. A ball straight before the camera must cover the circle that geometry says, with its "
      "line of 4 px, to a quarter of a pixel. docs/extremes.md lists all cases that the tests hold, of which these are "
      "those that have a figure or are quickly run.";
  section.table.columns = {{"case", "Case"},       {"setting", ""},        {"expected", "Expected"},
                           {"outcome", "Outcome"}, {"error", "Error"},     {"allowed", "allowed"},
                           {"unit", ""},           {"time_ms", "Time, ms"}};
  for (const Case& one : cases) {
    const bool measured = !one.unit.empty();
    section.table.rows.push_back({one.what, one.setting, one.expected, one.outcome, measured ? Cell(one.error) : Cell(),
                                  measured ? Cell(one.allowed) : Cell(), one.unit, one.time_ms});
  }
  section.plots = {plot_of(cases, "From a telescope to a keyhole", "field of view, degrees", {"field of view"}),
                   plot_of(cases, "From dust to mountains", "metres, or units of the mesh's file",
                           {"distance", "size of the mesh", "place"})};
  const auto wrong = std::count_if(cases.begin(), cases.end(), [](const Case& one) { return one.outcome == "WRONG"; });
  section.plots[0].says = wrong == 0 ? "All " + std::to_string(cases.size()) + " cases ended as they should."
                                     : std::to_string(wrong) + " of " + std::to_string(cases.size()) +
                                           " cases did not end as they should: see the table.";
  if (wrong == 0) section.plots[1].says = "Neither distance nor size nor place shows in the error.";
  if (settings.recordings.empty()) section.notes.emplace_back("Refusals need recordings/desk, which wasn't found.");
  return section;
}

}  // namespace rinkaku::report

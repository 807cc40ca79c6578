// Fluffy edges in figures: triangles that they add (the paper's table 1), what lists of view candidates hold beyond
// what is needed, how large they are and how long choosing one takes, how coverage changes during a turn. See
// docs/fluffy.md.
//
//   rinkaku-bench-fluffy [--views N] [--turn] [--up x|y|z] [MESH...]
//
// The fluffy part is the tenth of a mesh's triangles that lies highest. Eyes lie from 1.6 to 100 radii of it, evenly in
// direction and in one over the distance. With --turn the whole mesh is fluffy and drawn in steps of half a degree.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "mesh/bounds.h"
#include "mesh/import.h"
#include "mesh/topology.h"
#include "outline/fluffy/band_lists.h"
#include "outline/fluffy/fur_textures.h"
#include "outline/fluffy/nearest_view.h"
#include "outline/fluffy/pass/fluffy_pass.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/passes/toon/toon_pass.h"

namespace {

using namespace rinkaku;
using fluffy::BandSurface;
using Clock = std::chrono::steady_clock;

constexpr double deg = std::numbers::pi / 180;

struct Settings {
  int views = 2000;
  bool turn = false;
  int up = 1;
  std::vector<std::string> meshes;
};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// The highest tenth of the triangles becomes a part called "tuft".
mesh::Mesh with_tuft(mesh::Mesh mesh, int up) {
  std::vector<float> height;
  for (const glm::uvec3& t : mesh.triangles) {
    height.push_back(mesh.positions[t.x][up] + mesh.positions[t.y][up] + mesh.positions[t.z][up]);
  }
  std::vector<std::size_t> order(height.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height[a] < height[b]; });
  const auto tuft = static_cast<std::uint32_t>(order.size() / 10);
  const auto rest = static_cast<std::uint32_t>(order.size()) - tuft;
  // Within each, the triangles stay in the order that the importer gave them.
  std::sort(order.begin(), order.begin() + rest);
  std::sort(order.begin() + rest, order.end());
  std::vector<glm::uvec3> triangles;
  for (const std::size_t t : order) triangles.push_back(mesh.triangles[t]);
  mesh.triangles = std::move(triangles);
  mesh.parts = {{"rest", 0, rest, 0}, {"tuft", rest, tuft, 0}};
  return mesh;
}

std::vector<glm::dvec3> eyes_about(const silhouette::UnitFrame& frame, int count) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> nearness(0.01, 1 / 1.6);  // the faces' middles have a sphere of their own
  std::vector<glm::dvec3> eyes;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    eyes.push_back(frame.to_mesh(way * 1.00001 / nearness(random)));
  }
  return eyes;
}

// The mean number of triangles in the band.
double mean_in_band(const BandSurface& surface, double width_rad, const std::vector<glm::dvec3>& eyes) {
  fluffy::BandCut cut(surface, fluffy::band_sine(width_rad));
  double sum = 0;
  for (const glm::dvec3& eye : eyes) sum += static_cast<double>(cut.find(eye).size());
  return sum / static_cast<double>(eyes.size());
}

// The width at which the faces in the band are the paper's 103 of 867.
double papers_width(const BandSurface& surface, const std::vector<glm::dvec3>& eyes) {
  double low = 0.1 * deg, high = 179 * deg;
  for (int step = 0; step < 20; ++step) {
    const double middle = (low + high) / 2;
    const double share = mean_in_band(surface, middle, eyes) / static_cast<double>(surface.triangles.size());
    (share < 103.0 / 867 ? low : high) = middle;
  }
  return low;
}

void print_table_1(const mesh::Mesh& mesh, const fluffy::Frame& frame, const std::vector<glm::dvec3>& eyes) {
  const auto all = static_cast<double>(mesh.triangles.size());
  const BandSurface faces = fluffy::by_faces(frame), corners = fluffy::by_corners(frame);
  const auto added = [&](double triangles) { return 100 * triangles / all; };
  std::printf("  texture only     %7.0f triangles\n", all);
  std::printf("  fluff, not cut   %7.0f   +%.1f %%\n", all + static_cast<double>(frame.triangles.size()),
              added(static_cast<double>(frame.triangles.size())));
  for (const double width_deg : {45.0, 30.0, 20.0, 10.0}) {
    const double by_faces = mean_in_band(faces, width_deg * deg, eyes);
    const double by_corners = mean_in_band(corners, width_deg * deg, eyes);
    std::printf("  fluff, w = %2.0f    %7.0f   +%.1f %% by faces, as printed; +%.1f %% by corners, as drawn\n",
                width_deg, all + by_faces, added(by_faces), added(by_corners));
  }
  std::printf("  the paper's 11.9 %% of the part is reached at w = %.1f degrees (faces)\n",
              papers_width(faces, eyes) / deg);
}

struct Held {
  double surplus_percent = 0;
  double missed = 0;  // a view
  double choose_us = 0, longest_us = 0;
};

template <typename List>
Held held_against_brute_force(const BandSurface& surface, double sine, const std::vector<glm::dvec3>& eyes, List list) {
  double listed = 0, needed = 0, missed = 0, seconds = 0, longest = 0;
  for (const glm::dvec3& eye : eyes) {
    const auto start = Clock::now();
    const std::span<const std::uint32_t> found = list(eye);
    const double took = seconds_since(start);
    seconds += took;
    longest = std::max(longest, took);
    listed += static_cast<double>(found.size());
    std::size_t next = 0;
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      while (next < found.size() && found[next] < t) ++next;
      if (!fluffy::in_band(surface, t, sine, eye)) continue;
      needed += 1;
      if (next == found.size() || found[next] != t) missed += 1;
    }
  }
  const auto count = static_cast<double>(eyes.size());
  return {100 * (listed / needed - 1), missed / count, 1e6 * seconds / count, 1e6 * longest};
}

void print_lists(const fluffy::Frame& frame, const std::vector<glm::dvec3>& eyes) {
  const double sine = fluffy::band_sine(45 * deg);
  const BandSurface corners = fluffy::by_corners(frame), faces = fluffy::by_faces(frame);
  const auto print = [](const char* name, double kilobytes, double build_s, const Held& held) {
    std::printf("  %-28s %8.0f kB %7.2f s  surplus %5.1f %%  missed %7.3f a view  choose %6.1f us (most %6.1f)\n", name,
                kilobytes, build_s, held.surplus_percent, held.missed, held.choose_us, held.longest_us);
  };
  struct Layout {
    int cells, shells;
  };
  std::vector<std::uint32_t> triangles;
  triangles.reserve(frame.triangles.size());
  for (const Layout& l : {Layout{4, 2}, {8, 4}, {12, 6}, {14, 8}, {16, 8}, {16, 12}, {24, 12}}) {
    const silhouette::RegionLayout layout{.cells = l.cells, .shells = l.shells, .inner_radii = 1.5};
    for (const BandSurface* surface : {&corners, &faces}) {
      const auto start = Clock::now();
      const fluffy::BandLists lists(*surface, sine, layout);
      const double build_s = seconds_since(start);
      const Held held = held_against_brute_force(*surface, sine, eyes, [&](const glm::dvec3& eye) {
        lists.list(*lists.region(eye), triangles);
        return std::span<const std::uint32_t>(triangles);
      });
      char name[64];
      std::snprintf(name, sizeof name, "%5u regions %2dx%-2d %s", lists.region_count(), l.cells, l.shells,
                    surface == &corners ? "corners" : "faces");
      print(name, static_cast<double>(lists.bytes()) / 1000, build_s, held);
    }
  }
  for (const std::uint32_t candidates : {100u, 600u, 5000u}) {
    const auto start = Clock::now();
    const fluffy::NearestView views(faces, sine, candidates);
    const double build_s = seconds_since(start);
    const Held held =
        held_against_brute_force(faces, sine, eyes, [&](const glm::dvec3& eye) { return views.list(eye); });
    char name[64];
    std::snprintf(name, sizeof name, "%5u nearest directions", candidates);
    print(name, static_cast<double>(views.bytes()) / 1000, build_s, held);
  }
  fluffy::BandCut cut(corners, sine);
  print("cut anew for each eye", 0, 0,
        held_against_brute_force(corners, sine, eyes, [&](const glm::dvec3& eye) { return cut.find(eye); }));
}

constexpr int turn_px = 240;

// Most that coverage changes from one half degree to the next over a whole turn, in pixels; and milliseconds a frame.
struct Turn {
  double most_px = 0;
  double mean_ms = 0;
};

Turn turn_of(const mesh::Mesh& mesh, const fluffy::FluffyOptions& options, const fluffy::TransmissionImage& image,
             const fluffy::FrameOptions& frame_options) {
  const mesh::Sphere sphere = mesh::bounding_sphere(mesh.positions);
  const fluffy::Frame frame = fluffy::make_frame(mesh, mesh::topology(mesh), glm::dmat3(1), frame_options, "the mesh");
  std::vector<passes::StyledObject> objects(1);
  objects[0].object = std::make_unique<passes::DrawnObject>(passes::ObjectShape(mesh, glm::dmat4(1)));
  objects[0].passes.push_back(std::make_unique<fluffy::FluffyPass>(*objects[0].object, frame, image, options));
  passes::ToonOptions flat;
  flat.bands = 0;
  objects[0].passes.push_back(std::make_unique<passes::ToonPass>(*objects[0].object, mesh, flat));
  passes::LayerRenderer renderer(std::move(objects), {0, 0, turn_px, turn_px});
  passes::View view;
  view.camera.width_px = view.camera.height_px = turn_px;
  view.camera.fx_px = view.camera.fy_px = 1.6 * turn_px;
  view.camera.cx_px = view.camera.cy_px = (turn_px - 1) / 2.0;
  passes::Layer layer;
  std::vector<int> last, now;
  Turn turn;
  const auto start = Clock::now();
  for (int step = 0; step < 720; ++step) {
    // The camera goes round the object.
    const double angle = step * 0.5 * deg;
    const glm::dvec3 centre = sphere.centre, back(std::sin(angle), 0, std::cos(angle));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
    view.camera_from_world.rotation =
        glm::quat_cast(glm::transpose(glm::dmat3(right, -glm::cross(back, right), -back)));
    view.camera_from_world.translation_m = -(view.camera_from_world.rotation * (centre + back * 4.0 * sphere.radius));
    renderer.draw(view, layer);
    now.assign(turn_px * turn_px, 0);
    for (int y = 0; y < layer.rect.height_px; ++y) {
      for (int x = 0; x < layer.rect.width_px; ++x) {
        now[static_cast<std::size_t>((layer.rect.y_px + y) * turn_px + layer.rect.x_px + x)] =
            layer.rgba[static_cast<std::size_t>(y * layer.rect.width_px + x) * 4 + 3];
      }
    }
    double change = 0;
    for (std::size_t i = 0; i < last.size(); ++i) change += std::abs(now[i] - last[i]);
    turn.most_px = std::max(turn.most_px, change / 255);
    last = now;
  }
  turn.mean_ms = 1000 * seconds_since(start) / 720;
  return turn;
}

void print_turn(const mesh::Mesh& mesh) {
  const auto context = gl::Context::headless();
  fluffy::TransmissionOptions transmission;
  transmission.layers = 16;
  const fluffy::TransmissionImage image =
      fluffy::make_transmission(fluffy::fur_texture(fluffy::FurKind::Fur), transmission, "fur");
  fluffy::FrameOptions frame;
  frame.coarseness = 0.2;
  fluffy::FluffyOptions options;
  const auto print = [&](const char* name, double width_deg, fluffy::CutMethod method, float fade_from) {
    options.cut.method = method;
    options.cut.sine = fluffy::band_sine(width_deg * deg);
    options.fade_from = fade_from;
    const Turn turn = turn_of(mesh, options, image, frame);
    std::printf("  %-44s coverage changes by at most %6.1f px a step; %5.2f ms a frame\n", name, turn.most_px,
                turn.mean_ms);
  };
  print("uncut, without fading", 179, fluffy::CutMethod::None, 0.9999f);
  print("w = 70, fading, uncut", 70, fluffy::CutMethod::None, 0.45f);
  print("w = 70, fading, cut anew", 70, fluffy::CutMethod::Exact, 0.45f);
  print("w = 70, fading, lists of 5,184 regions", 70, fluffy::CutMethod::Regions, 0.45f);
  print("w = 45, fading, cut anew", 45, fluffy::CutMethod::Exact, 0.45f);
  print("w = 45, hard, cut anew", 45, fluffy::CutMethod::Exact, 0.9999f);
  print("w = 45, hard, the paper's directions", 45, fluffy::CutMethod::Nearest, 0.9999f);
}

void run(const std::string& file, const Settings& settings) {
  const mesh::Mesh mesh = with_tuft(mesh::import(file).mesh, settings.up);
  const mesh::Topology topology = mesh::topology(mesh);
  fluffy::FrameOptions options;
  options.selection.names = {"tuft"};
  const fluffy::Frame frame = fluffy::make_frame(mesh, topology, glm::dmat3(1), options, "the mesh");
  std::printf("%s: %zu triangles, %zu of them fluffy\n", file.c_str(), mesh.triangles.size(), frame.triangles.size());
  const mesh::Sphere sphere = mesh::bounding_sphere(frame.points);
  const std::vector<glm::dvec3> eyes = eyes_about({sphere.centre, sphere.radius}, settings.views);
  print_table_1(mesh, frame, eyes);
  print_lists(frame, eyes);
  if (settings.turn) print_turn(mesh);
}

Settings settings_from(int count, char** words) {
  Settings settings;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--turn") {
      settings.turn = true;
    } else if (word == "--views" && i + 1 < count) {
      settings.views = std::max(1, std::atoi(words[++i]));
    } else if (word == "--up" && i + 1 < count) {
      settings.up = std::clamp(words[++i][0] - 'x', 0, 2);
    } else if (word.starts_with("--")) {
      throw input_error(word, "is no option", "see the head of bench/fluffy.cpp");
    } else {
      settings.meshes.push_back(word);
    }
  }
  if (settings.meshes.empty()) {
    for (const char* name : {"spot_textured_5k9.obj", "oded_human_man_14k.obj", "oded_bunny_60k.obj"}) {
      settings.meshes.push_back(std::string(RINKAKU_TEST_DATA) + "/meshes/closed/" + name);
    }
  }
  return settings;
}

}  // namespace

int main(int count, char** words) {
  try {
    const Settings settings = settings_from(count, words);
    for (const std::string& file : settings.meshes) run(file, settings);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_status();
  }
  return 0;
}

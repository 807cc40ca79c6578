// What lines that follow curvature cost, computed once and every frame, and what it costs to bend the mesh as well: the
// tables 4.2 to 4.4 of Matsuo's thesis row by row, at its 1024x768. Prints milliseconds a frame of drawing (everything
// but decoding and compositing) and, as the thesis's are frames per second of another machine, their ratios.
//
// An argument leaves out meshes with fewer vertices. The mesh is a closed cylinder that bends, seen in full. The cases'
// frames are drawn in turn, so that whatever else the machine does hits all of them; times are the processor's, of all
// threads.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "mesh/assemble.h"
#include "mesh/bounds.h"
#include "mesh/contour.h"
#include "mesh/topology.h"
#include "outline/line_width.h"
#include "outline/pass/hull_pass.h"
#include "pipeline/gl/context.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/passes/moving_shape.h"
#include "pipeline/passes/toon/band_borders.h"
#include "pipeline/passes/toon/toon_pass.h"

namespace {

using namespace rinkaku;

struct Rigged {
  mesh::Mesh mesh;
  mesh::Rig rig;
};

Rigged bending_cylinder(int around, int along) {
  mesh::Soup soup;
  for (int row = 0; row <= along; ++row) {
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      soup.positions.emplace_back(0.35 * std::cos(angle), 2.0 * row / along, -0.35 * std::sin(angle));
    }
  }
  const auto at = [&](int row, int k) { return static_cast<std::uint32_t>(row * around + k % around); };
  for (int row = 0; row < along; ++row) {
    for (int k = 0; k < around; ++k) {
      soup.triangles.emplace_back(at(row, k), at(row, k + 1), at(row + 1, k + 1));
      soup.triangles.emplace_back(at(row, k), at(row + 1, k + 1), at(row + 1, k));
    }
  }
  const auto bottom = static_cast<std::uint32_t>(soup.positions.size()), top = bottom + 1;
  soup.positions.insert(soup.positions.end(), {{0, 0, 0}, {0, 2, 0}});
  for (int k = 0; k < around; ++k) {
    soup.triangles.emplace_back(bottom, at(0, k + 1), at(0, k));
    soup.triangles.emplace_back(top, at(along, k), at(along, k + 1));
  }
  mesh::Part part;
  part.triangle_count = static_cast<std::uint32_t>(soup.triangles.size());
  soup.parts = {part};
  soup.materials.emplace_back();

  mesh::Rig& rig = soup.rig;
  rig.nodes = {{"lower", mesh::RigNode::kNoParent, glm::mat4(1)},
               {"upper", 0, glm::translate(glm::mat4(1), glm::vec3(0, 1, 0))}};
  rig.joints = {{0, glm::mat4(1)}, {1, glm::translate(glm::mat4(1), glm::vec3(0, -1, 0))}};
  rig.bind_points = soup.positions;
  rig.first_influence.push_back(0);
  for (const glm::vec3& p : soup.positions) {
    const float upper = glm::smoothstep(0.5f, 1.5f, p.y);
    if (upper < 1) rig.influences.push_back({0, 1 - upper});
    if (upper > 0) rig.influences.push_back({1, upper});
    rig.first_influence.push_back(static_cast<std::uint32_t>(rig.influences.size()));
  }
  mesh::NodeTrack track{1, {{0}, {{0, 1, 0}}}, {}, {{0}, {{1, 1, 1}}}};
  for (int i = 0; i <= 8; ++i) {
    track.rotation.times_s.push_back(static_cast<float>(i) / 4);
    const double angle = glm::radians(45.0) * std::sin(std::numbers::pi * i / 4);
    track.rotation.values.push_back(glm::angleAxis(static_cast<float>(angle), glm::vec3(0, 0, 1)));
  }
  rig.animations = {{"bend", 2, {track}, {}}};
  mesh::Assembled whole = mesh::assemble(std::move(soup), 60);
  return {std::move(whole.mesh), std::move(whole.rig)};
}

// The first three stand still and are drawn whole, as what moves is; the fourth is carried by one node, so that its
// points are new in every frame without being bent; then the bent one, its vertices made on the CPU or by a compute
// shader, which covers more of the picture; one that goes through all of that but whose bones stand as at rest, so that
// its picture is that of the third; and one that stands still and has levels of detail.
enum Case { Uniform, Once, EveryFrame, Carried, Skinned, SkinnedGpu, Straight, Levels, cases };
constexpr std::array<const char*, cases> names{"uniform", "once",       "every frame", "carried",
                                               "skinned", "by shaders", "straight",    "with levels"};

bool moves(Case which) { return which >= Carried && which <= Straight; }

// The same points, all on the lower bone, which sways.
mesh::Rig carried(mesh::Rig rig) {
  const std::size_t count = rig.bind_points.size();
  rig.influences.assign(count, {0, 1.0f});
  for (std::uint32_t p = 0; p <= count; ++p) rig.first_influence[p] = p;
  mesh::NodeTrack& track = rig.animations[0].tracks[0];
  track.node = 0;
  track.position.values = {glm::vec3(0)};
  for (glm::quat& turn : track.rotation.values) turn = glm::slerp(glm::quat(1, 0, 0, 0), turn, 0.2f);
  return rig;
}

// The same bones, whose keys all say the same.
mesh::Rig straight(mesh::Rig rig) {
  for (glm::quat& turn : rig.animations[0].tracks[0].rotation.values) turn = glm::quat(1, 0, 0, 0);
  return rig;
}

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

class Drawn {
 public:
  Drawn(const Rigged& rigged, Case which) {
    const mesh::Topology topology = mesh::topology(rigged.mesh);
    points_ = topology.points;
    outline::WidthOptions widths;
    followed_ = std::make_shared<outline::CurvatureWidths>(topology, widths);
    const std::span<const float> factors = followed_->at(points_);
    passes::ToonOptions toon;
    const glm::dmat4 place =
        glm::translate(glm::dmat4(1), glm::dvec3(0, -1, 4.4)) * glm::rotate(glm::dmat4(1), 0.2, glm::dvec3(1, 0, 0));
    const std::vector<std::uint8_t> uneven = which == Levels
                                                 ? passes::band_borders(rigged.mesh, place, toon)
                                                 : std::vector<std::uint8_t>(rigged.mesh.triangles.size(), 1);
    passes::ObjectShape shape(rigged.mesh, place, uneven);
    if (which == Skinned || which == SkinnedGpu) shape.animate(rigged.mesh, rigged.rig, {});
    if (which == Straight) shape.animate(rigged.mesh, straight(rigged.rig), {});
    if (which == Carried) shape.animate(rigged.mesh, carried(rigged.rig), {});
    every_frame_ = which == EveryFrame;
    find_contour(rigged.mesh, topology, place);
    passes::StyledObject styled;
    styled.object = std::make_unique<passes::DrawnObject>(
        std::move(shape), which == SkinnedGpu ? passes::Skinning::Gpu : passes::Skinning::Cpu);
    styled.passes.push_back(std::make_unique<passes::ToonPass>(*styled.object, rigged.mesh, toon));
    outline::HullOptions line;
    line.style.taper_px = 15;
    if (which != Uniform) line.style.factors = factors;
    if (moves(which)) {
      line.style.follow = [to = followed_](const passes::LineStyle::Moved& now) {
        to->at(now.points, now.wanted, now.factors);
      };
      line.style.most_factor = 1 + widths.exaggeration;
    }
    styled.passes.push_back(std::make_unique<outline::HullPass>(*styled.object, line));
    std::vector<passes::StyledObject> objects;
    objects.push_back(std::move(styled));
    renderer_ = std::make_unique<passes::LayerRenderer>(std::move(objects), passes::PixelRect{0, 0, 1024, 768});
  }

  double frame_ms(int number) {
    passes::View view;
    view.camera.width_px = 1024, view.camera.height_px = 768;
    view.camera.fx_px = view.camera.fy_px = 1250;
    view.camera.cx_px = 511.5, view.camera.cy_px = 383.5;
    view.camera_from_world.translation_m.x = 0.05 * std::sin(number * 0.1);
    view.time_s = number / 30.0;
    const double start_ms = processor_ms();
    if (every_frame_) followed_->at(points_, contour_points_, factors_);
    renderer_->draw(view, layer_);
    return processor_ms() - start_ms;
  }

 private:
  // The points that lines run through, as a moving object asks for them each frame.
  void find_contour(const mesh::Mesh& mesh, const mesh::Topology& topology, const glm::dmat4& place) {
    mesh::ContourFinder finder(mesh, topology);
    const mesh::Contour& contour = finder.find(glm::dvec3(glm::inverse(place) * glm::dvec4(0, 0, 0, 1)));
    for (const std::uint32_t edge : contour.edges) {
      contour_points_.push_back(topology.edges[edge].a);
      contour_points_.push_back(topology.edges[edge].b);
    }
    factors_.resize(topology.points.size());
  }
  std::vector<glm::vec3> points_;
  std::shared_ptr<outline::CurvatureWidths> followed_;
  bool every_frame_ = false;
  std::vector<std::uint32_t> contour_points_;
  std::vector<float> factors_;
  std::unique_ptr<passes::LayerRenderer> renderer_;
  passes::Layer layer_;
};

// What a frame's stages take one by one: bending points, making vertices of them, finding the contour, curvature
// and widths along it, and, to compare, those of all points.
void measure_stages(const Rigged& rigged, int frames) {
  const mesh::Topology topology = mesh::topology(rigged.mesh);
  passes::MovingShape moving(rigged.mesh, topology, rigged.rig, {}, glm::dmat4(1));
  std::vector<passes::MovedVertex> vertices(rigged.mesh.positions.size());
  mesh::ContourFinder finder(rigged.mesh, topology);
  outline::CurvatureWidths widths(topology, {});
  std::vector<float> factors(topology.points.size());
  std::vector<std::uint32_t> wanted;
  std::array<std::vector<double>, 5> times;
  for (int f = 0; f < frames; ++f) {
    std::array<double, 6> at{processor_ms()};
    moving.move_to(f / 30.0);
    const std::span<const glm::vec3> points = moving.points();
    at[1] = processor_ms();
    moving.write(vertices);
    at[2] = processor_ms();
    finder.move(topology.faces, points, moving.skin().box());
    const mesh::Contour& contour = finder.find(glm::dvec3(0, 1, 4.4));
    at[3] = processor_ms();
    wanted.clear();
    for (const std::uint32_t edge : contour.edges) {
      wanted.insert(wanted.end(), {topology.edges[edge].a, topology.edges[edge].b});
    }
    widths.at(points, wanted, factors);
    at[4] = processor_ms();
    widths.at(points);
    at[5] = processor_ms();
    for (std::size_t s = 0; s < times.size(); ++s) times[s].push_back(at[s + 1] - at[s]);
  }
  for (std::vector<double>& stage : times) {
    std::nth_element(stage.begin(), stage.begin() + frames / 2, stage.end());
    std::printf(" %9.3f", stage[static_cast<std::size_t>(frames / 2)]);
  }
  std::printf("\n");
}

void measure(int around, int along, int frames) {
  const Rigged rigged = bending_cylinder(around, along);
  std::array<std::unique_ptr<Drawn>, cases> all;
  for (int c = 0; c < cases; ++c)
    all[static_cast<std::size_t>(c)] = std::make_unique<Drawn>(rigged, static_cast<Case>(c));
  std::array<std::vector<double>, cases> times;
  constexpr int warm_up = 5;
  for (int f = 0; f < frames + warm_up; ++f) {
    for (std::size_t c = 0; c < cases; ++c) {
      const double ms = all[c]->frame_ms(f);
      if (f >= warm_up) times[c].push_back(ms);
    }
  }
  std::array<double, cases> median{};
  for (std::size_t c = 0; c < cases; ++c) {
    std::nth_element(times[c].begin(), times[c].begin() + frames / 2, times[c].end());
    median[c] = times[c][static_cast<std::size_t>(frames / 2)];
  }
  std::printf("%9u", rigged.mesh.point_count);
  for (const double ms : median) std::printf(" %13.2f", ms);
  std::printf(" %12.3f %12.3f %15.3f %13.3f %14.3f %13.3f", median[Uniform] / median[Once],
              median[Once] / median[EveryFrame], median[Carried] / median[Skinned],
              median[EveryFrame] / median[Skinned], median[EveryFrame] / median[Straight],
              median[EveryFrame] / median[SkinnedGpu]);
  measure_stages(rigged, frames);
}

}  // namespace

int main(int count, char** arguments) {
  const double least_points = count > 1 ? std::atof(arguments[1]) : 0;
  const auto context = gl::Context::headless();
  std::printf("milliseconds a frame; then what the stages of a skinned one take by themselves\n%9s", "vertices");
  for (const char* name : names) std::printf(" %13s", name);
  std::printf(" %12s %12s %15s %13s %14s %13s", "once/uniform", "every/once", "skinned/carried", "skinned/every",
              "straight/every", "shaders/every");
  std::printf(" %9s %9s %9s %9s %9s\n", "skinning", "vertices", "contour", "widths", "all widths");
  // Close to the thesis's vertex counts: 485, 2419, 4250, 10149, 15859, 22226, 28741, 63576.
  const int sizes[][3] = {{21, 22, 400},   {49, 48, 300},  {65, 64, 200},  {101, 100, 100},
                          {126, 125, 100}, {149, 148, 60}, {170, 168, 60}, {252, 252, 40}};
  for (const auto& [around, along, frames] : sizes) {
    if (around * along >= least_points) measure(around, along, frames);
  }
}

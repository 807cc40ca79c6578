// Whether lines are closed: draws meshes from many sides, once with a line of even width and once with one that follows
// curvature, and walks their contours in the pictures. Prints for each mesh how much of the contour was looked at and
// how many gaps were found, and each view with gaps and the pixels of the first few; a gap is a place without ink as
// far out as the line, 3 pixels wide, reaches; "thin" are places whose line ends before that. Exit status 1 if there
// was one.
//
//   rinkaku-bench-closed-lines [--view I] [--save FOLDER] [VIEWS [MESH_OR_FOLDER...]]
//
// 500 views of the closed meshes of the test data if nothing is said. --view: only that one of them; --save: the
// pictures that have gaps, or of that view, as PPM, over black.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "mesh/bounds.h"
#include "mesh/import.h"
#include "mesh/topology.h"
#include "outline/verify/line_walk.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"
#include "pipeline/objects/lone_mesh.h"

namespace {

using namespace rinkaku;
namespace fs = std::filesystem;

constexpr int kSide_px = 512;
constexpr float kLine_px = 3;

// Spread evenly over all directions (a golden spiral), with another up each, near and far in turn.
passes::View view_of(int i, int views) {
  const double height = 1 - (2 * i + 1.0) / views, around = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
  const double across = std::sqrt(1 - height * height);
  const glm::dvec3 from(across * std::cos(around), height, across * std::sin(around));
  const double distances[] = {1.7, 2.5, 4, 8}, distance = distances[i % 4];
  passes::View view;
  view.camera.width_px = view.camera.height_px = kSide_px;
  // A ball of radius 1 fills most of the picture.
  view.camera.fx_px = view.camera.fy_px = 0.43 * kSide_px * std::sqrt(distance * distance - 1);
  view.camera.cx_px = view.camera.cy_px = (kSide_px - 1) / 2.0;
  const glm::dvec3 ahead = -from, up(std::cos(2.0 * i), 0.3, std::sin(2.0 * i));
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, up)), down = glm::cross(ahead, right);
  view.camera_from_world = {glm::quat_cast(glm::transpose(glm::dmat3(right, down, ahead))), {0, 0, distance}};
  return view;
}

struct Wish {
  int views = 500;
  int only = -1;
  fs::path save;
};

void save(const passes::Layer& layer, const fs::path& path) {
  std::string bytes = "P6 " + std::to_string(kSide_px) + " " + std::to_string(kSide_px) + " 255\n";
  const std::size_t head = bytes.size();
  bytes.resize(head + std::size_t{3} * kSide_px * kSide_px, '\0');
  for (int y = 0; y < layer.rect.height_px; ++y) {
    for (int x = 0; x < layer.rect.width_px; ++x) {
      const std::size_t from = static_cast<std::size_t>(y * layer.rect.width_px + x) * 4;
      const std::size_t to = static_cast<std::size_t>((y + layer.rect.y_px) * kSide_px + x + layer.rect.x_px) * 3;
      std::copy_n(layer.rgba.begin() + static_cast<std::ptrdiff_t>(from), 3,
                  bytes.begin() + static_cast<std::ptrdiff_t>(head + to));
    }
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

std::uint64_t walk(const fs::path& file, const Wish& wish) {
  const mesh::Mesh mesh = [&] {
    mesh::Mesh read = mesh::import(file).mesh;
    // White all over, so that ink can be told from it.
    read.colours.clear(), read.textures.clear();
    for (mesh::Material& material : read.materials) material = {.name = material.name};
    return read;
  }();
  const mesh::Topology topology = mesh::topology(mesh);
  const mesh::Sphere ball = mesh::bounding_sphere(mesh.positions);
  const glm::dmat4 place =
      glm::translate(glm::scale(glm::dmat4(1), glm::dvec3(1 / ball.radius)), -glm::dvec3(ball.centre));
  outline::LineWalker walker(topology, kLine_px - 0.5);
  std::uint64_t all_gaps = 0;
  for (const pipeline::LineMethod method : {pipeline::LineMethod::Uniform, pipeline::LineMethod::Curvature}) {
    const char* name = method == pipeline::LineMethod::Uniform ? "uniform" : "curvature";
    pipeline::OutlineScene line;
    line.method = method;
    line.width_px = kLine_px;
    line.taper_px = 0;
    line.colour = {1, 0, 0};
    passes::ToonOptions unlit;
    unlit.bands = 0;
    const auto renderer = pipeline::lone_mesh(mesh, place, unlit, line, {0, 0, kSide_px, kSide_px});
    outline::WalkedLine sum;
    int open_views = 0;
    std::string where;
    for (int i = 0; i < wish.views; ++i) {
      if (wish.only >= 0 && i != wish.only) continue;
      const passes::View view = view_of(i, wish.views);
      passes::Layer layer;
      renderer->draw(view, layer);
      const outline::WalkedLine walked = walker.walk(view, place, layer);
      sum.border += walked.border, sum.border_gaps += walked.border_gaps;
      sum.places += walked.places, sum.place_gaps += walked.place_gaps;
      sum.place_thin += walked.place_thin;
      if (!wish.save.empty() && (walked.gaps() > 0 || wish.only >= 0)) {
        save(layer, wish.save / (file.stem().string() + "_" + name + "_" + std::to_string(i) + ".ppm"));
      }
      if (walked.gaps() == 0) continue;
      ++open_views;
      where += " view " + std::to_string(i) + ":";
      for (const glm::ivec2& p : walked.where) where += " " + std::to_string(p.x) + "," + std::to_string(p.y);
    }
    std::printf("| %s | %s | %llu | %llu | %llu | %llu | %llu | %d |%s\n", file.stem().string().c_str(), name,
                static_cast<unsigned long long>(sum.border), static_cast<unsigned long long>(sum.border_gaps),
                static_cast<unsigned long long>(sum.places), static_cast<unsigned long long>(sum.place_gaps),
                static_cast<unsigned long long>(sum.place_thin), open_views, where.c_str());
    std::fflush(stdout);
    all_gaps += sum.gaps();
  }
  return all_gaps;
}

std::vector<fs::path> meshes_of(const std::vector<fs::path>& named) {
  std::vector<fs::path> files;
  for (const fs::path& path : named) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(path)) {
      const std::string ending = entry.path().extension();
      if (ending == ".obj" || ending == ".off" || ending == ".ply" || ending == ".glb") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  Wish wish;
  while (argc > 2 && std::strncmp(argv[1], "--", 2) == 0) {
    if (std::strcmp(argv[1], "--view") == 0)
      wish.only = std::max(std::atoi(argv[2]), 0);
    else if (std::strcmp(argv[1], "--save") == 0)
      wish.save = argv[2];
    else
      argc = 0;
    argc -= 2, argv += 2;
  }
  if (argc > 1) wish.views = std::max(std::atoi(argv[1]), 1);
  if (argc < 1 || wish.only >= wish.views || (!wish.save.empty() && !fs::is_directory(wish.save))) {
    std::fprintf(stderr,
                 "usage: rinkaku-bench-closed-lines [--view I, below VIEWS] [--save FOLDER that exists] "
                 "[VIEWS [MESH_OR_FOLDER...]]\n");
    return 2;
  }
  std::vector<fs::path> named(argv + std::min(argc, 2), argv + argc);
  if (named.empty()) named.emplace_back(fs::path(RINKAKU_TEST_DATA) / "meshes/closed");
  std::uint64_t gaps = 0;
  try {
    const auto context = gl::Context::headless();
    std::printf("%d views each, %dx%d\n\n", wish.views, kSide_px, kSide_px);
    std::printf("| mesh | line | border pixels | gaps | places seen | gaps | thin | views with gaps |\n");
    std::printf("| --- | --- | --- | --- | --- | --- | --- | --- |\n");
    for (const fs::path& file : meshes_of(named)) gaps += walk(file, wish);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_status();
  } catch (const fs::filesystem_error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return gaps == 0 ? 0 : 1;
}

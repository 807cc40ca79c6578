// Region mattes beside the whole mesh's and beside other ways to draw fewer triangles: how long a matte takes, how many
// pixels differ, what baking costs. See docs/silhouette.md.
//
//   rinkaku-bench-mattes [--eyes N] [--size WxH] [--fov-deg D] [--no-peers] [MESH...]
//
// Meshes of fewer than 99,000 triangles are cut finer by Loop's rule until they have as many; others are taken as they
// are. Eyes lie 1.5 to 6 radii off, evenly in one over the distance and in direction, and look at the middle.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include "mesh/assemble.h"
#include "mesh/import.h"
#include "mesh/topology.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"
#include "silhouette/bake.h"
#include "silhouette/pass/matte_pass.h"
#include "silhouette/peers/cluster_cones.h"
#include "silhouette/peers/reduction.h"
#include "silhouette/region_file.h"
#include "silhouette/region_lists.h"
#include "silhouette/verify/matte_comparison.h"

namespace {

namespace fs = std::filesystem;
namespace sil = rinkaku::silhouette;

struct Settings {
  int eyes = 40;
  int width_px = 1280, height_px = 720;
  double fov_deg = 50;
  bool peers = true;
  std::vector<std::string> meshes;
};

constexpr std::size_t enough_triangles = 99'000;

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<>;

rinkaku::mesh::Mesh cut_finer(const rinkaku::mesh::Mesh& mesh) {
  const rinkaku::mesh::Topology topology = rinkaku::mesh::topology(mesh);
  HalfEdgeMesh fine;
  for (const glm::vec3& p : topology.points) fine.add_vertex({p.x, p.y, p.z});
  const auto vertex = [](std::uint32_t point) { return OpenMesh::VertexHandle(static_cast<int>(point)); };
  for (const glm::uvec3& f : topology.faces) fine.add_face(vertex(f.x), vertex(f.y), vertex(f.z));
  OpenMesh::Subdivider::Uniform::LoopT<HalfEdgeMesh> loop;
  loop.attach(fine);
  int times = 0;
  for (std::size_t triangles = fine.n_faces(); triangles < enough_triangles; triangles *= 4) ++times;
  loop(static_cast<std::size_t>(times));
  loop.detach();
  rinkaku::mesh::Soup soup;
  for (const auto v : fine.vertices())
    soup.positions.emplace_back(fine.point(v)[0], fine.point(v)[1], fine.point(v)[2]);
  for (const auto f : fine.faces()) {
    glm::uvec3 triangle(0);
    int corner = 0;
    for (const auto v : fine.fv_range(f)) triangle[corner++] = static_cast<std::uint32_t>(v.idx());
    soup.triangles.push_back(triangle);
  }
  rinkaku::mesh::Part part;
  part.triangle_count = static_cast<std::uint32_t>(soup.triangles.size());
  soup.parts = {part};
  soup.materials.emplace_back();
  return rinkaku::mesh::assemble(std::move(soup), 60).mesh;
}

sil::Surface surface_of(const std::string& file) {
  rinkaku::mesh::Mesh mesh = rinkaku::mesh::import(file).mesh;
  if (mesh.triangles.size() < enough_triangles) mesh = cut_finer(mesh);
  return sil::make_surface(mesh, rinkaku::mesh::topology(mesh));
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// One way to draw, over all eyes of a mesh.
struct Method {
  explicit Method(const char* method_name) : name(method_name) {}

  const char* name;
  std::vector<double> wall_ms, cpu_ms, wall_ratio, cpu_ratio, triangles, mismatch_px;

  void add(const sil::DrawTime& time, const sil::DrawTime& full, std::size_t count, std::int64_t mismatch) {
    wall_ms.push_back(time.wall_ms);
    cpu_ms.push_back(time.cpu_ms);
    wall_ratio.push_back(full.wall_ms / time.wall_ms);
    cpu_ratio.push_back(full.cpu_ms / time.cpu_ms);
    triangles.push_back(static_cast<double>(count));
    mismatch_px.push_back(static_cast<double>(mismatch));
  }
  void print(std::size_t full) const {
    const auto sum = [](const std::vector<double>& values) {
      double total = 0;
      for (const double v : values) total += v;
      return total;
    };
    const auto eyes = static_cast<double>(triangles.size());
    std::printf(
        "  %-8s %5.1f %% of the triangles  %6.2f ms  %5.2f times as fast (CPU time %5.2f)  %7.1f px differ (most "
        "%.0f)\n",
        name, 100 * sum(triangles) / eyes / static_cast<double>(full), median(wall_ms), median(wall_ratio),
        median(cpu_ratio), sum(mismatch_px) / eyes, *std::max_element(mismatch_px.begin(), mismatch_px.end()));
    std::fflush(stdout);
  }
};

class Eyes {
 public:
  explicit Eyes(const Settings& settings) : settings_(settings) {}
  glm::dvec3 next() {
    const double z = 2 * unit() - 1, angle = 2 * M_PI * unit(), r = std::sqrt(1 - z * z);
    return glm::dvec3(r * std::cos(angle), r * std::sin(angle), z) / (1 / 6.0 + (1 / 1.5 - 1 / 6.0) * unit());
  }
  sil::CheckView view(const glm::dvec3& eye, const sil::UnitFrame& frame) const {
    sil::CheckView view;
    view.view.camera = sil::camera_of({settings_.width_px, settings_.height_px}, settings_.fov_deg * M_PI / 180);
    view.view.camera_from_world = sil::looking_at(frame.to_mesh(eye), frame.centre);
    return view;
  }

 private:
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  const Settings& settings_;
  std::mt19937_64 engine_{1};
};

// The median of a few drawings, the whole mesh's and the other's in turn.
sil::MatteDifference timed(sil::MatteComparison& comparison, const sil::CheckView& view,
                           std::span<const std::uint32_t> list) {
  std::vector<double> times[4];
  sil::MatteDifference result;
  for (int round = 0; round < 5; ++round) {
    result = comparison.compare(view, list);
    const double values[] = {result.full.wall_ms, result.full.cpu_ms, result.other.wall_ms, result.other.cpu_ms};
    for (int i = 0; i < 4; ++i) times[i].push_back(values[i]);
  }
  result.full = {median(times[0]), median(times[1])};
  result.other = {median(times[2]), median(times[3])};
  return result;
}

// What the drawing thread pays when the eye comes to another region whose list was decoded ahead: finding it and
// sending it to the GPU. The largest of all changes on a way around the object.
void print_change(const sil::Surface& surface, const std::shared_ptr<const sil::RegionFile>& file) {
  sil::RegionLists lists(file);
  sil::MattePass pass(surface.points);
  std::vector<double> found_ms, sent_ms;
  std::uint64_t serial = 0;
  constexpr int frames = 600;
  for (int frame = 0; frame < frames; ++frame) {
    const double turn = 2 * M_PI * frame / frames;
    const glm::dvec3 eye = surface.frame.to_mesh(3.0 * glm::dvec3(std::cos(turn), 0.3, std::sin(turn)));
    sil::RegionList list;
    const double ms = sil::draw_time([&] { list = lists.at(eye); }).wall_ms;
    if (!list.whole && list.serial != serial) {
      serial = list.serial;
      found_ms.push_back(ms);
      sent_ms.push_back(sil::draw_time([&] { pass.set_triangles(list.indices); }).wall_ms);
    }
    lists.wait();  // a frame's time is longer than decoding takes
  }
  const auto most = [](const std::vector<double>& v) {
    return v.empty() ? 0.0 : *std::max_element(v.begin(), v.end());
  };
  std::printf(
      "  a change of region costs at most %.3f ms to find and %.3f ms to send (medians %.3f, %.3f; %zu changes)\n",
      most(found_ms), most(sent_ms), median(found_ms), median(sent_ms), found_ms.size());
}

struct Ratios {
  std::vector<double> wall, cpu;
};

void compare(const sil::Surface& surface, const sil::RegionLayout& layout, const Settings& settings, Ratios& ratios) {
  sil::BakeOptions options;
  options.space = layout;
  const auto baked = sil::bake(surface, options);
  const sil::BakeReport& report = baked->report;
  std::printf(
      " %u regions: baked in %.1f s, %.1f MB, %.2f bytes a triangle; %.1f %% on average, %.1f %% at most, %.2f %% by "
      "the certificate\n",
      report.regions, report.seconds, static_cast<double>(report.bytes) / 1e6,
      static_cast<double>(report.bytes) / static_cast<double>(report.triangles_stored), report.mean_ratio * 100,
      report.max_ratio * 100, report.hidden_gain * 100);
  const auto shared = std::make_shared<const sil::RegionFile>(sil::RegionFile::from_memory(baked->file, "baked.rgn"));
  print_change(surface, shared);
  const sil::RegionFile& file = *shared;
  const sil::RegionFinder finder(options.space);
  sil::MatteComparison comparison(surface);
  const std::vector<std::uint32_t>& full = comparison.full_indices();
  Method region("region"), meshopt("meshopt"), quadric("quadric"), cones("cones");
  std::vector<std::uint32_t> list, by_meshopt, by_quadric;
  if (settings.peers) {
    const auto target = static_cast<std::size_t>(report.mean_ratio * static_cast<double>(full.size() / 3));
    by_meshopt = sil::reduce_with_meshopt(surface.points, full, target);
    by_quadric = sil::reduce_with_quadrics(surface.points, full, target);
  }
  sil::ClusterCones clusters(surface.points, full);
  Eyes eyes(settings);
  for (int i = 0; i < settings.eyes; ++i) {
    const glm::dvec3 eye = eyes.next();
    const auto index = finder.find(eye);
    if (!index) continue;
    const sil::CheckView view = eyes.view(eye, surface.frame);
    const auto add = [&](Method& method, std::span<const std::uint32_t> indices) {
      const sil::MatteDifference d = timed(comparison, view, indices);
      method.add(d.other, d.full, indices.size() / 3, d.mismatch_px);
    };
    file.decode(*index, sil::Product::Matte, list);
    add(region, list);
    if (!settings.peers) continue;
    add(meshopt, by_meshopt);
    add(quadric, by_quadric);
    add(cones, clusters.facing(surface.frame.to_mesh(eye)));
  }
  region.print(full.size() / 3);
  if (settings.peers) {
    for (const Method* method : {&meshopt, &quadric, &cones}) method->print(full.size() / 3);
  }
  ratios.wall.push_back(median(region.wall_ratio));
  ratios.cpu.push_back(median(region.cpu_ratio));
}

Settings parse(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const auto value = [&]() -> const char* {
      if (i + 1 < argc) return argv[++i];
      std::fprintf(stderr, "%s needs a value\n", argv[i]);
      std::exit(2);
    };
    if (std::strcmp(argv[i], "--eyes") == 0) {
      settings.eyes = std::atoi(value());
    } else if (std::strcmp(argv[i], "--size") == 0) {
      if (std::sscanf(value(), "%dx%d", &settings.width_px, &settings.height_px) != 2) std::exit(2);
    } else if (std::strcmp(argv[i], "--fov-deg") == 0) {
      settings.fov_deg = std::atof(value());
    } else if (std::strcmp(argv[i], "--no-peers") == 0) {
      settings.peers = false;
    } else {
      settings.meshes.emplace_back(argv[i]);
    }
  }
  if (settings.meshes.empty()) {
    for (const char* mesh :
         {"closed/oded_koala_100k.obj", "closed/oded_bunny_60k.obj", "closed/oded_armadillo_29k.obj",
          "closed/oded_penguin_27k.obj", "closed/oded_spot_23k.obj", "closed/oded_human_man_14k.obj",
          "closed/pmp_fandisk_13k.off", "open/mlab_laurana_50k.ply", "open/cgal_mannequin_26k.off"}) {
      settings.meshes.push_back((fs::path(RINKAKU_TEST_DATA) / "meshes" / mesh).string());
    }
  }
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  const Settings settings = parse(argc, argv);
  try {
    const auto context = rinkaku::gl::Context::headless();
    Ratios coarse, fine;
    for (const std::string& mesh : settings.meshes) {
      const sil::Surface surface = surface_of(mesh);
      std::printf("%s: %zu triangles\n", fs::path(mesh).filename().c_str(), sil::full_list(surface).size() / 3);
      compare(surface, {8, 1, 1.5}, settings, coarse);
      compare(surface, {11, 2, 1.5}, settings, fine);
    }
    std::printf(
        "median over the meshes, whole mesh / region: 384 regions %.2f (CPU time %.2f), 1452 regions %.2f (%.2f)\n",
        median(coarse.wall), median(coarse.cpu), median(fine.wall), median(fine.cpu));
  } catch (const rinkaku::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_status();
  }
  return 0;
}

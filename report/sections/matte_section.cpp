#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "mesh/topology.h"
#include "pipeline/gl/context.h"
#include "report/sections/sections.h"
#include "report/sections/shapes.h"
#include "silhouette/bake.h"
#include "silhouette/peers/cluster_cones.h"
#include "silhouette/peers/reduction.h"
#include "silhouette/region_file.h"
#include "silhouette/verify/matte_comparison.h"

namespace rinkaku::report {
namespace {

namespace sil = silhouette;

constexpr int kWidth_px = 1280, kHeight_px = 720;
constexpr double kFov_deg = 50;

// Eyes 1.5 to 6 radii off, evenly in one over the distance and in direction.
class Eyes {
 public:
  explicit Eyes(std::uint64_t seed) : engine_(seed) {}
  glm::dvec3 next() {
    const double z = 2 * unit() - 1, angle = 2 * std::numbers::pi * unit(), r = std::sqrt(1 - z * z);
    return glm::dvec3(r * std::cos(angle), r * std::sin(angle), z) / (1 / 6.0 + (1 / 1.5 - 1 / 6.0) * unit());
  }

 private:
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::mt19937_64 engine_;
};

cv::Mat contour_of(std::vector<std::uint8_t>& matte) {
  const cv::Mat inside = cv::Mat(kHeight_px, kWidth_px, CV_8U, matte.data()) > 127;
  cv::Mat eroded;
  cv::erode(inside, eroded, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}), {-1, -1}, 1, cv::BORDER_REPLICATE);
  return inside & ~eroded;
}

// How far the farthest point of either contour lies from the other contour (Hausdorff distance), in pixels.
double contour_distance_px(std::vector<std::uint8_t>& a, std::vector<std::uint8_t>& b) {
  const std::array<cv::Mat, 2> contours{contour_of(a), contour_of(b)};
  double most = 0;
  for (const int i : {0, 1}) {
    if (cv::countNonZero(contours[0]) == 0 || cv::countNonZero(contours[1]) == 0) return 0;
    cv::Mat away;
    cv::distanceTransform(~contours[i], away, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    double farthest = 0;
    cv::minMaxLoc(away, nullptr, &farthest, nullptr, nullptr, contours[1 - i]);
    most = std::max(most, farthest);
  }
  return most;
}

// One way to draw, over all eyes.
struct Way {
  std::string name, series;
  double set_up_s = 0, stored_mb = 0;
  std::vector<double> wall_ms{}, cpu_ms{}, triangles{}, differing_px{}, distance_px{};
};

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

class Measurement {
 public:
  Measurement(const Settings& settings, const sil::Surface& surface, int rounds)
      : settings_(settings), surface_(surface), rounds_(rounds), comparison_(surface) {}

  const std::vector<std::uint32_t>& full() const { return comparison_.full_indices(); }

  // Draws the whole mesh and the list in turn, and puts their medians down.
  void add(const glm::dvec3& eye, std::span<const std::uint32_t> list, Way& way, Way& whole) {
    check_interrupted(settings_);
    sil::CheckView view;
    view.view.camera = sil::camera_of({kWidth_px, kHeight_px}, kFov_deg * std::numbers::pi / 180);
    view.view.camera_from_world = sil::looking_at(surface_.frame.to_mesh(eye), surface_.frame.centre);
    std::array<std::vector<double>, 4> times;
    sil::MatteDifference d;
    for (int round = 0; round < rounds_; ++round) {
      d = comparison_.compare(view, list);
      times[0].push_back(d.other.wall_ms), times[1].push_back(d.other.cpu_ms);
      times[2].push_back(d.full.wall_ms), times[3].push_back(d.full.cpu_ms);
    }
    way.wall_ms.push_back(spread(times[0]).median), way.cpu_ms.push_back(spread(times[1]).median);
    whole.wall_ms.push_back(spread(times[2]).median), whole.cpu_ms.push_back(spread(times[3]).median);
    way.triangles.push_back(static_cast<double>(list.size() / 3));
    way.differing_px.push_back(static_cast<double>(d.mismatch_px));
    std::vector<std::uint8_t> one = comparison_.full(), other = comparison_.other();
    way.distance_px.push_back(d.mismatch_px == 0 ? 0 : contour_distance_px(one, other));
  }

 private:
  const Settings& settings_;
  const sil::Surface& surface_;
  int rounds_;
  sil::MatteComparison comparison_;
};

struct BakedRegions {
  Way way;
  sil::RegionFile file;
  sil::RegionFinder finder;
  sil::BakeReport report;
};

std::vector<BakedRegions> bake_all(const Settings& settings, const sil::Surface& surface) {
  std::vector<sil::RegionLayout> layouts = {{1, 1, 1.5}, {4, 1, 1.5}};
  if (!settings.quick) layouts = {{1, 1, 1.5}, {2, 1, 1.5}, {4, 1, 1.5}, {8, 1, 1.5}, {11, 1, 1.5}, {11, 2, 1.5}};
  std::vector<BakedRegions> baked;
  for (const sil::RegionLayout& layout : layouts) {
    sil::BakeOptions options;
    options.space = layout;
    auto one = sil::bake(surface, options, {}, settings.interrupted);
    if (!one) throw Interrupted{};
    Way way{std::to_string(one->report.regions) + " regions", "regions"};
    way.set_up_s = one->report.seconds, way.stored_mb = static_cast<double>(one->report.bytes) / 1e6;
    baked.push_back({std::move(way), sil::RegionFile::from_memory(std::move(one->file), "baked.rgn"),
                     sil::RegionFinder(options.space), one->report});
  }
  return baked;
}

struct Reduced {
  Way way;
  std::vector<std::uint32_t> list;
};

std::vector<Reduced> reduce_all(const sil::Surface& surface, const std::vector<std::uint32_t>& full,
                                double like_regions) {
  std::vector<Reduced> all;
  for (const auto& [name, reduce] :
       {std::pair{"meshopt", &sil::reduce_with_meshopt}, std::pair{"quadrics", &sil::reduce_with_quadrics}}) {
    // As many as the finest regions have on average, and far fewer.
    for (const double part : {like_regions, 0.25, 0.1}) {
      if (part < like_regions && like_regions - part < 0.05) continue;
      const auto target = static_cast<std::size_t>(part * static_cast<double>(full.size() / 3));
      char label[64];
      std::snprintf(label, sizeof label, "%s %.0f %%", name, part * 100);
      Reduced one{{label, name}, {}};
      Stopwatch watch;
      one.way.set_up_s = watch.run([&] { one.list = reduce(surface.points, full, target); }) / 1e3;
      one.way.stored_mb = static_cast<double>(one.list.size() * 4) / 1e6;
      all.push_back(std::move(one));
    }
  }
  return all;
}

void add_row(Table& table, const Way& way, double whole_ms) {
  const Spread time = spread(way.wall_ms);
  const auto most = [](const std::vector<double>& v) {
    return v.empty() ? 0.0 : *std::max_element(v.begin(), v.end());
  };
  table.rows.push_back({way.name, mean(way.triangles), mean(way.differing_px), most(way.differing_px),
                        mean(way.distance_px), most(way.distance_px), time.median, time.low, time.high,
                        spread(way.cpu_ms).median, time.median > 0 ? whole_ms / time.median : 0, way.set_up_s,
                        way.stored_mb});
}

std::vector<Plot> plots_of(const std::vector<const Way*>& ways) {
  std::vector<Plot> plots(2);
  plots[0].title = "Pixels that differ from the whole mesh's matte";
  plots[0].y.title = "differing pixels, mean over the eyes";
  plots[1].title = "How far the contour strays";
  plots[1].y.title = "largest distance of the contours, px, mean over the eyes";
  for (std::size_t i = 0; i < 2; ++i) {
    Plot& plot = plots[i];
    plot.x.title = "draw time, ms (median over the eyes)";
    std::map<std::string, std::size_t> known;
    for (const Way* way : ways) {
      const auto [at, added] = known.try_emplace(way->series, plot.series.size());
      if (added) plot.series.push_back({way->series, {}, false});
      plot.series[at->second].points.push_back(
          timed_point(spread(way->wall_ms), mean(i == 0 ? way->differing_px : way->distance_px), way->name));
    }
  }
  plots[0].says =
      "Regions, cones and the whole mesh give the same matte to the last pixel; general reductions don't. On "
      "the front: " +
      front_names(plots[0]) + ". Bars are quartiles over the eyes.";
  plots[1].says = "The Hausdorff distance between the two contours: how far an outline would jump. On the front: " +
                  front_names(plots[1]) + ".";
  return plots;
}

}  // namespace

Section matte_section(const Settings& settings) {
  Section section;
  const int cuts = settings.quick ? 36 : 112, eye_count = settings.quick ? 8 : 40;
  section.repetitions = settings.quick ? 3 : 5;
  const auto context = gl::Context::headless();
  const mesh::Mesh ball = bumpy_ball(cuts);
  const sil::Surface surface = sil::make_surface(ball, mesh::topology(ball));
  section.intro = "A ball with bumps and a dent, of " + std::to_string(ball.triangles.size()) +
                  " triangles, drawn as a matte of 1280x720 from " + std::to_string(eye_count) +
                  " eyes 1.5 to 6 radii off (seed " + std::to_string(settings.seed) +
                  "). The truth is the whole mesh's matte. Percentages are of its triangles.";
  section.table.columns = {{"method", "Method"},
                           {"triangles", "Triangles drawn"},
                           {"differing_px", "Differing px, mean"},
                           {"differing_px_most", "most"},
                           {"contour_distance_px", "Contour, px, mean"},
                           {"contour_distance_px_most", "most"},
                           {"time_ms", "Draw, ms"},
                           {"time_low_ms", "low"},
                           {"time_high_ms", "high"},
                           {"cpu_ms", "CPU, ms"},
                           {"times_as_fast", "Times as fast"},
                           {"set_up_s", "Bake or reduce, s"},
                           {"stored_mb", "Stored, MB"}};
  auto baked = bake_all(settings, surface);
  Measurement measurement(settings, surface, section.repetitions);
  Way whole{"whole mesh", "whole mesh"}, cones{"cones", "cones"};
  whole.stored_mb = static_cast<double>(measurement.full().size() * 4) / 1e6;
  auto reduced = reduce_all(surface, measurement.full(), baked.back().report.mean_ratio);
  Stopwatch watch;
  watch.run([&] { sil::ClusterCones(surface.points, measurement.full()); });
  cones.set_up_s = watch.timing().wall_ms.median / 1e3, cones.stored_mb = whole.stored_mb;
  sil::ClusterCones clusters(surface.points, measurement.full());
  Eyes eyes(settings.seed);
  std::vector<std::uint32_t> list;
  for (int i = 0; i < eye_count; ++i) {
    const glm::dvec3 eye = eyes.next();
    for (BakedRegions& regions : baked) {
      const auto region = regions.finder.find(eye);
      if (!region) continue;
      regions.file.decode(*region, sil::Product::Matte, list);
      measurement.add(eye, list, regions.way, whole);
    }
    for (Reduced& one : reduced) measurement.add(eye, one.list, one.way, whole);
    measurement.add(eye, clusters.facing(surface.frame.to_mesh(eye)), cones, whole);
    whole.triangles.push_back(static_cast<double>(measurement.full().size() / 3));
    whole.differing_px.push_back(0), whole.distance_px.push_back(0);
  }
  std::vector<const Way*> ways = {&whole};
  for (const BakedRegions& regions : baked) ways.push_back(&regions.way);
  for (const Reduced& one : reduced) ways.push_back(&one.way);
  ways.push_back(&cones);
  const double whole_ms = spread(whole.wall_ms).median;
  for (const Way* way : ways) add_row(section.table, *way, whole_ms);
  section.plots = plots_of(ways);
  section.notes.emplace_back(
      "Drawing times have neither the choice of triangles nor their decoding in them; both happen once as the eye "
      "comes "
      "to another region, for cones every frame.");
  return section;
}

}  // namespace rinkaku::report

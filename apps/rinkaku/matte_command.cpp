#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "apps/rinkaku/call_values.h"
#include "apps/rinkaku/json_output.h"
#include "apps/rinkaku/matte_commands.h"
#include "apps/rinkaku/picture_file.h"
#include "apps/rinkaku/surface_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/frame/frame.h"
#include "pipeline/gl/context.h"
#include "silhouette/peers/cluster_cones.h"
#include "silhouette/peers/reduction.h"
#include "silhouette/region_file.h"
#include "silhouette/verify/matte_comparison.h"

namespace rinkaku::app {
namespace {

struct Chosen {
  std::vector<std::uint32_t> indices;
  std::optional<std::uint32_t> region;  ///< that the eye is in
};

Chosen region_list(const MatteCall& call, const silhouette::Surface& surface, const glm::dvec3& eye) {
  if (call.regions.empty()) {
    throw input_error("--regions", "method " + call.method + " needs a region file",
                      "make one with rinkaku bake, and give it with --regions");
  }
  const silhouette::RegionFile file = silhouette::RegionFile::open(call.regions);
  file.must_belong_to(surface);
  Chosen chosen;
  chosen.region = silhouette::RegionFinder(file.space()).find(surface.frame.to_unit(eye));
  if (chosen.region) file.decode(*chosen.region, silhouette::Product::Matte, chosen.indices);
  return chosen;
}

Chosen choose(const MatteCall& call, const silhouette::Surface& surface, const glm::dvec3& eye, double focal_px) {
  Chosen chosen;
  const std::vector<std::uint32_t> full = silhouette::full_list(surface);
  if (call.method == "full") {
    chosen.indices = full;
  } else if (call.method == "cones") {
    silhouette::ClusterCones cones(surface.points, full);
    const auto facing = cones.facing(eye);
    chosen.indices.assign(facing.begin(), facing.end());
  } else if (call.method == "region") {
    chosen = region_list(call, surface, eye);
    const double radius_px =
        silhouette::radius_px(focal_px, surface.frame.radius, glm::distance(eye, surface.frame.centre));
    // As at run time.
    if (!chosen.region || radius_px < silhouette::least_radius_px(surface)) chosen.indices = full;
  } else {
    auto triangles = static_cast<std::size_t>(call.triangles);
    if (triangles == 0) {
      chosen = region_list(call, surface, eye);
      if (!chosen.region) throw input_error("--eye", "lies in no region of the file", "give --triangles N");
      triangles = chosen.indices.size() / 3;
    }
    const auto reduce = call.method == "meshopt" ? silhouette::reduce_with_meshopt : silhouette::reduce_with_quadrics;
    chosen.indices = reduce(surface.points, full, triangles);
  }
  return chosen;
}

silhouette::CheckView view_of(const MatteCall& call, const glm::dvec3& eye) {
  const glm::dvec3 target = parse_point("--target", call.target);
  if (!(glm::length(target - eye) > 0)) throw input_error("--target", "is the eye itself", "look at another point");
  silhouette::CheckView view;
  view.view.camera = silhouette::camera_of(parse_size("--size", call.size), call.fov_deg * M_PI / 180);
  view.view.camera_from_world = silhouette::looking_at(eye, target);
  return view;
}

Frame grey_frame(int width_px, int height_px, const std::vector<std::uint8_t>& samples) {
  PictureFormat format;
  format.width_px = width_px, format.height_px = height_px;
  format.pixels = grey8();
  format.colour.range = ColourTags::Range::Full;
  Frame frame = FramePool().allocate(format);
  const auto width = static_cast<std::size_t>(width_px);
  for (int y = 0; y < height_px; ++y) {
    std::memcpy(frame.planes[0].data + y * frame.planes[0].stride_bytes,
                samples.data() + static_cast<std::size_t>(y) * width, width);
  }
  return frame;
}

}  // namespace

int matte(const MatteCall& call) {
  check_picture_file(call.output, call.mesh, call.force);
  if (!call.regions.empty()) refuse_own_input(call.output, call.regions);
  const glm::dvec3 eye = parse_point("--eye", call.eye);
  const silhouette::CheckView view = view_of(call, eye);
  const silhouette::Surface surface = read_surface(call.mesh);
  const Chosen chosen = choose(call, surface, eye, view.view.camera.fx_px);

  const auto context = gl::Context::headless();
  silhouette::MatteComparison drawing(surface);
  std::vector<std::uint8_t> pixels;
  drawing.draw(view, chosen.indices, pixels);  // the first drawing compiles
  const double draw_ms = drawing.draw(view, chosen.indices, pixels).wall_ms;
  const CameraModel& camera = view.view.camera;
  write_picture_file(grey_frame(camera.width_px, camera.height_px, pixels), call.output, call.force);

  const std::size_t triangles = chosen.indices.size() / 3;
  const auto covered = pixels.size() - static_cast<std::size_t>(std::count(pixels.begin(), pixels.end(), 0));
  if (call.json) {
    print_json({{"output", call.output},
                {"method", call.method},
                {"width", camera.width_px},
                {"height", camera.height_px},
                {"triangles", triangles},
                {"triangles_full", drawing.full_indices().size() / 3},
                {"region", chosen.region ? nlohmann::json(*chosen.region) : nlohmann::json()},
                {"covered_px", covered},
                {"draw_ms", draw_ms}});
  } else {
    std::printf("%s: %zu of %zu triangles cover %zu pixels, drawn in %.2f ms\n", call.output.c_str(), triangles,
                drawing.full_indices().size() / 3, covered, draw_ms);
  }
  return 0;
}

}  // namespace rinkaku::app

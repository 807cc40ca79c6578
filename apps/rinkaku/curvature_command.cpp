#include <algorithm>
#include <cstdio>
#include <optional>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/json_output.h"
#include "apps/rinkaku/picture_file.h"
#include "mesh/import.h"
#include "mesh/topology.h"
#include "outline/curvature.h"
#include "outline/curvature_colours.h"
#include "pipeline/files/pending_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/portrait.h"

namespace rinkaku::app {
namespace {

outline::CurvatureMethod method_named(const std::string& name) {
  using enum outline::CurvatureMethod;
  return name == "meyer" ? Meyer : name == "quadric" ? Quadric : name == "auto" ? Auto : Icnc;
}

std::string csv(const mesh::Topology& topology, const outline::Curvature& curvature) {
  std::string text = "vertex,x,y,z,mean,gauss,k1,k2\n";
  char row[192];
  for (std::size_t p = 0; p < topology.points.size(); ++p) {
    const glm::vec3& at = topology.points[p];
    // Nine digits give a float back exactly.
    std::snprintf(row, sizeof row, "%zu,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", p, at.x, at.y, at.z, curvature.mean[p],
                  curvature.gauss[p], curvature.largest[p], curvature.smallest[p]);
    text += row;
  }
  return text;
}

}  // namespace

int curvature(const CurvatureCall& call) {
  if (call.output.empty() && call.picture.empty()) {
    throw input_error("", "nothing is to be written", "give -o FILE.csv, --picture FILE.png, or both");
  }
  std::optional<files::PendingFile> table;
  if (!call.output.empty()) {
    table.emplace(call.output, call.force);
    refuse_own_input(call.output, call.mesh);
  }
  if (!call.picture.empty()) {
    if (table) files::PendingFile(call.picture, call.force).must_not_be(call.output);
    check_picture_file(call.picture, call.mesh, call.force);
  }

  const mesh::Imported imported = mesh::import(call.mesh);
  const mesh::Topology topology = mesh::topology(imported.mesh);
  const outline::Curvature found = outline::curvature(topology, method_named(call.method));
  const double scale = outline::k95(found);
  if (!call.picture.empty()) {
    pipeline::PortraitOptions options;
    options.up = imported.summary.up;
    write_picture_file(pipeline::portrait(outline::painted_with_curvature(imported.mesh, found, scale), options),
                       call.picture, call.force);
  }
  if (table) table->write(csv(topology, found));

  const auto [least, most] = std::minmax_element(found.mean.begin(), found.mean.end());
  if (call.json) {
    print_json({{"method", call.method},
                {"vertices", topology.points.size()},
                {"k95", scale},
                {"mean_min", *least},
                {"mean_max", *most},
                {"output", call.output},
                {"picture", call.picture}});
  } else {
    std::printf("%zu vertices (at one position counted once), mean curvature %.6g to %.6g, K95 %.6g, by %s\n",
                topology.points.size(), *least, *most, scale, call.method.c_str());
  }
  return 0;
}

}  // namespace rinkaku::app

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/json_output.h"
#include "apps/rinkaku/picture_file.h"
#include "mesh/import.h"
#include "pipeline/frame/error.h"
#include "pipeline/objects/animated.h"
#include "pipeline/sheet.h"

namespace rinkaku::app {
namespace {

// Those of all cells whose labels are named, in the order of the names.
std::vector<pipeline::SheetCell> chosen(const std::vector<pipeline::SheetCell>& all, const std::string& names) {
  if (names.empty()) return all;
  std::vector<pipeline::SheetCell> cells;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& cell) { return cell.label == name; });
    if (found == all.end()) {
      std::string known;
      for (const pipeline::SheetCell& cell : all) known += (known.empty() ? "" : ", ") + cell.label;
      throw input_error("--styles", "there is no style '" + name + "'", "choose of: " + known);
    }
    cells.push_back(*found);
  }
  return cells;
}

}  // namespace

int sheet(const SheetCall& call) {
  check_picture_file(call.output, call.mesh, call.force);
  const std::vector<pipeline::SheetCell> cells = chosen(pipeline::all_styles(call.width_px), call.styles);
  const bool moves = !call.clip.empty() || call.time_s.has_value();
  const mesh::Imported imported = mesh::import(call.mesh, {.rig = moves});
  pipeline::SheetOptions options;
  if (moves && imported.rig.animations.empty()) {
    throw input_error("--clip", call.mesh + " has no animation", "leave --clip and --time-s out");
  }
  if (moves) {
    const pipeline::AnimationScene animation{.clip_name = call.clip, .where = "--clip"};
    options.portrait.motion = {&imported.rig, pipeline::playback(animation, imported.rig, call.mesh)};
    options.portrait.time_s = call.time_s.value_or(0);
  }
  options.portrait.width_px = options.portrait.height_px = call.cell_px;
  options.portrait.up = imported.summary.up;
  options.portrait.turn_deg = call.turn_deg;
  options.portrait.raise_deg = call.raise_deg;
  options.columns = call.columns;
  write_picture_file(pipeline::sheet(imported.mesh, cells, options), call.output, call.force);
  if (call.json) {
    nlohmann::json labels = nlohmann::json::array();
    for (const pipeline::SheetCell& cell : cells) labels.push_back(cell.label);
    print_json({{"output", call.output}, {"styles", labels}});
  } else {
    std::printf("%s: %zu styles\n", call.output.c_str(), cells.size());
  }
  return 0;
}

}  // namespace rinkaku::app

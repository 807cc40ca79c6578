#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/json_output.h"
#include "pipeline/pipeline.h"

namespace rinkaku::app {

int explain(const ExplainCall& call) {
  pipeline::RenderOptions options;
  if (call.layers) options.layers_folder = "layers";
  const pipeline::Prepared prepared = pipeline::prepare(pipeline::read_scene(call.scene), options);
  if (call.json) {
    nlohmann::json stages = nlohmann::json::array();
    for (const pipeline::Stage& stage : prepared.plan.stages) {
      stages.push_back({{"name", stage.name}, {"runs", stage.runs}, {"why", stage.why}, {"inputs", stage.inputs}});
    }
    print_json({{"stages", stages}});
  } else if (call.dot) {
    std::fputs(pipeline::to_dot(prepared.plan).c_str(), stdout);
  } else {
    for (const pipeline::Stage& stage : prepared.plan.stages) {
      std::printf("%-5s %-13s %s\n", stage.runs ? "runs" : "-", stage.name.c_str(), stage.why.c_str());
    }
  }
  return 0;
}

}  // namespace rinkaku::app

#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/json_output.h"
#include "apps/rinkaku/picture_file.h"
#include "pipeline/files/pending_file.h"
#include "pipeline/objects/drawn_lines_file.h"
#include "pipeline/trace_lines.h"

namespace rinkaku::app {

int trace(const TraceCall& call) {
  files::PendingFile output(call.output, call.force);
  refuse_own_input(call.output, call.lines);
  refuse_own_input(call.output, call.scene);
  const auto lines_px = pipeline::read_lines_px(call.lines);
  const pipeline::Prepared prepared = pipeline::prepare(pipeline::read_scene(call.scene), {});
  const pipeline::TracedLines traced = pipeline::trace_lines(prepared, lines_px, {call.frame, call.object});
  output.write(pipeline::drawn_lines_text(traced.lines, traced.triangles));
  std::size_t places = 0;
  for (const outline::DrawnLine& line : traced.lines) places += line.size();
  if (call.json) {
    print_json({{"output", call.output}, {"lines", traced.lines.size()}, {"places", places}});
  } else {
    std::printf("%s: %zu lines of %zu places\n", call.output.c_str(), traced.lines.size(), places);
  }
  return 0;
}

}  // namespace rinkaku::app

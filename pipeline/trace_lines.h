#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "outline/strokes/drawn_lines.h"
#include "pipeline/pipeline.h"

namespace rinkaku::pipeline {

struct TraceOptions {
  std::int64_t frame = 0;  ///< the frame that was drawn on, counted from 0
  std::string object{};    ///< the name of the object that was drawn on; empty if the scene has one object
};

struct TracedLines {
  std::vector<outline::DrawnLine> lines;
  std::size_t triangles = 0;  ///< of the object's mesh
};

/// Lays lines that were drawn on a frame, in its pixels, onto the object that is seen there: tracks the camera up to
/// that frame as render() does, and follows the lines' rays through the lens to the mesh. Throws Error (Input) if there
/// is no such frame or object, the frame has no pose, or no line meets the object.
TracedLines trace_lines(const Prepared& prepared, const std::vector<std::vector<glm::dvec2>>& lines_px,
                        const TraceOptions& options);

}  // namespace rinkaku::pipeline

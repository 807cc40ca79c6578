#pragma once

#include <functional>

namespace rinkaku::silhouette {

struct DrawTime {
  double wall_ms = 0;
  double cpu_ms = 0;  ///< of all threads of this process: software OpenGL draws on several
};

/// Runs `draw` on an idle pipeline until it is finished, by the CPU's clocks (software OpenGL's timer queries lie).
DrawTime draw_time(const std::function<void()>& draw);

}  // namespace rinkaku::silhouette

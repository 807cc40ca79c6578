#pragma once

#include <filesystem>
#include <string>

#include "report/section.h"

namespace rinkaku::report {

/// The program that draws plots.
inline constexpr const char* kPlotter = "gnuplot";

/// Draws a plot as an SVG element that can stand in an HTML page: text and axes are of the colour var(--ink), and
/// names within begin with `id`. The points that no other beats are ringed and joined by a line of steps.
///
/// Writes into the folder `scratch`. Throws Error (Runtime) if gnuplot fails.
std::string svg_plot(const Plot& plot, const std::string& id, const std::filesystem::path& scratch);

}  // namespace rinkaku::report

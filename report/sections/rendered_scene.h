#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/child.h"
#include "report/sections/sections.h"

namespace rinkaku::report {

/// What sections that run whole programs on scenes share.

/// Runs a program to its end. Throws Error (Runtime), naming it and with the last line it printed, if it fails; and
/// Interrupted.
ChildRun run_whole(const Settings& settings, const std::vector<std::string>& command);

/// `rinkaku render` of a scene file with MPEG-4 at 6 Mbit/s, of the frames given as A:B (empty: all).
std::vector<std::string> render_command(const Settings& settings, const std::filesystem::path& scene,
                                        const std::string& frames);

/// Writes a file of text into the scratch folder, and says where it is.
std::filesystem::path scratch_file(const Settings& settings, const std::string& name, const std::string& text);

/// A camera file of a pinhole that sees 53 degrees across.
std::string camera_yml(int width_px, int height_px);

/// The bumpy ball as an OBJ file, of 8 n^2 triangles.
std::string ball_obj(int n);

}  // namespace rinkaku::report

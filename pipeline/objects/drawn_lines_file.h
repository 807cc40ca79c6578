#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "outline/strokes/drawn_lines.h"

namespace rinkaku::pipeline {

/// Lines drawn on a picture: a text file, one line a row, as the `points` of an SVG polyline: "x,y x,y x,y", in pixels
/// of the picture. Empty rows and those that begin with # don't count. Throws Error (Input) naming row and value.
std::vector<std::vector<glm::dvec2>> read_lines_px(const std::filesystem::path& file);

/// Lines laid onto a mesh, as CSV: after a row "triangles,N" for the mesh's number of triangles, columns line,
/// triangle, b, c (see outline::SurfacePlace).
std::string drawn_lines_text(const std::vector<outline::DrawnLine>& lines, std::size_t triangles);

/// Throws Error (Input) for a file that isn't such lines, or of a mesh with another number of triangles.
std::vector<outline::DrawnLine> read_drawn_lines(const std::filesystem::path& file, std::size_t triangles);

}  // namespace rinkaku::pipeline

#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "pipeline/portrait.h"

namespace rinkaku::pipeline {

/// A picture of a sheet and what is written below it.
struct SheetCell {
  std::string label;
  std::optional<OutlineScene> outline;
};

struct SheetOptions {
  PortraitOptions portrait{};  ///< size of one cell; its outline isn't read
  int columns = 4;
};

/// Every way of drawing lines, as a scene that gives nothing but `method` has them; the first cell is without a line.
std::vector<SheetCell> all_styles(double width_px);

/// Draws one mesh once for each cell, side by side, with labels: a contact sheet. An opaque frame of 8-bit RGBA, sRGB.
/// Throws what portrait() throws.
Frame sheet(const mesh::Mesh& mesh, const std::vector<SheetCell>& cells, const SheetOptions& options = {});

}  // namespace rinkaku::pipeline

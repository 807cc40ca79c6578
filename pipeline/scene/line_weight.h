#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/scene/line_style.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// weight of outline of [[object]]: what its width is multiplied by here and there, whatever the method gives.
struct LineWeightScene {
  /// On the side away from the light a line is wider by up to so many widths.
  double shade = 0;
  std::optional<int> paint;  ///< the vertex colours' channel whose value, 0 to 1, is the width's part: 0 red to 3 alpha
  std::filesystem::path
      map;  ///< an image laid on by texture coordinates, whose brightness is the width's part; or empty
  struct OfMaterial {
    std::string name;
    double factor = 1;
  };
  std::vector<OfMaterial> materials;
  /// What the mesh's file says, for each of its materials, or empty; `materials` counts before it.
  std::vector<double> of_file;
  bool file_maps = false;  ///< whether the materials' own width textures count
  bool any() const { return shade > 0 || paint || !map.empty() || !materials.empty() || !of_file.empty() || file_maps; }
};

toml::Schema line_weight_schema();

/// Reads `weight` of the table `outline`; nothing weighs if there is none. Throws Error (Input), also for methods that
/// do not push the contour.
LineWeightScene read_line_weight(const toml::Table& outline, LineMethod method);

}  // namespace rinkaku::pipeline

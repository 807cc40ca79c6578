#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "outline/fluffy/fur_kind.h"
#include "outline/fluffy/growth.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// fluffy of [[object]]: fluff about its contour.
struct FluffyScene {
  std::string where;  ///< "file:line:column: fluffy", for messages that come up later
  std::optional<fluffy::FurKind> made_texture = fluffy::FurKind::Fur;
  std::filesystem::path texture;  ///< a picture's, where made_texture is empty
  double threshold = 0.5;
  enum class Keep { Above, Below } keep = Keep::Above;
  fluffy::FrameOptions frame;
  bool mesh_coordinates_if_any =
      false;              ///< the mesh's texture coordinates instead of frame.coordinates, if it has them
  double angle_deg = 70;  ///< w, the band's full width
  int layers = 16;
  enum class Paint { Body, Texture, Own } paint = Paint::Body;
  std::array<double, 3> colour{1, 1, 1};                 ///< sRGB; for Paint::Own
  double hang = 0.25;                                    ///< how far tips hang down, in lengths of the fluff
  enum class Line { Body, Rim, None } line = Line::Rim;  ///< where the object's outline runs, if it has one
  enum class Cut { Exact, Regions, Nearest, None } cut = Cut::Exact;
};

toml::Schema fluffy_schema();

/// Empty if there is none, or for `fluffy = false`. `outlined`: the object has an outline. Throws Error (Input).
std::optional<FluffyScene> read_fluffy(const toml::Table& object, bool outlined);

}  // namespace rinkaku::pipeline

#pragma once

#include "recordings/generator/room.h"

namespace rinkaku::recordings {

/// The grid of markers: DICT_4X4_50, ids from 0, row by row from the print's top left. The world's origin is the bottom
/// left corner of the bottom left marker, x right, y up the print, z out of it.
struct BoardLayout {
  int columns = 4;
  int rows = 3;
  float size_m = 0.052f;
  float gap_m = 0.013f;
  float width_m() const { return static_cast<float>(columns) * (size_m + gap_m) - gap_m; }
  float height_m() const { return static_cast<float>(rows) * (size_m + gap_m) - gap_m; }
};

/// The desk with everything on it, its light baked for a camera that passes the places `eyes`.
Room make_desk_room(const BoardLayout& board, const std::vector<glm::vec3>& eyes);

}  // namespace rinkaku::recordings

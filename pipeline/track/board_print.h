#pragma once

#include <filesystem>

#include "pipeline/track/board.h"

namespace rinkaku::track {

struct PrintOptions {
  /// The sheet in metres, upright or across; 0 takes the smallest of A4, A3, A2, A1 and A0 that the board fits on.
  double page_width_m = 0;
  double page_height_m = 0;
};

/// What was put on the sheet, in metres.
struct PrintedPage {
  double width_m = 0;
  double height_m = 0;
};

/// Writes a board as a PDF of vector shapes at true scale, with a line that tells what it is and a bar to check the
/// scale by. The board lies in the middle, with a white border for the detector around it. Replaces the file if there
/// is one, and only once it is whole. Throws Error (Input) naming the board if it is not flat or does not fit the
/// sheet; Error (Runtime) if the file can't be written.
PrintedPage print_board(const Board& board, const std::filesystem::path& file, const PrintOptions& options = {});

}  // namespace rinkaku::track

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <string_view>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/commands.h"
#include "apps/rinkaku/json_output.h"
#include "pipeline/files/pending_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/track/board.h"
#include "pipeline/track/board_print.h"

namespace rinkaku::app {
namespace {

// "A4" or "WIDTHxHEIGHT" in millimetres.
track::PrintOptions page_size(const std::string& page) {
  if (page.empty()) return {};
  struct Named {
    std::string_view name;
    track::PrintOptions size;
  };
  static constexpr Named named[] = {{"A4", {0.210, 0.297}}, {"A3", {0.297, 0.420}}, {"A2", {0.420, 0.594}},
                                    {"A1", {0.594, 0.841}}, {"A0", {0.841, 1.189}}, {"letter", {0.2159, 0.2794}}};
  for (const Named& n : named) {
    if (n.name == page) return n.size;
  }
  double width_mm = 0, height_mm = 0;
  const char* const end = page.data() + page.size();
  const auto [cross, first] = std::from_chars(page.data(), end, width_mm);
  if (first == std::errc() && cross != end && *cross == 'x') {
    const auto [last, second] = std::from_chars(cross + 1, end, height_mm);
    constexpr double most_mm = 10000;
    if (second == std::errc() && last == end && width_mm > 0 && height_mm > 0 && width_mm <= most_mm &&
        height_mm <= most_mm) {
      return {width_mm / 1000, height_mm / 1000};
    }
  }
  throw input_error("--page", "'" + page + "' is no page size",
                    "write A4, A3, A2, A1, A0, letter or e.g. 200x150 (mm)");
}

}  // namespace

int board(const BoardCall& call) {
  if (!call.output.ends_with(".pdf") && !call.output.ends_with(".PDF")) {
    throw input_error(call.output, "a board is written as PDF", "give a name that ends in .pdf");
  }
  const track::PrintOptions options = page_size(call.page);
  const files::PendingFile checked(call.output, call.force);
  const track::Board read = track::read_board(call.board);
  const track::PrintedPage page = track::print_board(read, call.output, options);
  if (call.json) {
    print_json({{"output", call.output},
                {"page_width_m", page.width_m},
                {"page_height_m", page.height_m},
                {"markers", read.markers.size()}});
  } else {
    std::printf("%s: a page of %.0f x %.0f mm; print it at 100 %% and measure the bar\n", call.output.c_str(),
                page.width_m * 1000, page.height_m * 1000);
  }
  return 0;
}

}  // namespace rinkaku::app

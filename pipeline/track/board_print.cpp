#include "pipeline/track/board_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <cairo-pdf.h>
#include <glm/geometric.hpp>
#include <opencv2/aruco.hpp>

#include "pipeline/files/pending_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/track/opencv_marker.h"

namespace rinkaku::track {
namespace {

constexpr double points_per_m = 72 / 0.0254;
constexpr double margin_m = 0.008;  // what printers can't reach
constexpr double legend_m = 0.014;  // scale bar and one line of text, below the board
constexpr double text_m = 0.003;

struct Extent {
  glm::dvec2 low{0}, high{0};
};

Extent extent(const Board& board) {
  const glm::dvec3 centre = board.centre_m();
  glm::dvec2 half(0);
  const auto grow = [&](const glm::dvec3& p) { half = glm::max(half, glm::abs(glm::dvec2(p) - glm::dvec2(centre))); };
  for (const BoardMarker& marker : board.markers) {
    for (const glm::dvec3& corner : marker.corners_m) grow(corner);
  }
  if (board.square_m > 0) grow({0, 0, 0});
  return {glm::dvec2(centre) - half, glm::dvec2(centre) + half};
}

// The detector needs white around a marker: a cell's width at least.
double quiet_zone_m(const Board& board) {
  double widest = board.square_m / 4;
  for (const BoardMarker& marker : board.markers) {
    widest = std::max(widest, glm::distance(marker.corners_m[0], marker.corners_m[1]) / 6);
  }
  return widest;
}

PrintedPage choose_page(const Board& board, const glm::dvec2& size, const PrintOptions& options) {
  const glm::dvec2 need(size.x + 2 * margin_m, size.y + 2 * margin_m + legend_m);
  std::vector<glm::dvec2> sheets = {{0.210, 0.297}, {0.297, 0.420}, {0.420, 0.594}, {0.594, 0.841}, {0.841, 1.189}};
  if (options.page_width_m > 0) sheets = {{options.page_width_m, options.page_height_m}};
  for (const glm::dvec2& sheet : sheets) {
    if (need.x <= sheet.x && need.y <= sheet.y) return {sheet.x, sheet.y};
    if (need.x <= sheet.y && need.y <= sheet.x) return {sheet.y, sheet.x};
  }
  char what[160];
  std::snprintf(what, sizeof what,
                "the board takes %.0f x %.0f mm with its margins, more than the %.0f x %.0f mm sheet", need.x * 1000,
                need.y * 1000, sheets.back().x * 1000, sheets.back().y * 1000);
  throw input_error(board.name, what, "make it smaller or give a larger page");
}

// One path of everything black; filled at once, so that no seams show between cells.
class BlackPath {
 public:
  explicit BlackPath(cairo_t* page) : page_(page) {}

  void add(const std::array<glm::dvec3, 4>& corners) const {
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == 0) {
        cairo_move_to(page_, corners[i].x, corners[i].y);
      } else {
        cairo_line_to(page_, corners[i].x, corners[i].y);
      }
    }
    cairo_close_path(page_);
  }

  void add_marker(const BoardMarker& marker, const cv::Ptr<cv::aruco::Dictionary>& dictionary) const {
    const int bits = dictionary->markerSize, cells = bits + 2;
    const cv::Mat white =
        cv::aruco::Dictionary::getBitsFromByteList(dictionary->bytesList.rowRange(marker.id, marker.id + 1), bits);
    const auto& c = marker.corners_m;
    const auto at = [&](int column, int row) {
      const double u = static_cast<double>(column) / cells, v = static_cast<double>(row) / cells;
      return glm::mix(glm::mix(c[0], c[1], u), glm::mix(c[3], c[2], u), v);
    };
    for (int row = 0; row < cells; ++row) {
      for (int column = 0; column < cells; ++column) {
        const bool border = row == 0 || column == 0 || row == cells - 1 || column == cells - 1;
        if (!border && white.at<std::uint8_t>(row - 1, column - 1)) continue;
        // A run of black cells is one rectangle.
        int end = column + 1;
        while (end < cells &&
               (row == 0 || row == cells - 1 || end == cells - 1 || !white.at<std::uint8_t>(row - 1, end - 1))) {
          ++end;
        }
        add({at(column, row), at(end, row), at(end, row + 1), at(column, row + 1)});
        column = end - 1;
      }
    }
  }

 private:
  cairo_t* page_;
};

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g mm", metres * 1000);
  return text;
}

std::string legend(const Board& board) {
  std::string text;
  const auto count = std::to_string(board.columns) + " x " + std::to_string(board.rows);
  const auto side = [&] {
    return millimetres(glm::distance(board.markers[0].corners_m[0], board.markers[0].corners_m[1]));
  };
  const auto ids = [&] {
    const int first = board.markers.front().id, last = board.markers.back().id;
    return first == last ? "id " + std::to_string(first)
                         : "ids " + std::to_string(first) + " to " + std::to_string(last);
  };
  switch (board.layout) {
    case Board::Layout::Single:
      text = board.dictionary + "  " + ids() + "  marker " + side();
      break;
    case Board::Layout::Grid:
      text = board.dictionary + "  grid " + count + "  " + ids() + "  marker " + side();
      if (board.markers.size() > 1) {
        const auto& a = board.markers[0].corners_m;
        const auto& b = board.markers[1].corners_m;
        const double gap = board.columns > 1 ? b[0].x - a[1].x : a[2].y - b[0].y;
        text += "  gap " + millimetres(gap);
      }
      break;
    case Board::Layout::Charuco:
      text = board.dictionary + "  charuco " + count + " squares of " + millimetres(board.square_m) + "  " + ids() +
             "  marker " + side();
      break;
    case Board::Layout::Chessboard:
      text = "chessboard " + count + " squares of " + millimetres(board.square_m);
      break;
    case Board::Layout::Markers:
      text = board.dictionary + "  " + std::to_string(board.markers.size()) + " markers";
      break;
  }
  return text + "  print at 100 %";
}

void draw_legend(cairo_t* page, const Board& board, const PrintedPage& sheet) {
  // In metres from the sheet's top left, y down. A bar of 100 mm, or what round length the sheet allows.
  double bar_m = 0.1;
  while (bar_m > sheet.width_m - 2 * margin_m) bar_m /= 2;
  const double left = margin_m, bar_y = sheet.height_m - margin_m - 2 * text_m, tick = text_m / 2;
  cairo_set_line_width(page, 0.0002);
  for (int i = 0; i <= 10; ++i) {
    const double x = left + bar_m * i / 10;
    cairo_move_to(page, x, bar_y - (i % 5 == 0 ? 2 : 1) * tick);
    cairo_line_to(page, x, bar_y);
  }
  cairo_move_to(page, left, bar_y);
  cairo_line_to(page, left + bar_m, bar_y);
  cairo_stroke(page);
  cairo_select_font_face(page, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  const std::string text = millimetres(bar_m) + "   " + legend(board);
  double size_m = text_m;
  cairo_set_font_size(page, size_m);
  cairo_text_extents_t extents;
  cairo_text_extents(page, text.c_str(), &extents);
  const double room_m = sheet.width_m - 2 * margin_m;
  if (extents.width > room_m) cairo_set_font_size(page, size_m * room_m / extents.width);
  cairo_move_to(page, left, sheet.height_m - margin_m);
  cairo_show_text(page, text.c_str());
}

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

PrintedPage print_board(const Board& board, const std::filesystem::path& file, const PrintOptions& options) {
  const bool both = options.page_width_m > 0 && options.page_height_m > 0;
  const bool neither = options.page_width_m == 0 && options.page_height_m == 0;
  if (!both && !neither) throw input_error(board.name, "a page needs a width and a height that are more than 0");
  if (!board.is_flat()) {
    throw input_error(board.name, "only boards in the plane z = 0 can be printed on a page",
                      "print its parts one by one");
  }
  const Extent bounds = extent(board);
  const PrintedPage sheet = choose_page(board, bounds.high - bounds.low + 2 * quiet_zone_m(board), options);

  std::string pdf;
  {
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
        cairo_pdf_surface_create_for_stream(append, &pdf, sheet.width_m * points_per_m, sheet.height_m * points_per_m),
        &cairo_surface_destroy);
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> page(cairo_create(surface.get()), &cairo_destroy);
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, legend(board).c_str());
    cairo_scale(page.get(), points_per_m, points_per_m);
    cairo_save(page.get());
    // The board's own frame: y up, its middle in the middle of the sheet above the legend.
    const glm::dvec2 middle = (bounds.low + bounds.high) * 0.5;
    cairo_translate(page.get(), sheet.width_m / 2, (sheet.height_m - legend_m) / 2);
    cairo_scale(page.get(), 1, -1);
    cairo_translate(page.get(), -middle.x, -middle.y);
    const BlackPath black(page.get());
    if (board.square_m > 0) {
      const double s = board.square_m;
      for (int row = 0; row < board.rows; ++row) {
        for (int column = row % 2; column < board.columns; column += 2) {
          const double x = column * s, y = (board.rows - 1 - row) * s;
          black.add({{{x, y + s, 0}, {x + s, y + s, 0}, {x + s, y, 0}, {x, y, 0}}});
        }
      }
    }
    if (!board.markers.empty()) {
      const auto dictionary = opencv_dictionary(board.name, board.dictionary);
      for (const BoardMarker& marker : board.markers) black.add_marker(marker, dictionary);
    }
    cairo_fill(page.get());
    cairo_restore(page.get());
    draw_legend(page.get(), board, sheet);
    cairo_show_page(page.get());
    cairo_surface_finish(surface.get());
    if (const cairo_status_t status = cairo_surface_status(surface.get()); status != CAIRO_STATUS_SUCCESS) {
      throw runtime_failure(file.string(), std::string("the page can't be drawn: ") + cairo_status_to_string(status));
    }
  }
  files::write_file(file.string(), pdf);
  return sheet;
}

}  // namespace rinkaku::track

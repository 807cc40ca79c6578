#include "pipeline/sheet.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include <cairo.h>

#include "pipeline/frame/error.h"
#include "pipeline/passes/composite/straight_alpha.h"

namespace rinkaku::pipeline {
namespace {

constexpr int kLabel_px = 28;

// Writes black text into the middle of a rectangle of an RGBA frame.
void write_label(const Frame& frame, const std::string& text, int x_px, int y_px, int width_px) {
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_A8, width_px, kLabel_px), cairo_surface_destroy);
  {
    const std::unique_ptr<cairo_t, void (*)(cairo_t*)> page(cairo_create(surface.get()), cairo_destroy);
    cairo_select_font_face(page.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    double size_px = 15;
    cairo_set_font_size(page.get(), size_px);
    cairo_text_extents_t extents;
    cairo_text_extents(page.get(), text.c_str(), &extents);
    if (extents.width > width_px - 8) cairo_set_font_size(page.get(), size_px * (width_px - 8) / extents.width);
    cairo_text_extents(page.get(), text.c_str(), &extents);
    cairo_move_to(page.get(), (width_px - extents.width) / 2, kLabel_px - 9.0);
    cairo_show_text(page.get(), text.c_str());
  }
  cairo_surface_flush(surface.get());
  const unsigned char* ink = cairo_image_surface_get_data(surface.get());
  if (ink == nullptr) throw runtime_failure("cairo", "can't draw text");
  const int stride = cairo_image_surface_get_stride(surface.get());
  const Plane& plane = frame.planes[0];
  for (int y = 0; y < kLabel_px; ++y) {
    std::uint8_t* out = plane.data + (y_px + y) * plane.stride_bytes + x_px * 4;
    for (int x = 0; x < width_px; ++x, out += 4) {
      const int left = 255 - ink[y * stride + x];
      for (int c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>(out[c] * left / 255);
    }
  }
}

void copy_cell(const Frame& from, const Frame& to, int x_px, int y_px) {
  for (int y = 0; y < from.format.height_px; ++y) {
    std::memcpy(to.planes[0].data + (y_px + y) * to.planes[0].stride_bytes + x_px * 4,
                from.planes[0].data + y * from.planes[0].stride_bytes,
                static_cast<std::size_t>(from.format.width_px) * 4);
  }
}

void fill(const Frame& frame, const glm::vec3& colour) {
  const Plane& plane = frame.planes[0];
  for (int y = 0; y < frame.format.height_px; ++y) {
    std::uint8_t* out = plane.data + y * plane.stride_bytes;
    for (int x = 0; x < frame.format.width_px; ++x, out += 4) {
      for (int c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>(std::lround(255 * colour[c]));
      out[3] = 255;
    }
  }
}

}  // namespace

std::vector<SheetCell> all_styles(double width_px) {
  std::vector<SheetCell> cells = {{"none", std::nullopt}};
  for (const NamedMethod& named : line_methods()) {
    OutlineScene outline;
    outline.method = named.method;
    outline.width_px = width_px;
    if (named.method == LineMethod::Isophote) outline.style.threshold = kIsophoteThreshold;
    outline.taper_px = usual_taper_px(named.method);
    if (brings_inner_lines(named.method)) outline.style.inner.emplace();
    cells.push_back({named.word, outline});
  }
  return cells;
}

Frame sheet(const mesh::Mesh& mesh, const std::vector<SheetCell>& cells, const SheetOptions& options) {
  const int count = static_cast<int>(cells.size()), columns = std::min(options.columns, std::max(count, 1));
  const int rows = (count + columns - 1) / columns;
  const int width = options.portrait.width_px, height = options.portrait.height_px + kLabel_px;
  const Frame frame = FramePool().allocate(passes::rgba_format(columns * width, std::max(rows, 1) * height, {1, 1}));
  fill(frame, options.portrait.background);
  for (int i = 0; i < count; ++i) {
    PortraitOptions one = options.portrait;
    one.outline = cells[static_cast<std::size_t>(i)].outline;
    const int x = i % columns * width, y = i / columns * height;
    copy_cell(portrait(mesh, one), frame, x, y);
    write_label(frame, cells[static_cast<std::size_t>(i)].label, x, y + height - kLabel_px, width);
  }
  return frame;
}

}  // namespace rinkaku::pipeline

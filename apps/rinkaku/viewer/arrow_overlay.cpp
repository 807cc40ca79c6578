#include "apps/rinkaku/viewer/arrow_overlay.h"

#include <cmath>

#include <imgui.h>

#include "pipeline/window/presenter.h"

namespace rinkaku::app {
namespace {

constexpr ImU32 dark = IM_COL32(10, 20, 30, 200), plain = IM_COL32(255, 240, 120, 255),
                chosen = IM_COL32(255, 130, 40, 255), misfit = IM_COL32(235, 60, 60, 255);
constexpr float reach = 9;  // of the mouse, in the screen's own pixels

// Where the window shows the recording's pixels.
struct Mapping {
  float x = 0, y = 0, across = 1, down = 1;
  ImVec2 to_window(glm::dvec2 p) const {
    return {x + (static_cast<float>(p.x) + 0.5f) * across, y + (static_cast<float>(p.y) + 0.5f) * down};
  }
  glm::dvec2 to_picture(ImVec2 p) const { return {(p.x - x) / across - 0.5f, (p.y - y) / down - 0.5f}; }
};

Mapping mapping(const PictureFormat& picture, ImVec2 display) {
  const auto place = window::Presenter::place(picture, static_cast<int>(display.x), static_cast<int>(display.y));
  return {static_cast<float>(place.x_px), static_cast<float>(place.y_px),
          static_cast<float>(place.width_px) / static_cast<float>(picture.width_px),
          static_cast<float>(place.height_px) / static_cast<float>(picture.height_px)};
}

// A light line on a dark one, which shows on any picture.
void draw_arrow(ImDrawList& list, ImVec2 from, ImVec2 to, ImU32 colour, float scale) {
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  const float head = std::min(11 * scale, 0.6f * length);
  const ImVec2 along = length > 0 ? ImVec2(dx / length, dy / length) : ImVec2(1, 0), across(-along.y, along.x);
  const ImVec2 neck(to.x - along.x * head, to.y - along.y * head);
  const ImVec2 left(neck.x + across.x * head * 0.5f, neck.y + across.y * head * 0.5f);
  const ImVec2 right(neck.x - across.x * head * 0.5f, neck.y - across.y * head * 0.5f);
  list.AddLine(from, neck, dark, 5 * scale);
  list.AddTriangle(to, left, right, dark, 3 * scale);
  list.AddCircleFilled(from, 4.5f * scale, dark);
  list.AddLine(from, neck, colour, 2.5f * scale);
  list.AddTriangleFilled(to, left, right, colour);
  list.AddCircleFilled(from, 3 * scale, colour);
}

}  // namespace

std::optional<std::string> arrow_overlay(ArrowEditor& editor, const PictureFormat& picture, float scale) {
  const ImGuiIO& io = ImGui::GetIO();
  const Mapping map = mapping(picture, io.DisplaySize);
  std::optional<std::string> text;
  const glm::dvec2 at = map.to_picture(io.MousePos);
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !io.WantCaptureMouse) {
    editor.press(at, static_cast<double>(reach * scale / map.across));
  } else if (ImGui::IsMouseReleased(ImGuiMouseButton_Left)) {
    editor.drag(at);
    text = editor.release();
  } else if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    editor.drag(at);
  }
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const ArrowEditor::Sketch& s : editor.sketches()) {
    draw_arrow(list, map.to_window(s.from_px), map.to_window(s.to_px),
               !s.fits      ? misfit
               : s.selected ? chosen
                            : plain,
               scale);
  }
  const char* help = "flow arrows: drag to draw or move, Del takes away, A: done";
  const ImVec2 size = ImGui::CalcTextSize(help);
  // On the right, as the panel is on the left.
  const ImVec2 place(io.DisplaySize.x - size.x - 9 * scale, io.DisplaySize.y - size.y - 6 * scale);
  list.AddRectFilled({place.x - 5 * scale, place.y - 3 * scale},
                     {place.x + size.x + 5 * scale, place.y + size.y + 3 * scale}, dark, 3 * scale);
  list.AddText(place, plain, help);
  return text;
}

}  // namespace rinkaku::app

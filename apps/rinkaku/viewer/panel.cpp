#include "apps/rinkaku/viewer/panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "apps/rinkaku/viewer/arrow_overlay.h"
#include "apps/rinkaku/viewer/tunables.h"

namespace rinkaku::app {
namespace {

const ImVec4 warning(1.0f, 0.45f, 0.35f, 1.0f);
constexpr float panel_width = 330;

void style_panel(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = style.FrameRounding = style.GrabRounding = 3;
  style.WindowBorderSize = 0;
  style.Colors[ImGuiCol_WindowBg].w = 0.82f;
  style.ScaleAllSizes(scale);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  ImFontConfig font;
  font.SizePixels = std::round(13 * scale);
  io.Fonts->AddFontDefault(&font);
}

}  // namespace

Panel::Panel(window::Window& window) : scale_(window.scale()) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  style_panel(scale_);
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

Panel::~Panel() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

bool Panel::wants_keys() const { return ImGui::GetIO().WantTextInput; }

PanelWish Panel::draw(const SceneFile& file, const PanelFacts& facts) {
  PanelWish wish;
  const std::string& lost = facts.status.health.notice;
  const bool says = open_ || !facts.trouble.empty() || !lost.empty();
  if (!says && !facts.arrows) return wish;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  if (facts.arrows && facts.shown) wish.text = arrow_overlay(*facts.arrows, facts.shown->frame.format, scale_);
  if (says) draw_window(file, facts, wish);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  return wish;
}

void Panel::draw_window(const SceneFile& file, const PanelFacts& facts, PanelWish& wish) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({8 * scale_, 8 * scale_}, ImGuiCond_Always);
  const float width = std::min(panel_width * scale_, display.x - 16 * scale_);
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, std::max(40.0f, display.y - 16 * scale_)});
  constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;
  ImGui::Begin("rinkaku", nullptr, fixed);
  for (const std::string* line : {&facts.trouble, &facts.status.health.notice}) {
    if (line->empty()) continue;
    ImGui::PushStyleColor(ImGuiCol_Text, warning);
    ImGui::TextWrapped("%s", line->c_str());
    ImGui::PopStyleColor();
  }
  if (open_) {
    draw_transport(file, facts, wish);
    draw_values(file, wish);
    draw_water(file, facts, wish);
    draw_times(facts);
  }
  ImGui::End();
}

void Panel::draw_transport(const SceneFile& file, const PanelFacts& facts, PanelWish& wish) {
  const char* state = facts.ended ? "at its end" : facts.paused ? "paused" : facts.status.live ? "live" : "playing";
  const long long number = facts.shown ? static_cast<long long>(facts.shown->frame.number) : 0;
  ImGui::Text("%s  frame %lld  %.1f fps%s", state, number, facts.fps,
              facts.shown && !facts.shown->camera_from_world ? "  no pose" : "");
  if (facts.status.live) {
    const auto& health = facts.status.health;
    ImGui::Text("capture to screen %.0f ms", facts.latency_ms);
    ImGui::Text("lost: %lld before us, %lld by us; damaged %lld", static_cast<long long>(health.missed),
                static_cast<long long>(facts.status.dropped.before + facts.status.unshown),
                static_cast<long long>(health.damaged));
  }
  wish.pause = ImGui::Button(facts.paused ? "go on" : "pause");
  ImGui::SameLine();
  wish.step = ImGui::Button("step");
  ImGui::SameLine();
  if (!facts.status.live) {
    wish.restart = ImGui::Button("restart");
    ImGui::SameLine();
  }
  wish.full_screen = ImGui::Button("full screen");
  wish.screenshot = ImGui::Button("screenshot");
  ImGui::SameLine();
  wish.save = ImGui::Button(file.unsaved() ? "save scene *" : "save scene");
  int look = static_cast<int>(facts.look);
  if (ImGui::Combo("view", &look, "picture\0mattes\0curvature\0")) wish.look = static_cast<Viewer::Look>(look);
  if (!facts.notice.empty()) ImGui::TextWrapped("%s", facts.notice.c_str());
}

void Panel::draw_values(const SceneFile& file, PanelWish& wish) {
  const auto add = [&wish](const toml::Path& path, const std::string& text) { wish.values.push_back({path, text}); };
  for (std::size_t i = 0; i < file.objects(); ++i) {
    const pipeline::ObjectScene& object = file.scene().objects[i];
    ImGui::PushID(static_cast<int>(i));
    const std::string title = object.name.empty() ? object.mesh.filename().string() : object.name;
    if (ImGui::CollapsingHeader((title + "###object").c_str(), i == 0 ? ImGuiTreeNodeFlags_DefaultOpen : 0)) {
      for (const Tunable& tunable : object_tunables()) {
        const bool drawn = !object.holdout || std::string_view(tunable.table).empty();
        if (drawn) fields_.draw(file, tunable, {{"object", i}}, add);
      }
    }
    ImGui::PopID();
  }
  for (const Tunable& tunable : scene_tunables()) fields_.draw(file, tunable, {}, add);
  for (std::size_t i = 0; i < file.scene().foregrounds.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::CollapsingHeader((file.scene().foregrounds[i].name + "###foreground").c_str())) {
      for (const Tunable& tunable : foreground_tunables()) fields_.draw(file, tunable, {{"foreground", i}}, add);
    }
    ImGui::PopID();
  }
  fields_.let_go(add);
}

void Panel::draw_water(const SceneFile& file, const PanelFacts& facts, PanelWish& wish) {
  if (!file.scene().water || !ImGui::CollapsingHeader("water", facts.arrows ? ImGuiTreeNodeFlags_DefaultOpen : 0)) {
    return;
  }
  bool editing = facts.arrows != nullptr;
  wish.arrows = ImGui::Checkbox("flow arrows (A)", &editing);
  if (facts.arrows) {
    ImGui::BeginDisabled(!facts.arrows->selected());
    wish.delete_arrow = ImGui::Button("take away");
    ImGui::EndDisabled();
    ImGui::SameLine();
    wish.key_arrows = ImGui::Button("key frame here");
    if (const auto key = facts.arrows->key_frame()) {
      ImGui::SameLine();
      ImGui::Text("of frame %lld", static_cast<long long>(*key));
    }
  }
  const auto add = [&wish](const toml::Path& path, const std::string& text) { wish.values.push_back({path, text}); };
  const auto draw_all = [&](const std::vector<Tunable>& tunables, const toml::Path& above) {
    for (const Tunable& tunable : tunables) fields_.draw(file, tunable, above, add);
  };
  draw_all(water_tunables(), {{"water"}});
  const auto numbered = [&](const char* title, const char* key, std::size_t count, const std::vector<Tunable>& which) {
    for (std::size_t i = 0; i < count; ++i) {
      ImGui::PushID(title);
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::TreeNode((std::string(title) + " " + std::to_string(i + 1)).c_str())) {
        draw_all(which, {{"water"}, {key, i}});
        ImGui::TreePop();
      }
      ImGui::PopID();
      ImGui::PopID();
    }
  };
  numbered("surface", "surface", file.scene().water->surfaces.size(), water_surface_tunables());
  numbered("spray", "spray", file.scene().water->sprays.size(), water_spray_tunables());
  fields_.let_go(add);
}

void Panel::draw_times(const PanelFacts& facts) {
  if (!facts.shown || !ImGui::CollapsingHeader("stages (ms)")) return;
  const auto& stages = facts.status.stages;
  // The first waits for the camera or the beat.
  for (std::size_t i = 1; i < stages.size() && i < smooth_ms_.size(); ++i) {
    smooth_ms_[i] += 0.1f * (facts.shown->stage_ms[i] - smooth_ms_[i]);
    if (stages[i] == "watch" || stages[i] == "show" || stages[i] == "encode") continue;
    ImGui::Text("%-12s %6.2f", stages[i].c_str(), static_cast<double>(smooth_ms_[i]));
  }
}

}  // namespace rinkaku::app

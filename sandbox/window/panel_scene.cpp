// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel_scene.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <array>
#include <utility>

#include "sandbox/window/panel.h"

namespace gloam {
namespace {

std::string camera_label(const PanelScene& scene, std::size_t index) {
  const std::string& name = scene.cameras[index];
  return std::to_string(index + 1) + "  " + (name.empty() ? "(no name)" : name);
}

}  // namespace

PickedLines sorted_pick_lines(std::span<const std::string> lines) {
  constexpr std::array<std::string_view, 7> kSurface = {"pixel ",     "view depth", "base colour", "normal ",
                                                        "roughness,", "emissive",   "emits"};
  PickedLines sorted;
  for (const std::string& line : lines) {
    const auto begins = [&](std::string_view begin) { return line.starts_with(begin); };
    if (begins("illuminance"))
      sorted.shares.push_back(line);
    else if (lines.size() == 1 || std::ranges::any_of(kSurface, begins))
      sorted.surface.push_back(line);
    else
      sorted.lists.push_back(line);
  }
  return sorted;
}

void Panel::show_settings(const PanelContent& content) {
  bool first = true;
  // Buttons that do not fit beside the last one begin a new line.
  const auto button = [&](const char* label, const char* name) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float width = ImGui::CalcTextSize(label).x + 2.0f * style.FramePadding.x;
    const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (!first && ImGui::GetItemRectMax().x + style.ItemSpacing.x + width <= end) ImGui::SameLine();
    first = false;
    const bool pressed = ImGui::Button(label);
    remember_widget(name);
    return pressed;
  };
  constexpr const char* kNames[KnobSlots::kSlots][2] = {{"keep A", "show A"}, {"keep B", "show B"}};
  for (std::size_t slot = 0; slot < KnobSlots::kSlots; ++slot) {
    if (button(kNames[slot][0], kNames[slot][0])) slots_.keep(content.knobs, slot);
    ImGui::BeginDisabled(!slots_.has(slot));
    if (button(kNames[slot][1], kNames[slot][1])) slots_.show(content.knobs, slot);
    ImGui::EndDisabled();
  }
  if (content.scene == nullptr) return;
  if (button("save --config", "save config")) content.scene->save_config();
  if (button("copy command", "copy command")) content.scene->copy_command();
  if (!content.scene->said.empty()) ImGui::TextWrapped("%s", content.scene->said.c_str());
}

void Panel::show_scene(const PanelScene& scene) {
  if (!ImGui::CollapsingHeader("Scene", ImGuiTreeNodeFlags_DefaultOpen)) return;
  bool paused = scene.paused;
  if (ImGui::Checkbox("paused", &paused)) scene.pause(paused);
  remember_widget("pause");
  ImGui::SameLine(0.0f, 2.0f * ImGui::GetFontSize());
  ImGui::TextDisabled("time %.2f s", scene.time_s);
  bool automatic = scene.automatic_exposure;
  if (ImGui::Checkbox("automatic exposure", &automatic)) scene.set_exposure(automatic, scene.ev100);
  remember_widget("exposure auto");
  if (scene.automatic_exposure) {
    ImGui::SameLine(0.0f, 2.0f * ImGui::GetFontSize());
    ImGui::TextDisabled("EV100 %.1f", static_cast<double>(scene.ev100));
  } else {
    float ev100 = scene.ev100;
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::SliderFloat("##exposure", &ev100, -6.0f, 18.0f, "EV100 %.1f")) scene.set_exposure(false, ev100);
    remember_widget("exposure");
  }
  if (!scene.cameras.empty()) {
    ImGui::SetNextItemWidth(-1.0f);
    const bool known = scene.camera > 0 && scene.camera <= scene.cameras.size();
    const std::string shown = known ? "camera: " + camera_label(scene, scene.camera - 1) : "camera: free flight";
    const bool open = ImGui::BeginCombo("##camera", shown.c_str());
    remember_widget("camera");
    if (open) {
      for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const bool current = i + 1 == scene.camera;
        if (ImGui::Selectable(camera_label(scene, i).c_str(), current))
          scene.show_camera(static_cast<std::uint32_t>(i + 1));
        remember_widget("camera " + scene.cameras[i]);
      }
      end_list();
    }
  }
  if (scene.has_camera) show_lens(scene);
  for (const std::string& warning : scene.warnings) {
    ImGui::TextWrapped("warning: %s", warning.c_str());
    remember_widget("warning");
  }
}

void Panel::show_lens(const PanelScene& scene) {
  constexpr float kFirstFocus = 5.0f;
  bool on = scene.focus_m > 0.0f;
  const float wanted = scene.picked_m > 0.0f ? scene.picked_m : kFirstFocus;
  if (ImGui::Checkbox("depth of field", &on)) scene.set_lens(on ? wanted : 0.0f, scene.f_number);
  remember_widget("lens");
  if (scene.focus_m <= 0.0f) return;
  ImGui::SameLine();
  ImGui::BeginDisabled(scene.picked_m <= 0.0f);
  if (ImGui::Button("focus on the clicked pixel")) scene.set_lens(scene.picked_m, scene.f_number);
  ImGui::EndDisabled();
  remember_widget("lens here");
  float focus = scene.focus_m, f_number = scene.f_number;
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##focus", &focus, 0.1f, 1000.0f, "focus %.2f m", ImGuiSliderFlags_Logarithmic))
    scene.set_lens(focus, f_number);
  remember_widget("lens focus");
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##f_number", &f_number, 0.5f, 32.0f, "f/%.1f", ImGuiSliderFlags_Logarithmic))
    scene.set_lens(focus, f_number);
  remember_widget("lens f-number");
}

void Panel::show_pixel(const PanelScene& scene) {
  if (std::exchange(seen_pick_, scene.pick) != scene.pick) bring_into_view(0.0f);
  const bool open = ImGui::CollapsingHeader("Pixel", ImGuiTreeNodeFlags_DefaultOpen);
  remember_widget("pixel");
  if (!open) return;
  if (scene.picked.empty()) {
    ImGui::TextDisabled("click a pixel to see its surface and what each light adds");
    return;
  }
  const PickedLines lines = sorted_pick_lines(scene.picked);
  for (const std::string& line : lines.shares) ImGui::TextWrapped("%s", line.c_str());
  for (const std::string& line : lines.surface) ImGui::TextWrapped("%s", line.c_str());
  if (lines.lists.empty()) return;
  const bool unfolded = ImGui::TreeNode("lists and slots");
  remember_widget("pixel lists");
  if (!unfolded) return;
  for (const std::string& line : lines.lists) ImGui::TextWrapped("%s", line.c_str());
  ImGui::TreePop();
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "sandbox/window/panel.h"
#include "sandbox/window/panel_scene.h"

namespace gloam {
namespace {

constexpr ImGuiColorEditFlags kSwatch =
    ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_HDR | ImGuiColorEditFlags_Float;

// A drag by a pixel changes an intensity by one percent, whatever its order of magnitude.
constexpr float kIntensityStep = 0.01f;
constexpr float kLeastIntensityStep = 0.001f;  // leads away from 0
constexpr float kMostIntensity = 1e6f;

bool contains(std::string_view text, std::string_view search) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  return search.empty() || std::ranges::search(text, search, same).begin() != text.end();
}

}  // namespace

std::vector<std::size_t> shown_lights(std::span<const PanelLight> lights, std::string_view search, bool by_share) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (contains(lights[i].name, search) || contains(lights[i].kind, search)) shown.push_back(i);
  if (by_share)
    std::ranges::stable_sort(shown, [&](std::size_t a, std::size_t b) { return lights[a].share > lights[b].share; });
  return shown;
}

void Panel::show_lights(const PanelScene& scene) {
  const std::string title = "Lights (" + std::to_string(scene.lights.size()) + ")###lights";
  const bool open = ImGui::CollapsingHeader(title.c_str());
  remember_widget("lights");
  if (!open || scene.lights.empty()) return;
  if (ImGui::Checkbox("by share of the picture", &lights_by_share_) && lights_by_share_) scene.measure_shares();
  remember_widget("lights by share");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("before shadows, of the picture when this was chosen");
  ImGui::SameLine();
  if (ImGui::Button("save --lights")) scene.save_lights();
  remember_widget("save lights");
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputTextWithHint("##search lights", "search", &light_search_);
  remember_widget("lights search");
  show_light_table(scene);
  if (selected_light_ < scene.lights.size()) show_light_details(scene);
  if (std::exchange(bring_details_, false)) bring_into_view(1.0f);
}

void Panel::show_light_table(const PanelScene& scene) {
  constexpr float kMostLines = 8.0f;
  const std::vector<std::size_t> shown = shown_lights(scene.lights, light_search_, lights_by_share_);
  const float line = ImGui::GetFrameHeightWithSpacing();
  const float height = line * std::min(static_cast<float>(shown.size()) + 1.2f, kMostLines);
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollY;
  if (!ImGui::BeginTable("lights", lights_by_share_ ? 5 : 4, kFlags, ImVec2(0.0f, height))) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("light");
  ImGui::TableSetupColumn("solo");
  ImGui::TableSetupColumn("mute");
  ImGui::TableSetupColumn("intensity", ImGuiTableColumnFlags_WidthStretch);
  if (lights_by_share_) ImGui::TableSetupColumn("share");
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(shown.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const std::size_t light = shown[static_cast<std::size_t>(i)];
      ImGui::PushID(static_cast<int>(light));
      show_light(scene, light);
      ImGui::PopID();
    }
  ImGui::EndTable();
}

void Panel::show_light(const PanelScene& scene, std::size_t index) {
  PanelLight light = scene.lights[index];
  const std::string name = light.name;
  bool changed = false;
  ImGui::TableNextColumn();
  changed |= ImGui::ColorEdit3("##color", &light.color.r, kSwatch);
  remember_widget(name + " color");
  ImGui::SameLine();
  const std::string label = (name.empty() ? "(no name)" : name) + "  " + light.kind;
  if (ImGui::Selectable(label.c_str(), index == selected_light_)) {
    selected_light_ = index == selected_light_ ? kNoLight : index;
    bring_details_ = selected_light_ != kNoLight;
    scene.select(selected_light_);
  }
  remember_widget(name);
  ImGui::TableNextColumn();
  changed |= ImGui::Checkbox("##solo", &light.solo);
  remember_widget(name + " solo");
  ImGui::TableNextColumn();
  changed |= ImGui::Checkbox("##mute", &light.muted);
  remember_widget(name + " mute");
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-1.0f);
  const std::string format = "%.4g " + light.unit;
  const float step = std::max(kIntensityStep * light.intensity, kLeastIntensityStep);
  changed |= ImGui::DragFloat("##intensity", &light.intensity, step, 0.0f, kMostIntensity, format.c_str());
  remember_widget(name + " intensity");
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) ImGui::SetTooltip("drag, or double-click to type a number");
  if (lights_by_share_) {
    ImGui::TableNextColumn();
    if (light.share >= 0.0) ImGui::Text("%5.1f %%", 100.0 * light.share);
  }
  if (changed) scene.set_light(index, light);
}

void Panel::show_light_details(const PanelScene& scene) {
  PanelLight light = scene.lights[selected_light_];
  bool changed = false;
  ImGui::Separator();
  if (ImGui::Button("locate")) scene.locate(selected_light_);
  remember_widget("light locate");
  ImGui::SameLine();
  changed |= ImGui::Checkbox("shadows", &light.shadows);
  remember_widget("light shadows");
  ImGui::SameLine();
  ImGui::BeginDisabled(!light.has_cookie);
  changed |= ImGui::Checkbox("cookie", &light.cookie);
  ImGui::EndDisabled();
  remember_widget("light cookie");
  if (light.unit == "cd") {
    ImGui::SetNextItemWidth(-1.0f);
    const char* const format = light.range_m == 0.0f ? "range: as far as it can be seen" : "range %.2f m";
    changed |= ImGui::SliderFloat("##range", &light.range_m, 0.0f, 1000.0f, format, ImGuiSliderFlags_Logarithmic);
    remember_widget("light range");
    ImGui::SetNextItemWidth(-1.0f);
    changed |= ImGui::SliderFloat("##width", &light.width_m, 0.0f, 5.0f, "width %.3f m", ImGuiSliderFlags_Logarithmic);
    remember_widget("light width");
    ImGui::TextDisabled("in the picture: drag an axis to move it, the square to aim it");
  }
  if (changed) scene.set_light(selected_light_, light);
}

}  // namespace gloam

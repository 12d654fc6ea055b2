// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel_scene.h"

#include <imgui/imgui.h>

#include "sandbox/window/panel.h"

namespace gloam {
namespace {

void show_line(const std::string& text) { ImGui::TextUnformatted(text.data(), text.data() + text.size()); }

std::string camera_label(const PanelScene& scene, std::size_t index) {
  const std::string& name = scene.cameras[index];
  return std::to_string(index + 1) + "  " + (name.empty() ? "(no name)" : name);
}

}  // namespace

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
  const bool open = ImGui::CollapsingHeader("Pixel", ImGuiTreeNodeFlags_DefaultOpen);
  remember_widget("pixel");
  if (!open) return;
  if (scene.picked.empty()) {
    ImGui::TextDisabled("click a pixel to see its surface and what each light adds");
    return;
  }
  for (const std::string& line : scene.picked) ImGui::TextWrapped("%s", line.c_str());
}

void Panel::show_lights(const PanelScene& scene) {
  const std::string title = "Lights (" + std::to_string(scene.lights.size()) + ")###lights";
  const bool open = ImGui::CollapsingHeader(title.c_str());
  remember_widget("lights");
  if (!open) return;
  if (!ImGui::BeginTable("lights", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("light");
  ImGui::TableSetupColumn("solo");
  ImGui::TableSetupColumn("mute");
  ImGui::TableSetupColumn("intensity", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(scene.lights.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      ImGui::PushID(i);
      show_light(scene, static_cast<std::size_t>(i));
      ImGui::PopID();
    }
  ImGui::EndTable();
}

void Panel::show_light(const PanelScene& scene, std::size_t index) {
  const PanelLight& light = scene.lights[index];
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  show_line(light.name.empty() ? "(no name)" : light.name);
  ImGui::SameLine();
  ImGui::TextDisabled("%s", light.kind.c_str());
  ImGui::TableNextColumn();
  bool solo = light.solo;
  if (ImGui::Checkbox("##solo", &solo)) scene.solo(index, solo);
  remember_widget(light.name + " solo");
  ImGui::TableNextColumn();
  bool muted = light.muted;
  if (ImGui::Checkbox("##mute", &muted)) scene.mute(index, muted);
  remember_widget(light.name + " mute");
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-1.0f);
  float intensity = light.intensity;
  const std::string format = "%.4g " + light.unit;
  if (ImGui::SliderFloat("##intensity", &intensity, 0.0f, 100000.0f, format.c_str(), ImGuiSliderFlags_Logarithmic))
    scene.set_intensity(index, intensity);
  remember_widget(light.name + " intensity");
}

}  // namespace gloam

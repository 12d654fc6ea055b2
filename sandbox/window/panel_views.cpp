// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>

#include "engine/render/passes/visualizer_pass.h"
#include "sandbox/session/program_knobs.h"
#include "sandbox/window/panel.h"
#include "shaders/common/heat_shared.h"

namespace gloam {
namespace {

std::string stem_of(const std::string& visualizer) { return visualizer.substr(0, visualizer.find(':')); }

}  // namespace

void Panel::show_views(const PanelContent& content) {
  if (!ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const std::string current = asked_.empty() ? stem_of(content.visualizer) : asked_;
  const auto shown = std::ranges::find(content.visualizers, current, &VisualizerInfo::name);
  ImGui::SetNextItemWidth(-1.0f);
  const bool open = ImGui::BeginCombo("##view", current.c_str(), ImGuiComboFlags_HeightLargest);
  remember_widget("view");
  if (open) {
    show_view_list(content, current);
    end_list();
  }
  if (shown == content.visualizers.end()) return;
  if (!shown->argument.empty()) show_view_argument(content, *shown);
  if (!fault_.empty()) ImGui::TextWrapped("%s", fault_.c_str());
  ImGui::TextWrapped("%s", shown->legend.c_str());
  if (shown->heat.most > 0.0) show_heat_scale(content, shown->heat);
}

/// The views of effects that the scene calls for; below them, folded away, the others and why they show nothing, and
/// the traced ones.
void Panel::show_view_list(const PanelContent& content, const std::string& current) {
  const ViewGroups groups = view_groups(content.visualizers, content.modules);
  for (const VisualizerInfo* info : groups.called_for) show_view_choice(content, *info, current);
  show_traced_views(groups.traced);
  if (groups.others.empty()) return;
  std::size_t count = 0;
  for (const IdleViews& idle : groups.others) count += idle.views.size();
  const bool unfolded = ImGui::TreeNode("##others", "%zu of effects that the scene does not call for", count);
  remember_widget("other views");
  if (!unfolded) return;
  for (const IdleViews& idle : groups.others) {
    ImGui::TextDisabled("%s: %s", idle.module.c_str(), idle.reason.c_str());
    for (const VisualizerInfo* info : idle.views) show_view_choice(content, *info, current);
  }
  ImGui::TreePop();
}

void Panel::show_traced_views(std::span<const VisualizerInfo* const> views) {
  if (views.empty()) return;
  const bool unfolded = ImGui::TreeNode("##traced", "%zu that take seconds: gloam render --view NAME", views.size());
  remember_widget("traced views");
  if (!unfolded) return;
  for (const VisualizerInfo* info : views) ImGui::TextDisabled("%s", info->name.c_str());
  ImGui::TreePop();
}

void Panel::show_view_choice(const PanelContent& content, const VisualizerInfo& info, const std::string& current) {
  const bool chosen = ImGui::Selectable(info.name.c_str(), info.name == current);
  remember_widget("view " + info.name);
  if (ImGui::IsItemHovered()) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 35.0f);
    ImGui::TextUnformatted(info.legend.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  if (!chosen) return;
  fault_.clear();
  asked_ = info.argument.empty() ? "" : info.name;
  if (!info.argument.empty()) return;
  if (const Status status = content.show(info.name); !status.ok()) fault_ = status.error().message;
}

/// A bar of the scale's colours with its values, and the knob of its range.
void Panel::show_heat_scale(const PanelContent& content, const HeatScale& heat) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 0.6f * ImGui::GetFontSize();
  const auto color_of = [](int stop) {
    const vec3 c = glm::pow(heat_color(static_cast<double>(stop) / (GLOAM_HEAT_STOPS - 1)), vec3(1.0f / 2.2f));
    return ImGui::GetColorU32(ImVec4(c.r, c.g, c.b, 1.0f));
  };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (int stop = 0; stop + 1 < GLOAM_HEAT_STOPS; ++stop) {
    const float left = at.x + width * static_cast<float>(stop) / (GLOAM_HEAT_STOPS - 1);
    const float right = at.x + width * static_cast<float>(stop + 1) / (GLOAM_HEAT_STOPS - 1);
    draw.AddRectFilledMultiColor(ImVec2(left, at.y), ImVec2(right, at.y + height), color_of(stop), color_of(stop + 1),
                                 color_of(stop + 1), color_of(stop));
  }
  for (const HeatTick& tick : heat_ticks(heat, content.heat_range)) {
    const float wide = ImGui::CalcTextSize(tick.text.c_str()).x;
    const float middle = at.x + width * static_cast<float>(tick.share);
    const float left = std::clamp(middle - 0.5f * wide, at.x, std::max(at.x, at.x + width - wide));
    draw.AddText(ImVec2(left, at.y + height), ImGui::GetColorU32(ImGuiCol_Text), tick.text.c_str());
  }
  ImGui::Dummy(ImVec2(width, height + ImGui::GetTextLineHeightWithSpacing()));
  const Knob* range = content.knobs.find(kHeatRange.name);
  if (range == nullptr || !ImGui::BeginTable("range", 3, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("name");
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  show_knob(content, *range);
  ImGui::EndTable();
}

void Panel::show_view_argument(const PanelContent& content, const VisualizerInfo& info) {
  ImGui::SetNextItemWidth(-1.0f);
  const bool entered =
      ImGui::InputTextWithHint("##argument", info.argument.c_str(), &argument_, ImGuiInputTextFlags_EnterReturnsTrue);
  remember_widget("view argument");
  if (entered) {
    const Status status = content.show(info.name + ":" + argument_);
    fault_ = status.ok() ? "" : status.error().message;
    if (status.ok()) asked_.clear();
  }
}

}  // namespace gloam

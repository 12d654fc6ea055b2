// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel_wipe.h"

#include <imgui/imgui.h>

#include <algorithm>

#include "sandbox/window/panel.h"

namespace gloam {

const char* name_of(WipeSide side) {
  switch (side) {
    case WipeSide::exact:
      return "exact";
    case WipeSide::kept_a:
      return "A";
    case WipeSide::kept_b:
      return "B";
    case WipeSide::picture:
      return "picture";
    case WipeSide::view:
      return "view";
  }
  return "";
}

std::string right_side(const PanelWipe& wipe) {
  return name_of(wipe.side) + (wipe.side == WipeSide::view ? " " + wipe.visualizer : "");
}

namespace {

const char* meaning_of(WipeSide side) {
  switch (side) {
    case WipeSide::exact:
      return "each knob of a budget at its value in the most exact setting; pauses the scene";
    case WipeSide::kept_a:
      return "the settings that were kept as A";
    case WipeSide::kept_b:
      return "the settings that were kept as B";
    case WipeSide::picture:
      return "the lit picture, beside the view";
    case WipeSide::view:
      return "the view that was shown before this one";
  }
  return "";
}

bool same_settings(const std::vector<KnobOverride>& a, const std::vector<KnobOverride>& b) {
  return std::ranges::equal(
      a, b, [](const KnobOverride& x, const KnobOverride& y) { return x.name == y.name && x.value == y.value; });
}

}  // namespace

bool Panel::offers(const PanelContent& content, WipeSide side) const {
  switch (side) {
    case WipeSide::exact:
      return content.budgets != nullptr && !content.budgets->budgets.empty();
    case WipeSide::kept_a:
      return slots_.has(0);
    case WipeSide::kept_b:
      return slots_.has(1);
    case WipeSide::picture:
      return content.visualizer != "none";
    case WipeSide::view: {
      const std::string view = wipe_of(*content.wipe, side).visualizer;
      return !view.empty() && view != content.visualizer;
    }
  }
  return false;
}

PanelWipe Panel::wipe_of(const PanelWipe& now, WipeSide side) const {
  PanelWipe wipe = {.on = now.on, .at = now.at, .side = side};
  if (side == WipeSide::kept_a) wipe.kept = slots_.kept(0);
  if (side == WipeSide::kept_b) wipe.kept = slots_.kept(1);
  if (side == WipeSide::view) wipe.visualizer = now.on && now.side == side ? now.visualizer : view_before_;
  return wipe;
}

void Panel::show_wipe(const PanelContent& content) {
  const PanelWipe& now = *content.wipe;
  if (view_now_ != content.visualizer) {
    if (view_now_ != "none") view_before_ = view_now_;
    view_now_ = content.visualizer;
  }
  const auto is_offered = [&](WipeSide side) { return offers(content, side); };
  if (now.on && !is_offered(now.side)) return content.set_wipe({.on = false, .at = now.at});
  const auto* const first = std::ranges::find_if(kWipeSides, is_offered);
  const bool any = first != std::end(kWipeSides);
  if (any && !is_offered(wipe_side_)) wipe_side_ = *first;
  // Settings that are kept anew are shown at once.
  PanelWipe wanted = wipe_of(now, wipe_side_);
  bool changed = now.on && !same_settings(wanted.kept, now.kept);
  ImGui::BeginDisabled(!any);
  changed |= ImGui::Checkbox("wipe: now |", &wanted.on);
  remember_widget("wipe");
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("%s", any ? "left of the line: now. Drag the line in the picture; Escape ends the wipe."
                                : "needs another side: keep A or B, show a view, or set a budget");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0f);
  const bool open = ImGui::BeginCombo("##side", any ? right_side(wanted).c_str() : "nothing to compare");
  remember_widget("wipe side");
  if (open) {
    for (const WipeSide side : kWipeSides) {
      if (!is_offered(side)) continue;
      if (ImGui::Selectable(right_side(wipe_of(now, side)).c_str(), side == wipe_side_)) {
        wipe_side_ = side;
        wanted = wipe_of(now, side);
        changed |= now.on;
      }
      remember_widget(std::string("wipe side ") + name_of(side));
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", meaning_of(side));
    }
    end_list();
  }
  ImGui::EndDisabled();
  if (now.on) {
    ImGui::SetNextItemWidth(-1.0f);
    changed |= ImGui::SliderFloat("##wipe", &wanted.at, 0.0f, 1.0f, "line at %.2f", ImGuiSliderFlags_AlwaysClamp);
    remember_widget("wipe line");
    if (!now.note.empty()) ImGui::TextWrapped("%s", now.note.c_str());
  }
  if (changed) content.set_wipe(wanted);
}

}  // namespace gloam

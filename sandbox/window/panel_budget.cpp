// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel_budget.h"

#include <imgui/imgui.h>

#include <algorithm>

#include "sandbox/window/panel.h"

namespace gloam {
namespace {

constexpr double kLeastMs = 1.0;
constexpr double kMostMs = 1000.0;

void show_wrapped(const std::string& text, const std::string& tooltip = {}) {
  if (text.empty()) return;
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  if (!tooltip.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tooltip.c_str());
}

}  // namespace

const PanelBudgetKnob* PanelBudgets::find(std::string_view knob) const {
  for (const PanelBudget& budget : budgets)
    if (const auto found = std::ranges::find(budget.knobs, knob, &PanelBudgetKnob::name); found != budget.knobs.end())
      return &*found;
  return nullptr;
}

void Panel::show_budgets(const PanelBudgets& budgets) {
  if (budgets.budgets.empty()) return;
  const bool open = ImGui::CollapsingHeader("Budget", ImGuiTreeNodeFlags_DefaultOpen);
  remember_widget("budget section");
  if (!open) return;
  for (std::size_t i = 0; i < budgets.budgets.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (i > 0) ImGui::Separator();
    show_budget(budgets, i);
    ImGui::PopID();
  }
  if (!budgets.fault.empty()) ImGui::TextWrapped("%s", budgets.fault.c_str());
}

void Panel::show_budget(const PanelBudgets& budgets, std::size_t index) {
  const PanelBudget& budget = budgets.budgets[index];
  const std::string suffix = budget.effect.empty() ? "" : " " + budget.effect;
  const std::string format = budget.effect.empty() ? "frames within %.4g ms" : budget.effect + " within %.4g ms";
  double ms = budget.ms;
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderScalar("##ms", ImGuiDataType_Double, &ms, &kLeastMs, &kMostMs, format.c_str(),
                          ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
    budgets.set_ms(index, ms);
  remember_widget("budget" + suffix);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("90 %% of frames are to take at most this long; Ctrl and a click: type a number");
  show_wrapped(budget.setting + ", " + budget.error,
               "mean FLIP against the exact picture, when it was measured. 0: equal; 1: the largest difference");
  show_wrapped(budget.measured);
  show_wrapped("step down: " + budget.down, budget.down_knobs);
  show_wrapped("step up: " + budget.up, budget.up_knobs);
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  show_wrapped(budget.moved);
  ImGui::PopStyleColor();
  show_budget_knobs(budgets, index);
}

void Panel::show_budget_knobs(const PanelBudgets& budgets, std::size_t index) {
  const PanelBudget& budget = budgets.budgets[index];
  if (budget.knobs.empty() || !ImGui::BeginTable("knobs", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit))
    return;
  ImGui::TableSetupColumn("lock");
  ImGui::TableSetupColumn("knob");
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableHeadersRow();
  for (const PanelBudgetKnob& knob : budget.knobs) {
    ImGui::PushID(knob.name.c_str());
    ImGui::TableNextColumn();
    bool locked = knob.locked;
    if (ImGui::Checkbox("##lock", &locked)) budgets.lock(index, knob.name, locked);
    remember_widget("lock " + knob.name);
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip(knob.locked ? "the knob keeps its value: click to give it back to the budget"
                                    : "click to keep this value whatever the budget chooses");
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(knob.name.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(knob.value.c_str());
    ImGui::PopID();
  }
  ImGui::EndTable();
}

}  // namespace gloam

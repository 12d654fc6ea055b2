// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel.h"

#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "engine/core/text/formatted.h"
#include "engine/render/passes/visualizer_pass.h"

namespace gloam {
namespace {

constexpr float kMargin = 10.0f;
constexpr float kWidth = 470.0f;
constexpr float kLeastWidth = 300.0f;
constexpr float kMostOfPicture = 0.62f;  // of the width, so that some of a small picture stays visible

void show_text(const std::string& text) { ImGui::TextUnformatted(text.data(), text.data() + text.size()); }

void show_tooltip(const std::string& text) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 35.0f);
  show_text(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

/// What a budget does with a knob, for its tooltip. knob: null if no budget names it.
std::string budget_note(const PanelBudgetKnob* knob) {
  if (knob == nullptr) return {};
  return knob->locked ? "\nlocked: the budget leaves it alone; unlock it in the section Budget"
                      : "\nthe budget sets it; a change here locks it";
}

constexpr ImGuiTableFlags kTableFlags =
    ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingFixedFit;

void show_notice(const PanelNotice& notice) {
  if (notice.text.empty()) return;
  const ImVec4 color =
      notice.is_error ? ImVec4(1.0f, 0.45f, 0.4f, 1.0f) : ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::PushTextWrapPos(0.0f);
  show_text(notice.text);
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void show_passes(const FrameTimes& times) {
  if (!ImGui::CollapsingHeader("Passes", ImGuiTreeNodeFlags_DefaultOpen)) return;
  if (!ImGui::BeginTable("passes", 4, kTableFlags)) return;
  ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("module");
  ImGui::TableSetupColumn("ms");
  ImGui::TableSetupColumn("calls");
  ImGui::TableHeadersRow();
  for (const PassTime& pass : times.passes()) {
    ImGui::TableNextColumn();
    show_text(pass.name);
    ImGui::TableNextColumn();
    show_text(pass.module);
    ImGui::TableNextColumn();
    ImGui::Text("%8.3f", pass.ms);
    ImGui::TableNextColumn();
    ImGui::Text("%5u", pass.draws + pass.dispatches);
    show_tooltip(std::to_string(pass.draws) + " draws, " + std::to_string(pass.dispatches) + " dispatches");
  }
  ImGui::EndTable();
}

void show_systems(const FrameTimes& times) {
  if (!ImGui::CollapsingHeader("Systems")) return;
  if (!ImGui::BeginTable("systems", 3, kTableFlags)) return;
  ImGui::TableSetupColumn("system", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("module");
  ImGui::TableSetupColumn("ms");
  ImGui::TableHeadersRow();
  for (const SystemTime& system : times.systems()) {
    ImGui::TableNextColumn();
    show_text(system.name);
    ImGui::TableNextColumn();
    show_text(system.module);
    ImGui::TableNextColumn();
    ImGui::Text("%8.3f", system.ms);
  }
  ImGui::EndTable();
}

void show_modules(std::span<const ModuleState> modules) {
  if (!ImGui::CollapsingHeader("Modules", ImGuiTreeNodeFlags_DefaultOpen)) return;
  if (!ImGui::BeginTable("modules", 4, kTableFlags)) return;
  ImGui::TableSetupColumn("module");
  ImGui::TableSetupColumn("runs");
  ImGui::TableSetupColumn("MiB");
  ImGui::TableSetupColumn("because", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableHeadersRow();
  for (const ModuleState& module : modules) {
    const bool runs = module.demanded;
    if (!runs) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TableNextColumn();
    show_text(module.name);
    ImGui::TableNextColumn();
    show_text(runs ? "yes" : "no");
    ImGui::TableNextColumn();
    ImGui::Text("%6.1f", static_cast<double>(module.gpu_bytes) / (1024.0 * 1024.0));
    show_tooltip(std::to_string(module.pipelines) + " pipelines");
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", module.reason.c_str());
    if (!runs) ImGui::PopStyleColor();
  }
  ImGui::EndTable();
}

/// A line at the lower right corner, over everything: a line in the panel would move the widgets below it.
void draw_progress(const PanelProgress& progress, const PanelFrame& frame) {
  if (progress.left == 0) return;
  const std::string text = "compiling " + progress.name +
                           (progress.left > 1 ? formatted(", %zu left", progress.left) : "") +
                           "; meanwhile the picture keeps the last settings";
  const float font = ImGui::GetFontSize();
  const auto right = static_cast<float>(frame.width), bottom = static_cast<float>(frame.height);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, 0.7f * right);
  const ImVec2 from(right - size.x - 1.5f * font, bottom - size.y - 1.5f * font);
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddRectFilled(ImVec2(from.x - 0.5f * font, from.y - 0.5f * font), ImVec2(right - font, bottom - font),
                     IM_COL32(20, 20, 20, 220), 0.3f * font);
  list.AddText(ImGui::GetFont(), font, from, IM_COL32(255, 220, 120, 255), text.c_str(), nullptr, 0.7f * right);
}

/// Marks lie below all windows.
void draw_marks(std::span<const PanelMark> marks, float scale) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto point = [](const glm::dvec2& at, double x = 0.0, double y = 0.0) {
    return ImVec2(static_cast<float>(at.x + x), static_cast<float>(at.y + y));
  };
  const float radius = 6.0f * scale;
  const double r = static_cast<double>(radius);
  for (const PanelMark& mark : marks) {
    const ImU32 color = IM_COL32(mark.color[0], mark.color[1], mark.color[2], 255);
    // A dark edge keeps marks visible on a bright picture.
    for (const auto& [ink, width] : {std::pair(IM_COL32(0, 0, 0, 160), 4.0f * scale), std::pair(color, 1.8f * scale)}) {
      switch (mark.shape) {
        case PanelMark::Shape::line:
          list.AddLine(point(mark.from), point(mark.to), ink, width);
          break;
        case PanelMark::Shape::square:
          list.AddRect(point(mark.from, -r, -r), point(mark.from, r, r), ink, 0.0f, 0, width);
          break;
        case PanelMark::Shape::circle:
          list.AddCircle(point(mark.from), radius, ink, 0, width);
          break;
        case PanelMark::Shape::cross:
          for (const double sign : {-1.0, 1.0}) {
            list.AddLine(point(mark.from, sign * 3.0), point(mark.from, sign * 2.0 * r), ink, width);
            list.AddLine(point(mark.from, 0.0, sign * 3.0), point(mark.from, 0.0, sign * 2.0 * r), ink, width);
          }
          break;
      }
    }
    const glm::dvec2 at = mark.shape == PanelMark::Shape::line ? mark.to : mark.from;
    if (!mark.label.empty()) list.AddText(point(at, 1.5 * r, -r), color, mark.label.c_str());
  }
}

}  // namespace

void Panel::update(const PanelInput& input, const PanelFrame& frame, const PanelContent& content) {
  widgets_.clear();
  gui_.begin(input, frame);
  const auto across = static_cast<float>(frame.width);
  const float wanted = std::max(std::min(kWidth * gui_.scale(), kMostOfPicture * across), kLeastWidth * gui_.scale());
  const float width = std::min(wanted, across - 2.0f * kMargin);
  ImGui::SetNextWindowPos(ImVec2(kMargin, kMargin), ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize(ImVec2(width, static_cast<float>(frame.height) - 2.0f * kMargin), ImGuiCond_FirstUseEver);
  if (ImGui::Begin("gloam")) {
    show_notice(content.notice);
    show_times(content.times);
    show_scale(content, frame);
    if (content.budgets != nullptr) show_budgets(*content.budgets);
    show_settings(content);
    if (content.wipe != nullptr) show_wipe(content);
    show_views(content);
    if (content.scene != nullptr) {
      show_scene(*content.scene);
      show_lights(*content.scene);
      show_pixel(*content.scene);
    }
    show_knobs(content);
    show_passes(content.times);
    show_systems(content.times);
    show_modules(content.modules);
  }
  ImGui::End();
  draw_marks(content.marks, gui_.scale());
  draw_progress(content.progress, frame);
  gui_.end();
}

void Panel::remember_widget(const std::string& name) {
  const ImVec2 from = ImGui::GetItemRectMin();
  const ImVec2 to = ImGui::GetItemRectMax();
  widgets_.push_back({name, from.x, from.y, to.x, to.y});
}

void Panel::bring_into_view(float share) {
  const float place = ImGui::GetCursorScreenPos().y, top = ImGui::GetWindowPos().y;
  const float lines = share < 0.5f ? 4.0f * ImGui::GetFrameHeightWithSpacing() : 0.0f;  // of what begins here
  if (place < top || place + lines > top + ImGui::GetWindowHeight()) ImGui::SetScrollHereY(share);
}

void Panel::show_times(const FrameTimes& times) {
  ImGui::Text("frame %.2f ms   CPU %.2f ms   GPU %.2f ms", times.frame_ms(), times.cpu_ms(), times.gpu_ms());
  show_tooltip("medians of the last " + std::to_string(FrameTimes::kFrames) +
               " frames. CPU: systems, declaration and recording, with what they waited for. GPU: all passes.");
  const std::span<const double> history = times.frame_history();
  if (history.size() < 2) return;
  const auto value = [](void* data, int at) { return static_cast<float>(static_cast<const double*>(data)[at]); };
  // Single long frames, such as the first one, would make the others invisible.
  constexpr double kMostMedians = 3.0;
  const double longest = *std::ranges::max_element(history);
  const double top = std::min(1.8 * longest, kMostMedians * times.frame_ms());  // the text is above steady lines
  ImGui::SetNextItemWidth(-1.0f);
  std::string text = formatted("%.1f frames/s, longest %.0f ms", 1e3 / std::max(times.frame_ms(), 1e-3), longest);
  ImGui::PlotLines("##history", value, const_cast<double*>(history.data()), static_cast<int>(history.size()), 0,
                   text.c_str(), 0.0f, static_cast<float>(top), ImVec2(0.0f, 36.0f * gui_.scale()));
  text = formatted("times of the last %zu frames, from 0 to %.0f ms", history.size(), top);
  show_tooltip(text.c_str());
}

void Panel::show_scale(const PanelContent& content, const PanelFrame& frame) {
  ImGui::AlignTextToFramePadding();
  ImGui::Text("drawn at %.0f x %.0f", std::round(frame.width * content.scale),
              std::round(frame.height * content.scale));
  if (content.set_scale) show_scale_choice(content);
  if (!content.scale_note.empty()) ImGui::TextDisabled("%s", content.scale_note.c_str());
}

void Panel::show_scale_choice(const PanelContent& content) {
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0f);
  const bool open = ImGui::BeginCombo("##scale", scale_text(content.scale_setting, content.scale).c_str());
  remember_widget("scale");
  if (!open) return;
  if (ImGui::Selectable("auto", content.scale_setting == 0.0)) content.set_scale(0.0);
  remember_widget("scale auto");
  for (const double step : content.scale_steps) {
    const std::string name = scale_text(step, step);
    if (ImGui::Selectable(name.c_str(), content.scale_setting == step)) content.set_scale(step);
    remember_widget("scale " + name);
  }
  end_list();
}

void Panel::show_knobs(const PanelContent& content) {
  if (!ImGui::CollapsingHeader("Knobs", ImGuiTreeNodeFlags_DefaultOpen)) return;
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputTextWithHint("##search", "search", &search_);
  remember_widget("search");
  const std::vector<KnobGroup> groups = knob_groups(content.knobs, search_);
  for (const KnobGroup& group : groups)
    if (begin_knob_group(group)) show_knob_group(content, group);
  if (groups.empty()) ImGui::TextDisabled("no knob has this in its name or meaning");
}

/// The line above a module's knobs. Returns whether they are shown: if the user has opened the group, or searches.
bool Panel::begin_knob_group(const KnobGroup& group) {
  if (!search_.empty()) {
    ImGui::TextDisabled("%s", group.module.c_str());
    return true;
  }
  std::string label = group.module + "  (" + std::to_string(group.knobs.size());
  if (group.changed > 0) label += ", " + std::to_string(group.changed) + " changed";
  label += ")###knobs " + group.module;
  const bool open =
      ImGui::TreeNodeEx(label.c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_SpanAvailWidth);
  remember_widget("knobs " + group.module);
  return open;
}

/// All groups are one table to ImGui, so their columns have the same widths.
void Panel::show_knob_group(const PanelContent& content, const KnobGroup& group) {
  if (!ImGui::BeginTable("knobs", 3, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("name");
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("reset");
  for (const Knob* knob : group.knobs) {
    ImGui::PushID(knob->name.c_str());
    show_knob(content, *knob);
    ImGui::PopID();
  }
  ImGui::EndTable();
}

void Panel::show_knob(const PanelContent& content, const Knob& knob) {
  KnobRegistry& knobs = content.knobs;
  const PanelBudgetKnob* budgeted = content.budgets != nullptr ? content.budgets->find(knob.name) : nullptr;
  const std::string tooltip = knob_tooltip(knob) + budget_note(budgeted);
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  show_text(knob.name);
  show_tooltip(tooltip);
  if (budgeted != nullptr) {
    ImGui::SameLine();
    ImGui::TextDisabled(budgeted->locked ? "locked" : "budget");
  }
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-1.0f);
  show_knob_value(knobs, knob);
  show_tooltip(tooltip);
  ImGui::TableNextColumn();
  ImGui::BeginDisabled(is_default(knobs, knob));
  if (ImGui::Button("reset")) reset_knob(knobs, knob);
  ImGui::EndDisabled();
  remember_widget(knob.name + " reset");
}

void Panel::show_knob_value(KnobRegistry& knobs, const Knob& knob) {
  const double value = knob_value(knobs, knob);
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp | (spans_magnitudes(knob) ? ImGuiSliderFlags_Logarithmic : 0);
  const std::string format = slider_format(knob);
  switch (widget_of(knob)) {
    case KnobWidget::combo: {
      const bool open = ImGui::BeginCombo("##value", value_text(knob, value).c_str());
      remember_widget(knob.name);
      if (!open) break;
      for (std::size_t i = 0; i < knob.choices.size(); ++i) {
        const auto index = static_cast<double>(i);
        if (ImGui::Selectable(knob.choices[i].c_str(), value == index)) set_knob_value(knobs, knob, index);
        remember_widget(knob.name + " " + knob.choices[i]);
      }
      end_list();
      break;
    }
    case KnobWidget::integer_slider: {
      auto number = static_cast<ImS64>(value);
      const auto min = static_cast<ImS64>(knob.min);
      const auto max = static_cast<ImS64>(knob.max);
      if (ImGui::SliderScalar("##value", ImGuiDataType_S64, &number, &min, &max, format.c_str(), flags))
        set_knob_value(knobs, knob, static_cast<double>(number));
      remember_widget(knob.name);
      break;
    }
    case KnobWidget::number_slider: {
      double number = value;
      if (ImGui::SliderScalar("##value", ImGuiDataType_Double, &number, &knob.min, &knob.max, format.c_str(), flags))
        set_knob_value(knobs, knob, number);
      remember_widget(knob.name);
      break;
    }
  }
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel.h"

#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <string_view>

#include "engine/core/assert.h"

namespace gloam {
namespace {

constexpr float kFontPixels = 13.0f;  // size for which ImGui's default font is designed
constexpr float kMargin = 10.0f;
constexpr float kWidth = 460.0f;
constexpr double kShortestFrame = 1e-6;  // seconds; above 0 because ImGui divides by the frame time

struct KeyPair {
  ImGuiKey_ imgui;
  EditKey key;
};
constexpr KeyPair kKeys[] = {
    {ImGuiKey_Tab, EditKey::tab},
    {ImGuiKey_LeftArrow, EditKey::left},
    {ImGuiKey_RightArrow, EditKey::right},
    {ImGuiKey_UpArrow, EditKey::up},
    {ImGuiKey_DownArrow, EditKey::down},
    {ImGuiKey_PageUp, EditKey::page_up},
    {ImGuiKey_PageDown, EditKey::page_down},
    {ImGuiKey_Home, EditKey::home},
    {ImGuiKey_End, EditKey::end},
    {ImGuiKey_Insert, EditKey::insert},
    {ImGuiKey_Delete, EditKey::erase},
    {ImGuiKey_Backspace, EditKey::backspace},
    {ImGuiKey_Space, EditKey::space},
    {ImGuiKey_Enter, EditKey::enter},
    {ImGuiKey_Escape, EditKey::escape},
    {ImGuiKey_KeyPadEnter, EditKey::keypad_enter},
    {ImGuiKey_A, EditKey::a},
    {ImGuiKey_C, EditKey::c},
    {ImGuiKey_V, EditKey::v},
    {ImGuiKey_X, EditKey::x},
    {ImGuiKey_Y, EditKey::y},
    {ImGuiKey_Z, EditKey::z},
};
static_assert(std::size(kKeys) == kEditKeyCount);

void feed(ImGuiIO& io, const PanelInput& input, const PanelFrame& frame) {
  io.DisplaySize = ImVec2(static_cast<float>(frame.width), static_cast<float>(frame.height));
  io.DeltaTime = static_cast<float>(std::max(frame.dt_s, kShortestFrame));
  io.MousePos = ImVec2(static_cast<float>(input.mouse_x), static_cast<float>(input.mouse_y));
  for (std::size_t i = 0; i < input.buttons.size(); ++i) io.MouseDown[i] = input.buttons[i];
  io.MouseWheel = static_cast<float>(input.wheel);
  io.KeyCtrl = input.control;
  io.KeyShift = input.shift;
  io.KeyAlt = input.alt;
  for (std::size_t i = 0; i < kEditKeyCount; ++i) io.KeysDown[i] = input.keys[i];
  for (const char32_t c : input.text) io.AddInputCharacter(c);
}

void show_text(const std::string& text) { ImGui::TextUnformatted(text.data(), text.data() + text.size()); }

void show_tooltip(const std::string& text) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 35.0f);
  show_text(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

std::string stem_of(const std::string& visualizer) { return visualizer.substr(0, visualizer.find(':')); }

constexpr ImGuiTableFlags kTableFlags =
    ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingFixedFit;

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

void show_modules(std::span<const ModuleState> modules) {
  if (!ImGui::CollapsingHeader("Modules", ImGuiTreeNodeFlags_DefaultOpen)) return;
  if (!ImGui::BeginTable("modules", 4, kTableFlags)) return;
  ImGui::TableSetupColumn("module");
  ImGui::TableSetupColumn("runs");
  ImGui::TableSetupColumn("MiB");
  ImGui::TableSetupColumn("because", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableHeadersRow();
  for (const ModuleState& module : modules) {
    const bool runs = module.demanded && module.built;
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

}  // namespace

Panel::Panel(double scale) : context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  const float size = static_cast<float>(scale);
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 4.0f;
  style.FrameRounding = 2.0f;
  style.Colors[ImGuiCol_WindowBg].w = 0.9f;
  style.ScaleAllSizes(size);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // write no files into the user's folder
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  for (const KeyPair& pair : kKeys) io.KeyMap[pair.imgui] = static_cast<int>(pair.key);
  ImFontConfig font;
  font.SizePixels = kFontPixels * size;
  io.Fonts->AddFontDefault(&font);
  unsigned char* texels = nullptr;
  int width = 0;
  int height = 0;
  io.Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
}

Panel::~Panel() { ImGui::DestroyContext(context_); }

FontTexels Panel::font() const {
  ImGui::SetCurrentContext(context_);
  unsigned char* texels = nullptr;
  int width = 0;
  int height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
  const std::span all(texels, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), std::as_bytes(all)};
}

bool Panel::wants_mouse() const {
  ImGui::SetCurrentContext(context_);
  return ImGui::GetIO().WantCaptureMouse;
}

bool Panel::wants_keyboard() const {
  ImGui::SetCurrentContext(context_);
  return ImGui::GetIO().WantCaptureKeyboard || ImGui::GetIO().WantTextInput;
}

const ImDrawData& Panel::draw_data() const {
  ImGui::SetCurrentContext(context_);
  const ImDrawData* data = ImGui::GetDrawData();
  GLOAM_ASSERT(data != nullptr, "a panel has draw data from its first update on");
  return *data;
}

void Panel::update(const PanelInput& input, const PanelFrame& frame, const PanelContent& content) {
  ImGui::SetCurrentContext(context_);
  widgets_.clear();
  feed(ImGui::GetIO(), input, frame);
  ImGui::NewFrame();
  const float scale = ImGui::GetFontSize() / kFontPixels;
  const float width = std::min(kWidth * scale, static_cast<float>(frame.width) - 2.0f * kMargin);
  ImGui::SetNextWindowPos(ImVec2(kMargin, kMargin), ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize(ImVec2(width, static_cast<float>(frame.height) - 2.0f * kMargin), ImGuiCond_FirstUseEver);
  if (ImGui::Begin("gloam")) {
    show_times(content.times);
    show_views(content);
    show_knobs(content.knobs);
    show_passes(content.times);
    show_modules(content.modules);
  }
  ImGui::End();
  ImGui::Render();
}

void Panel::remember_widget(const std::string& name) {
  const ImVec2 from = ImGui::GetItemRectMin();
  const ImVec2 to = ImGui::GetItemRectMax();
  widgets_.push_back({name, from.x, from.y, to.x, to.y});
}

void Panel::show_times(const FrameTimes& times) {
  ImGui::Text("frame %.2f ms   CPU %.2f ms   GPU %.2f ms", times.frame_ms(), times.cpu_ms(), times.gpu_ms());
  show_tooltip("medians of the last " + std::to_string(FrameTimes::kFrames) +
               " frames. CPU: systems, declaration and recording, with what they waited for. GPU: all passes.");
}

void Panel::show_views(const PanelContent& content) {
  if (!ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const std::string current = asked_.empty() ? stem_of(content.visualizer) : asked_;
  const VisualizerInfo* shown = nullptr;
  for (const VisualizerInfo& info : content.visualizers)
    if (info.name == current) shown = &info;
  ImGui::SetNextItemWidth(-1.0f);
  const bool open = ImGui::BeginCombo("##view", current.c_str(), ImGuiComboFlags_HeightLarge);
  remember_widget("view");
  if (open) {
    for (const VisualizerInfo& info : content.visualizers) {
      const std::string label = info.name + (info.built ? "" : " (not built yet)");
      const bool chosen =
          ImGui::Selectable(label.c_str(), info.name == current, info.built ? 0 : ImGuiSelectableFlags_Disabled);
      remember_widget("view " + info.name);
      show_tooltip(info.legend);
      if (!chosen) continue;
      fault_.clear();
      asked_ = info.argument.empty() ? "" : info.name;
      if (!info.argument.empty()) continue;
      if (const Status status = content.show(info.name); !status.ok()) fault_ = status.error().message;
    }
    ImGui::EndCombo();
  }
  if (shown != nullptr && !shown->argument.empty()) show_view_argument(content, *shown);
  if (!fault_.empty()) ImGui::TextWrapped("%s", fault_.c_str());
  if (shown != nullptr) ImGui::TextWrapped("%s", shown->legend.c_str());
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

void Panel::show_knobs(KnobRegistry& knobs) {
  if (!ImGui::CollapsingHeader("Knobs", ImGuiTreeNodeFlags_DefaultOpen)) return;
  if (!ImGui::BeginTable("knobs", 3, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("name");
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("reset");
  for (const Knob& knob : knobs.knobs()) {
    ImGui::PushID(knob.name.c_str());
    show_knob(knobs, knob);
    ImGui::PopID();
  }
  ImGui::EndTable();
}

void Panel::show_knob(KnobRegistry& knobs, const Knob& knob) {
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  show_text(knob.name);
  show_tooltip(knob_tooltip(knob));
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-1.0f);
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
      ImGui::EndCombo();
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
  show_tooltip(knob_tooltip(knob));
  ImGui::TableNextColumn();
  ImGui::BeginDisabled(is_default(knobs, knob));
  if (ImGui::Button("reset")) reset_knob(knobs, knob);
  ImGui::EndDisabled();
  remember_widget(knob.name + " reset");
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/gui.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <iterator>

#include "engine/core/assert.h"

namespace gloam {
namespace {

constexpr float kFontPixels = 13.0f;     // size for which ImGui's default font is designed
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

}  // namespace

Gui::Gui(double scale) : context_(ImGui::CreateContext()), scale_(static_cast<float>(scale)) {
  ImGui::SetCurrentContext(context_);
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 4.0f;
  style.FrameRounding = 2.0f;
  style.Colors[ImGuiCol_WindowBg].w = 0.9f;
  style.ScaleAllSizes(scale_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // write no files into the user's folder
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  for (const KeyPair& pair : kKeys) io.KeyMap[pair.imgui] = static_cast<int>(pair.key);
  ImFontConfig font;
  font.SizePixels = kFontPixels * scale_;
  io.Fonts->AddFontDefault(&font);
  unsigned char* texels = nullptr;
  int width = 0;
  int height = 0;
  io.Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
}

Gui::~Gui() { ImGui::DestroyContext(context_); }

void Gui::begin(const PanelInput& input, const PanelFrame& frame) {
  ImGui::SetCurrentContext(context_);
  feed(ImGui::GetIO(), input, frame);
  ImGui::NewFrame();
}

void Gui::end() {
  ImGui::SetCurrentContext(context_);
  ImGui::Render();
}

FontTexels Gui::font() const {
  ImGui::SetCurrentContext(context_);
  unsigned char* texels = nullptr;
  int width = 0;
  int height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
  const std::span all(texels, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), std::as_bytes(all)};
}

bool Gui::wants_mouse() const {
  ImGui::SetCurrentContext(context_);
  return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::wants_keyboard() const {
  ImGui::SetCurrentContext(context_);
  return ImGui::GetIO().WantCaptureKeyboard || ImGui::GetIO().WantTextInput;
}

bool Gui::is_busy() const {
  ImGui::SetCurrentContext(context_);
  return ImGui::IsAnyItemActive() ||
         ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

const ImDrawData& Gui::draw_data() const {
  ImGui::SetCurrentContext(context_);
  const ImDrawData* data = ImGui::GetDrawData();
  GLOAM_ASSERT(data != nullptr, "there is draw data from the first frame on");
  return *data;
}

void end_list() {
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  ImGui::EndCombo();
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/light_panel.h"

#include <utility>

#include "sandbox/output/file_io.h"
#include "sandbox/play/input/light_shares.h"
#include "sandbox/play/input/view_projection.h"

namespace gloam {

void LightPanel::fill(PanelScene& scene, const ViewSettings& view) {
  constexpr const char* kKinds[] = {"point", "spot", "directional"};
  shown_.clear();
  for (const ControlledLight& light : controls_.lights()) {
    const LightValues& values = light.values;
    const std::size_t index = shown_.size();
    shown_.push_back({.name = light.name,
                      .kind = kKinds[static_cast<int>(light.kind)],
                      .unit = light.kind == LightKind::directional ? "lx" : "cd",
                      .intensity = values.intensity,
                      .color = values.color,
                      .range_m = values.range_m,
                      .width_m = values.width_m,
                      .shadows = values.shadows,
                      .has_cookie = light.cookie != 0,
                      .cookie = values.cookie,
                      .muted = values.muted,
                      .solo = values.solo,
                      .share = index < shares_.size() ? shares_[index] : -1.0});
  }
  scene.lights = shown_;
  scene.set_light = [this](std::size_t light, const PanelLight& values) { set(light, values); };
  scene.select = [this](std::size_t light) { selected_ = light; };
  scene.measure_shares = [this, id = view.id] { measure_shares(id); };
}

void LightPanel::set(std::size_t light, const PanelLight& shown) {
  LightValues values = controls_.lights()[light].values;
  values.intensity = shown.intensity;
  values.color = shown.color;
  values.range_m = shown.range_m;
  values.width_m = shown.width_m;
  values.shadows = shown.shadows;
  values.cookie = shown.cookie;
  values.muted = shown.muted;
  values.solo = shown.solo;
  controls_.set(light, values);
}

void LightPanel::measure_shares(ViewId view) {
  shares_.clear();
  const auto measured = light_shares(session_, view);
  if (!measured.ok()) return;  // no frame was drawn yet
  for (const ControlledLight& light : controls_.lights()) {
    const auto found = measured->find(light.entity);
    shares_.push_back(found == measured->end() ? 0.0 : found->second);
  }
}

bool LightPanel::steer(const WindowInput& input, const ViewSettings& view, bool pointer_is_free) {
  return gizmo_.steer(controls_, selected_, view, {input.pointer_x, input.pointer_y}, input.panel.buttons[0],
                      pointer_is_free);
}

std::vector<PanelMark> LightPanel::marks(const ViewSettings& view) const {
  std::vector<PanelMark> marks = gizmo_.marks(controls_, selected_, view);
  for (std::size_t i = 0; i < controls_.lights().size(); ++i) {
    const ControlledLight& light = controls_.lights()[i];
    if (!light.values.solo || i == selected_ || light.kind == LightKind::directional) continue;
    if (const auto place = place_in_picture(view, controls_.position(i)))
      marks.push_back(
          {.shape = PanelMark::Shape::circle, .from = *place, .color = {255, 220, 120}, .label = light.name});
  }
  return marks;
}

std::string LightPanel::save(const std::string& path) {
  LightPatch patch = controls_.patch();
  Status written = make_folder_of(path);
  if (written.ok()) written = write_file(path, light_patch_text(patch));
  if (!written.ok()) return written.error().message;
  saved_ = std::move(patch);
  return "wrote " + path;
}

}  // namespace gloam

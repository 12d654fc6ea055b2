// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/light_controls.h"

#include <algorithm>

#include "engine/ecs/view.h"
#include "engine/scene/resources.h"

namespace gloam {

LightControls::LightControls(World& world) : world_(world) {
  const auto& names = world.resource<SceneNames>();
  world.view<const Light>().each([&](Entity entity, const Light& light) {
    lights_.push_back({.entity = entity,
                       .name = std::string(names.name_of(entity)),
                       .kind = light.kind,
                       .intensity = light.intensity});
  });
  std::ranges::stable_sort(lights_, {}, &ControlledLight::name);
}

void LightControls::set_intensity(std::size_t light, float intensity) {
  lights_[light].intensity = std::max(intensity, 0.0f);
  apply();
}

void LightControls::mute(std::size_t light, bool muted) {
  lights_[light].muted = muted;
  apply();
}

void LightControls::solo(std::size_t light, bool solo) {
  lights_[light].solo = solo;
  apply();
}

void LightControls::apply() {
  const bool any_solo = std::ranges::any_of(lights_, &ControlledLight::solo);
  for (const ControlledLight& controlled : lights_) {
    if (!world_.alive(controlled.entity) || !world_.has<Light>(controlled.entity)) continue;
    const bool shines = !controlled.muted && (!any_solo || controlled.solo);
    Light& light = world_.get<Light>(controlled.entity);
    const float intensity = shines ? controlled.intensity : 0.0f;
    if (light.intensity == intensity) continue;
    light.intensity = intensity;
    world_.mark_changed<Light>(controlled.entity);
  }
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/light_controls.h"

#include <algorithm>
#include <string_view>

#include "engine/ecs/view.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "light 2" comes before "light 10": digits are compared as numbers.
bool in_natural_order(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (!is_digit(a.front()) || !is_digit(b.front())) {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
      continue;
    }
    const auto take_number = [](std::string_view& text) {
      const auto end = std::ranges::find_if_not(text, is_digit) - text.begin();
      std::string_view digits = text.substr(0, static_cast<std::size_t>(end));
      text.remove_prefix(digits.size());
      digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
      return digits;
    };
    const std::string_view first = take_number(a), second = take_number(b);
    if (first.size() != second.size()) return first.size() < second.size();
    if (first != second) return first < second;
  }
  return a.size() < b.size();
}

}  // namespace

LightControls::LightControls(World& world) : world_(world) {
  const auto& names = world.resource<SceneNames>();
  world.view<const Light>().each([&](Entity entity, const Light& light) {
    lights_.push_back({.entity = entity,
                       .name = std::string(names.name_of(entity)),
                       .kind = light.kind,
                       .intensity = light.intensity});
  });
  std::ranges::stable_sort(lights_, in_natural_order, &ControlledLight::name);
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

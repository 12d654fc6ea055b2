// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/light_controls.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/shadows/components.h"
#include "sandbox/scenes/construction/scene_builder.h"

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
  const World& scene = world;
  scene.view<const Light>().each([&](Entity entity, const Light& light) {
    const auto* caster = scene.try_get<ShadowCaster>(entity);
    LightValues values = {.intensity = light.intensity,
                          .color = light.color,
                          .range_m = light.range_m,
                          .width_m = light.width_m,
                          .shadows = caster == nullptr || caster->enabled,
                          .cookie = light.cookie != 0};
    const auto* pose = scene.try_get<LocalTransform>(entity);
    if (pose != nullptr) {
      values.translation = pose->translation;
      values.rotation = pose->rotation;
    }
    lights_.push_back({.entity = entity,
                       .name = std::string(names.name_of(entity)),
                       .kind = light.kind,
                       .cookie = light.cookie,
                       .movable = pose != nullptr && !scene.has<LocalMatrix>(entity),
                       .values = values,
                       .scene_values = values});
  });
  std::ranges::stable_sort(lights_, in_natural_order, &ControlledLight::name);
}

void LightControls::set(std::size_t light, const LightValues& values) {
  ControlledLight& own = lights_[light];
  const bool moved = values.translation != own.values.translation || values.rotation != own.values.rotation;
  const bool shadows_changed = values.shadows != own.values.shadows;
  own.values = values;
  own.values.intensity = std::max(values.intensity, 0.0f);
  if (!world_.alive(own.entity) || !world_.has<Light>(own.entity)) return;
  if (shadows_changed) {
    ShadowCaster caster;
    if (const auto* old = std::as_const(world_).try_get<ShadowCaster>(own.entity)) caster = *old;
    caster.enabled = values.shadows;
    world_.add<ShadowCaster>(own.entity, caster);
  }
  if (moved && own.movable) {
    auto& pose = world_.get<LocalTransform>(own.entity);
    pose.translation = values.translation;
    pose.rotation = values.rotation;
    world_.mark_changed<LocalTransform>(own.entity);
  }
  const bool any_solo = std::ranges::any_of(lights_, [](const ControlledLight& one) { return one.values.solo; });
  for (const ControlledLight& one : lights_) apply(one, any_solo);
}

void LightControls::apply(const ControlledLight& controlled, bool any_solo) {
  if (!world_.alive(controlled.entity) || !world_.has<Light>(controlled.entity)) return;
  const LightValues& values = controlled.values;
  const bool shines = !values.muted && (!any_solo || values.solo);
  Light& light = world_.get<Light>(controlled.entity);
  Light wanted = light;
  wanted.intensity = shines ? values.intensity : 0.0f;
  wanted.color = values.color;
  wanted.range_m = values.range_m;
  wanted.width_m = values.width_m;
  wanted.cookie = values.cookie ? controlled.cookie : 0;
  if (light.intensity == wanted.intensity && light.color == wanted.color && light.range_m == wanted.range_m &&
      light.width_m == wanted.width_m && light.cookie == wanted.cookie)
    return;
  light = wanted;
  world_.mark_changed<Light>(controlled.entity);
}

dvec3 LightControls::position(std::size_t light) const {
  const auto* pose = std::as_const(world_).try_get<WorldTransform>(lights_[light].entity);
  return pose == nullptr ? dvec3(0.0) : dvec3(pose->matrix[3]);
}

dvec3 LightControls::direction(std::size_t light) const {
  const auto* pose = std::as_const(world_).try_get<WorldTransform>(lights_[light].entity);
  return dvec3(light_direction(pose == nullptr ? dvec3(0.0, 0.0, 1.0) : dvec3(pose->matrix[2])));
}

dmat4 LightControls::world_from_parent(const ControlledLight& light) const {
  const auto* parent = std::as_const(world_).try_get<Parent>(light.entity);
  const auto* pose = parent == nullptr ? nullptr : std::as_const(world_).try_get<WorldTransform>(parent->entity);
  return pose == nullptr ? dmat4(1.0) : pose->matrix;
}

void LightControls::move(std::size_t light, const dvec3& position) {
  if (!lights_[light].movable) return;
  LightValues values = lights_[light].values;
  values.translation = dvec3(glm::inverse(world_from_parent(lights_[light])) * dvec4(position, 1.0));
  set(light, values);
}

void LightControls::aim(std::size_t light, const dvec3& direction) {
  if (!lights_[light].movable) return;
  LightValues values = lights_[light].values;
  const dvec3 local = dvec3(glm::inverse(world_from_parent(lights_[light])) * dvec4(direction, 0.0));
  values.rotation = rotation_towards(glm::normalize(local));
  set(light, values);
}

LightPatch LightControls::patch() const {
  LightPatch patch;
  for (const ControlledLight& light : lights_) {
    if (light.name.empty()) continue;
    const LightValues &now = light.values, &old = light.scene_values;
    LightChange change;
    if (now.intensity != old.intensity) change.intensity = now.intensity;
    if (now.color != old.color) change.color = now.color;
    if (now.range_m != old.range_m) change.range_m = now.range_m;
    if (now.width_m != old.width_m) change.width_m = now.width_m;
    if (now.muted) change.on = false;
    if (now.shadows != old.shadows) change.shadows = now.shadows;
    if (now.cookie != old.cookie) change.cookie = now.cookie;
    if (now.translation != old.translation) change.translation = now.translation;
    if (now.rotation != old.rotation) change.rotation = now.rotation;
    if (!(change == LightChange())) patch.lights[light.name] = change;
  }
  return patch;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/panel_settings.h"

#include <string>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "engine/scene/resources.h"
#include "modules/depth_of_field/components.h"

namespace gloam {
namespace {

constexpr const char* kKnob = "knob ";
constexpr const char* kLight = "light ";
constexpr const char* kExposure = "exposure";
constexpr const char* kLens = "lens";

using Numbers = std::vector<double>;

Numbers numbers_of(const LightValues& v) {
  return {v.intensity,
          v.color.r,
          v.color.g,
          v.color.b,
          v.range_m,
          v.width_m,
          v.shadows ? 1.0 : 0.0,
          v.cookie ? 1.0 : 0.0,
          v.muted ? 1.0 : 0.0,
          v.solo ? 1.0 : 0.0,
          v.translation.x,
          v.translation.y,
          v.translation.z,
          v.rotation.w,
          v.rotation.x,
          v.rotation.y,
          v.rotation.z};
}

LightValues light_of(const Numbers& n) {
  const auto real = [&](std::size_t at) { return static_cast<float>(n[at]); };
  return {.intensity = real(0),
          .color = {real(1), real(2), real(3)},
          .range_m = real(4),
          .width_m = real(5),
          .shadows = n[6] != 0.0,
          .cookie = n[7] != 0.0,
          .muted = n[8] != 0.0,
          .solo = n[9] != 0.0,
          .translation = {n[10], n[11], n[12]},
          .rotation = dquat(n[13], n[14], n[15], n[16])};
}

}  // namespace

Settings panel_settings(const Session& session, const LightControls& lights) {
  Settings settings;
  const KnobRegistry& knobs = session.renderer->knobs();
  for (const Knob& knob : knobs.knobs()) settings[kKnob + knob.name] = knobs.text(knob);
  for (std::size_t i = 0; i < lights.lights().size(); ++i)
    settings[kLight + std::to_string(i)] = numbers_of(lights.lights()[i].values);
  const auto& environment = session.world.resource<SceneEnvironment>();
  settings[kExposure] = Numbers{environment.has_exposure ? 1.0 : 0.0, environment.exposure_ev100};
  const auto* lens = session.world.try_get<DepthOfField>(session.camera);
  settings[kLens] = lens == nullptr ? Numbers{0.0, DepthOfField{}.f_number} : Numbers{lens->focus_m, lens->f_number};
  return settings;
}

void set_panel_settings(Session& session, LightControls& lights, const Settings& settings) {
  for (const auto& [name, value] : settings) {
    if (name.starts_with(kKnob)) {
      const Status set =
          session.renderer->knobs().set(name.substr(std::string(kKnob).size()), std::get<std::string>(value));
      GLOAM_ASSERT(set.ok(), "a knob takes a value that it had");
      continue;
    }
    const Numbers& numbers = std::get<Numbers>(value);
    if (name.starts_with(kLight)) {
      lights.set(std::stoul(name.substr(std::string(kLight).size())), light_of(numbers));
    } else if (name == kExposure) {
      auto& environment = session.world.resource<SceneEnvironment>();
      environment.has_exposure = numbers[0] != 0.0;
      environment.exposure_ev100 = static_cast<float>(numbers[1]);
    } else if (name == kLens && session.world.alive(session.camera)) {
      DepthOfField lens;
      if (const auto* old = std::as_const(session.world).try_get<DepthOfField>(session.camera)) lens = *old;
      lens.focus_m = static_cast<float>(numbers[0]);
      lens.f_number = static_cast<float>(numbers[1]);
      session.world.add<DepthOfField>(session.camera, lens);
    }
  }
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/default_light.h"

#include <cmath>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "sandbox/scenes/construction/scene_builder.h"

namespace gloam {
namespace {

constexpr float kExposureEv100 = 11.7f;

bool is_black(const vec3& color) { return color.x <= 0.0f && color.y <= 0.0f && color.z <= 0.0f; }

bool has_light(const World& world, const SceneEnvironment& environment) {
  if (environment.has_sky) return true;  // also of zero: the file asks for a black sky
  if (!is_black(environment.sky_zenith) || !is_black(environment.sky_horizon) || !is_black(environment.sky_ground))
    return true;
  bool found = false;
  world.view<const Light>().each([&](const Light&) { found = true; });
  return found;
}

}  // namespace

bool add_default_light(World& world, SceneInfo& info) {
  auto& environment = world.resource<SceneEnvironment>();
  bool draws = false;
  world.view<const MeshInstance>().each([&](const MeshInstance&) { draws = true; });
  if (!draws || has_light(world, environment)) return false;
  Light sun;
  sun.kind = LightKind::directional;
  sun.color = vec3(1.0f, 0.84f, 0.66f);
  sun.intensity = 9000.0f;
  sun.apparent_angle = 0.03f;  // the edges of shadows are soft, as under thin haze
  const Entity entity = SceneBuilder(world, info).add_light("default sun", sun, {}, {-0.85, -0.6, -0.35}, true);
  environment.sky_zenith = vec3(330.0f, 480.0f, 820.0f);
  environment.sky_horizon = vec3(1050.0f, 980.0f, 980.0f);
  environment.sky_ground = vec3(240.0f, 215.0f, 195.0f);
  if (!environment.has_exposure) {
    environment.exposure_ev100 = kExposureEv100;
    const float white = 1.2f * std::exp2(kExposureEv100);  // cd/m² that the exposure maps to 1
    for (Material& material : world.resource<SceneAssets>().materials) material.emissive *= white;
  }
  environment.has_exposure = true;
  world.set_resource(DefaultLight{entity});
  return true;
}

}  // namespace gloam

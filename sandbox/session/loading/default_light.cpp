// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/default_light.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/session/loading/model_brightness.h"

namespace gloam {
namespace {

// The exposure of a model that reflects kMiddleReflectance of the light. Brighter and darker models shift it, but not
// by as much as they differ, so that white looks brighter than black; and the sky behind the model stays within the
// curve.
constexpr double kExposureEv100 = 11.7;
constexpr double kMiddleReflectance = 0.3;
constexpr double kFollows = 0.65;
constexpr double kMostDown = -2.0;
constexpr double kMostUp = 0.5;

float exposure_of_model(const World& world) {
  const std::optional<double> reflectance = mean_reflectance(world);
  if (!reflectance) return static_cast<float>(kExposureEv100);
  const double shift = kFollows * std::log2(std::max(*reflectance, 1e-6) / kMiddleReflectance);
  return static_cast<float>(kExposureEv100 + std::clamp(shift, kMostDown, kMostUp));
}

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
    environment.exposure_ev100 = exposure_of_model(world);
    const float white = 1.2f * std::exp2(environment.exposure_ev100);  // cd/m² that the exposure maps to 1
    for (Material& material : world.resource<SceneAssets>().materials) material.emissive *= white;
  }
  environment.has_exposure = true;
  world.set_resource(DefaultLight{entity});
  return true;
}

}  // namespace gloam

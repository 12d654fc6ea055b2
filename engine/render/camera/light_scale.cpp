// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/camera/light_scale.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/assets.h"

namespace gloam {
namespace {

constexpr double kMostUnscaled = 49152.0;      // cd/m² that need no scale
constexpr double kLeastScaled = 16.0;          // scaled light; less needs another scale
constexpr double kMostEmittedShare = 65536.0;  // emission as a multiple of the light of surfaces

/// Greatest channel that is a number; NaN and infinity count as 0.
double strongest(const vec3& light) {
  double most = 0.0;
  for (int channel = 0; channel < 3; ++channel)
    if (std::isfinite(light[channel])) most = std::max(most, static_cast<double>(light[channel]));
  return most;
}

}  // namespace

bool has_stated_exposure(const World& world) {
  return world.resource<SceneEnvironment>().has_exposure && world.try_resource<MeteredInEveryFrame>() == nullptr;
}

float light_scale(const SceneEnvironment& environment) {
  if (!environment.has_exposure || !std::isfinite(environment.exposure_ev100)) return 1.0f;
  constexpr int kFirst = -2, kLast = 7;  // floor(log2(white)) that needs no scale
  const int white = static_cast<int>(std::floor(environment.exposure_ev100 + std::log2(1.2f)));
  return std::ldexp(1.0f, std::clamp(std::clamp(white, kFirst, kLast) - white, -100, 100));
}

SceneBrightness scene_brightness(const World& world) {
  SceneBrightness brightness;
  const auto& sky = world.resource<SceneEnvironment>();
  for (const vec3& light : {sky.sky_zenith, sky.sky_horizon, sky.sky_ground})
    brightness.lit = std::max(brightness.lit, strongest(light));
  if (const auto* sources = world.try_resource<BrightnessSources>())
    for (const auto& [module, lit] : sources->lit) brightness.lit = std::max(brightness.lit, lit(world));
  for (const Material& material : world.resource<SceneAssets>().materials)
    brightness.emitted = std::max(brightness.emitted, strongest(material.emissive));
  return brightness;
}

float light_scale(const SceneBrightness& brightness, float before) {
  double most = brightness.emitted;
  if (brightness.lit > 0.0) most = std::min(most, kMostEmittedShare * std::max(brightness.lit, 1.0));
  most = std::max(most, brightness.lit);
  if (!std::isfinite(most)) return 1.0f;
  const double scaled = most * static_cast<double>(before);
  if (before < 1.0f && scaled >= kLeastScaled && scaled <= kMostUnscaled) return before;
  if (most <= kMostUnscaled) return 1.0f;
  // In steps of four powers of two, to 2⁸…2¹².
  constexpr int kStep = 4, kTarget = 12;
  const int exponent = static_cast<int>(std::floor(std::log2(most))) + 1;
  const int steps = (exponent - kTarget + kStep - 1) / kStep;
  return std::ldexp(1.0f, std::max(-kStep * steps, -100));
}

}  // namespace gloam

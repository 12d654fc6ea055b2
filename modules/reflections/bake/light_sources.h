// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "modules/lights/components.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/culling/placed.h"

namespace gloam {

/// A light of the world and where it shines from.
struct LightSource {
  Entity entity = kNoEntity;
  Light light;
  dvec3 position = dvec3(0.0);
  dvec3 direction = dvec3(0.0, 0.0, -1.0);  ///< in which it shines, unit length

  /// Color · intensity: candela, directional: lux. 0 for a light that is not usable.
  [[nodiscard]] vec3 emitted() const;
};

/// All lights of the world, by entity index.
[[nodiscard]] std::vector<LightSource> light_sources(const World& world);

/// Illuminance (luminance-weighted, lux) of a surface at `point` that faces along `normal`, without shadows and
/// cookies. 0 if it is not finite.
[[nodiscard]] double illuminance(const LightSource& source, const dvec3& point, const dvec3& normal);

/// The lights that dim a proxy. names: of gloam.ibr_proxy.lights; if empty, all lights that reach any of 3 × 3 points
/// of its front. Each light's weight is its share of the illuminance; a named light that does not reach the proxy
/// counts as 1 % of it. Empty if no light is named and none reaches it. lights: light_sources(). `layer` is left at 0.
[[nodiscard]] Result<std::vector<CapturedProxyLight>> proxy_lights(const World& world, const PlacedProxy& proxy,
                                                                   std::string_view names,
                                                                   std::span<const LightSource> lights);

}  // namespace gloam

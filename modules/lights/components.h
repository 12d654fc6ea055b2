// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/math/types.h"

namespace gloam {

class SceneNames;

enum class LightKind : std::uint8_t { point, spot, directional };

/// A light at its entity's WorldTransform, shining along the node's −Z.
struct Light {
  LightKind kind = LightKind::point;
  vec3 color = vec3(1.0f);             ///< linear
  float intensity = 1.0f;              ///< candela; directional: lux
  float range_m = 0.0f;                ///< 0: where the light falls to 0.01 lx
  float inner_angle = 0.0f;            ///< spot: half angle of full strength, radians
  float outer_angle = 0.785398163f;    ///< spot: half angle where it ends, radians; beyond π/2 is taken for π/2
  float width_m = 0.0f;                ///< diameter of the emitter; 0: hard shadows
  float apparent_angle = 0.00925025f;  ///< directional: apparent diameter, radians
  std::uint32_t cookie = 0;            ///< spot: image file in SceneStrings, 0: none
};

/// Sphere around everything the entity's Light can light, in the world; kept by system light_bounds, which adds it. A
/// change tick marks where it has changed. When the Light is removed it stays as it was: whoever removes one removes
/// both.
struct LightBounds {
  dvec3 center = dvec3(0.0);
  float radius_m = 0.0f;  ///< 0 for directional lights and for those that give nothing
};

/// Distance in metres beyond which a light gives nothing: its range, or √(intensity / 0.01 lx); in 0.001…1e9 for any
/// light.
[[nodiscard]] float effective_range(const Light& light);

/// The lights a comma-separated list of names means. Input error when one is absent or two lights share it; the message
/// names `key`.
[[nodiscard]] Result<std::vector<Entity>> resolve_light_names(const SceneNames& scene, std::string_view names,
                                                              std::string_view key);
/// The same with the world's SceneNames.
[[nodiscard]] Result<std::vector<Entity>> resolve_light_names(const World& world, std::string_view names,
                                                              std::string_view key);

}  // namespace gloam

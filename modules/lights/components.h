// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/math/types.h"

namespace gloam {

enum class LightKind : std::uint8_t { point, spot, directional };

/// Lux on a white surface that no picture shows at the greatest automatic exposure, 300 (meter.comp.glsl): half of the
/// darkest step of 8 bits is 1.5 · 10⁻⁴, and 300 · 10⁻⁶ / π is less.
inline constexpr float kUnseenLux = 1e-6f;

/// A light placed by its entity's WorldTransform. It shines along the node's −Z.
struct Light {
  LightKind kind = LightKind::point;
  vec3 color = vec3(1.0f);             ///< linear RGB
  float intensity = 1.0f;              ///< candela; directional: lux
  float range_m = 0.0f;                ///< 0: as far as the light can be seen (effective_range)
  float inner_angle = 0.0f;            ///< spot: half angle of the cone with full intensity, radians
  float outer_angle = 0.785398163f;    ///< spot: half angle at which intensity reaches 0, radians; clamped to π/2
  float width_m = 0.0f;                ///< diameter of the emitter; 0: hard shadows
  float apparent_angle = 0.00925025f;  ///< directional: apparent diameter, radians
  std::uint32_t cookie = 0;            ///< spot: image file in SceneStrings, 0: none
  /// Illuminance at which a light without range_m ends. The system "light_reach" sets it to what the scene's exposure
  /// cannot show.
  float unseen_lux = kUnseenLux;
};

/// World-space sphere around everything the entity's Light can light. System light_bounds adds it and keeps it up to
/// date; its change tick marks the entities whose sphere changed. Removing the Light does not remove its LightBounds:
/// code that removes one must remove both.
struct LightBounds {
  dvec3 center = dvec3(0.0);
  float radius_m = 0.0f;  ///< 0 for directional lights and for lights that emit nothing
};

/// Distance in metres beyond which a light has no effect: range_m, or √(intensity / unseen_lux) if that is 0. Clamped
/// to 0.001…1e9 for every light, also with NaN.
[[nodiscard]] float effective_range(const Light& light);

/// The window by which a local light ends at its range, as KHR_lights_punctual recommends: 1 − (distance / range)⁴, at
/// least 0. squared_share: (distance / range)². In shaders: lights_api.glsl.
[[nodiscard]] inline double range_window(double squared_share) {
  return std::clamp(1.0 - squared_share * squared_share, 0.0, 1.0);
}

/// Scale and offset of a spot's falloff: intensity factor = clamp(c · scale + offset, 0, 1)², c the cosine of the angle
/// to the axis. (0, 1) for a point light.
[[nodiscard]] vec2 spot_ramp(const Light& light);

/// light_direction for a node whose squared length is too small or too large for a double. −Z if the node has no size
/// or is not finite.
[[nodiscard]] vec3 unusual_light_direction(const dvec3& node_z);

/// The direction in which a node's light shines. `node_z`: the third column of the node's matrix.
[[nodiscard]] inline vec3 light_direction(const dvec3& node_z) {
  const double squared = glm::dot(node_z, node_z);
  if (squared > 1e-200 && squared < 1e200) return vec3(node_z * (-1.0 / std::sqrt(squared)));
  return unusual_light_direction(node_z);
}

/// Side of a shadow tile in pixels. Each shadow tile has one light list.
inline constexpr std::uint32_t kShadowTile = 8;

}  // namespace gloam

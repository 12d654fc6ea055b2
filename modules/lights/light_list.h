// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/bounds.h"
#include "engine/render/view.h"
#include "modules/lights/components.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {

/// A light at its place in the world.
struct PlacedLight {
  Entity entity;
  Light light;
  dvec3 position = dvec3(0.0);
  vec3 direction = vec3(0.0f, 0.0f, -1.0f);  ///< where it shines, unit
};

/// Every light of the world, ordered by entity index; a resource of the world.
struct LightSet {
  std::vector<PlacedLight> lights;
};

/// The lights of one view, packed for the GPU; a view resource.
struct VisibleLights {
  shaders::LightBlock block{};
  std::vector<Entity> local_entities;        ///< of block.local, in its order
  std::vector<Entity> directional_entities;
  std::uint32_t total = 0;                   ///< lights of the world
  std::uint32_t dropped = 0;                 ///< visible, but beyond the capacity
};

/// Places one light. The matrix's scale does not change the light.
[[nodiscard]] PlacedLight place_light(Entity entity, const Light& light, const dmat4& world_from_node);

/// The smallest sphere around everything a local light can light, relative to `origin`.
[[nodiscard]] Sphere light_bounds(const PlacedLight& light, const dvec3& origin);

/// Strength of a spot at the angle whose cosine is c is clamp(c · scale + offset, 0, 1)²; (0, 1) for a point light.
[[nodiscard]] vec2 spot_ramp(const Light& light);

/// Chooses the lights whose bounds may touch the view's frustum. More than fit: those with the largest (solid angle × intensity) stay,
/// ties by place in `lights`. Lights that give nothing, or have NaN or infinity where no sense can be made of it, are left out. Local
/// lights come ordered by nearest view depth of their bounds, then by place in `lights` (which a LightSet orders by entity).
void select_lights(std::span<const PlacedLight> lights, const RenderView& view, VisibleLights& visible);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/bounds.h"
#include "engine/render/view.h"
#include "engine/scene/components.h"
#include "modules/lights/bins/z_bins.h"
#include "modules/lights/components.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/selection/light_table.h"
#include "modules/lights/selection/placed_light.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {

/// A stretch of lights of one archetype.
struct LightRows {
  std::span<const Entity> entities;
  std::span<const Light> lights;
  std::span<const WorldTransform> transforms;
  std::span<LightBounds> bounds;  ///< empty: they have none yet
  std::size_t first = 0;          ///< row number of the first
};

/// Every light of the world that has a place, ordered by entity index; a resource of the world, kept by system
/// light_bounds.
struct LightSet {
  std::vector<PlacedLight> lights;
  LightTable table;           ///< of `lights`, in their order
  std::uint64_t version = 1;  ///< another one whenever anything of this changed
  std::uint32_t updated = 0;  ///< lights that the last run found changed or new

  /// How the last run found them: rows of archetypes in the order of views. The chunks' spans have ended since.
  std::vector<LightRows> chunks;
  std::vector<Entity> rows;
  std::vector<std::uint32_t> slot_of_row;  ///< index into `lights`
};

/// Memory that choosing lights keeps from one frame to the next.
struct LightSelection {
  std::vector<float> x, y, z;            ///< camera-relative centre of each light of the world
  std::vector<float> nearest, farthest;  ///< view depths of each light of the world
  std::vector<std::uint32_t> kind;       ///< of each light of the world: 1 a visible local one, 2 a directional one
  std::vector<std::uint32_t> local, directional;  ///< indices of those that are visible
  std::vector<std::uint64_t> keys, sorted;
  std::vector<std::uint32_t> buckets;
};

/// The lights of one view, packed for the GPU; a view resource.
struct VisibleLights {
  shaders::LightBlock block{};
  std::vector<Entity> local_entities;  ///< of block.local, in its order
  std::vector<Entity> directional_entities;
  std::vector<LightDepth> depths;      ///< of block.local, in its order: what its bound covers, from the near plane on
  std::vector<MaskLight> mask_lights;  ///< of block.local, in its order
  std::uint32_t total = 0;             ///< lights of the world
  std::uint32_t dropped = 0;           ///< visible, but beyond the capacity
  std::uint64_t version = 0;           ///< another one whenever the lists were made anew

  std::uint64_t set_version = 0;  ///< LightSet::version they were made from
  RenderView view;                ///< that they were made for
  LightSelection selection;
};

/// Places one light. The matrix's scale does not change the light.
[[nodiscard]] PlacedLight place_light(Entity entity, const Light& light, const dmat4& world_from_node);

/// The smallest sphere around everything a local light can light, relative to `origin`.
[[nodiscard]] Sphere light_bounds(const PlacedLight& light, const dvec3& origin);

/// Strength of a spot at the angle whose cosine is c is clamp(c · scale + offset, 0, 1)²; (0, 1) for a point light.
[[nodiscard]] vec2 spot_ramp(const Light& light);

/// Chooses the lights whose bounds may touch the view's frustum. More than fit: those with the largest (solid angle ×
/// intensity) stay, ties by place in `lights`. Lights that give nothing, or have NaN or infinity where no sense can be
/// made of it, are left out. Local lights come ordered by nearest view depth of their bounds, then by place in `lights`
/// (which a LightSet orders by entity).
void select_lights(std::span<const PlacedLight> lights, const RenderView& view, VisibleLights& visible);
/// The same from lights that were prepared; `table` is of `lights`. Allocates only when there are more than ever
/// before.
void select_lights(std::span<const PlacedLight> lights, const LightTable& table, const RenderView& view,
                   JobExecutor& executor, VisibleLights& visible);

}  // namespace gloam

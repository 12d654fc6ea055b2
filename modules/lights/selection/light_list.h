// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/jobs/executor.h"
#include "engine/math/bounds.h"
#include "engine/math/view_projection.h"
#include "modules/lights/bins/z_bins.h"
#include "modules/lights/components.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/selection/light_table.h"
#include "modules/lights/selection/placed_light.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {

/// Scratch memory of select_lights, reused between frames.
struct LightSelection {
  std::vector<float> x, y, z;            ///< camera-relative centre of every light of the world
  std::vector<float> nearest, farthest;  ///< view depths of every light of the world
  std::vector<std::uint32_t> kind;       ///< of every light of the world: 1 visible local, 2 directional, 0 neither
  std::vector<std::uint32_t> local, directional;  ///< indices of the selected lights
  std::vector<std::uint64_t> keys, sorted;
  std::vector<std::uint32_t> buckets;
};

/// The lights of one view, packed for the GPU; a view resource.
struct VisibleLights {
  shaders::LightBlock block{};
  bool wide_highlights = false;        ///< input: fills emitter_radius and half_angle of the block
  bool built_wide_highlights = false;  ///< the lists were built with wide_highlights
  float light_scale = 1.0f;            ///< input: factor of the colours in the block (RenderView::light_scale)
  float built_light_scale = 1.0f;      ///< the lists were built with light_scale
  std::vector<Entity> local_entities;  ///< in the order of block.local
  std::vector<Entity> directional_entities;
  std::vector<LightDepth> depths;      ///< in the order of block.local: view depths of what the light may light (its
                                       ///< sphere, for a spot also its cone), from the near plane on
  std::vector<MaskLight> mask_lights;  ///< in the order of block.local
  std::uint32_t total = 0;             ///< lights in the world
  std::uint32_t dropped = 0;           ///< lights left out because the capacity was exceeded
  std::uint64_t version = 0;           ///< changes whenever the lists are rebuilt

  std::uint64_t set_version = 0;  ///< LightSet::version the lists were built from
  ViewProjection view;            ///< view the lists were built for
  LightSelection selection;
};

/// The light with the position and direction of its node. The matrix's scale has no effect on the light.
[[nodiscard]] PlacedLight place_light(Entity entity, const Light& light, const dmat4& world_from_node);

/// The smallest sphere around everything a local light can light, relative to `origin`. Not for directional lights.
[[nodiscard]] Sphere light_bounds(const PlacedLight& light, const dvec3& origin);

/// Selects the lights whose bounds may touch the view's frustum. If too many are visible, local lights with the largest
/// solid angle × intensity stay, and the brightest directional lights; ties go to the lower index in `lights`. Lights
/// that emit nothing, or are made unusable by NaN or infinity, are left out. Local lights are sorted by the nearest
/// view depth of VisibleLights::depths, ties by index in `lights` (a LightSet is sorted by entity).
void select_lights(std::span<const PlacedLight> lights, const ViewProjection& view, VisibleLights& visible);
/// The same with prepared lights: `table` must describe `lights`, in the same order. Allocates only when there are more
/// lights than in any call before.
void select_lights(std::span<const PlacedLight> lights, const LightTable& table, const ViewProjection& view,
                   JobExecutor& executor, VisibleLights& visible);

}  // namespace gloam

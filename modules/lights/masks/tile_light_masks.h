// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/bounds.h"
#include "engine/math/types.h"
#include "engine/render/view.h"
#include "modules/lights/masks/tile_outlines.h"
#include "modules/lights/masks/tile_row_intervals.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {

/// How closely a light's screen bound is taken (knob lights.tile_bound): each finds no more tiles than the one before
/// it.
enum class TileBound : std::uint8_t {
  rect,          ///< screen rectangle of the bounding sphere, clipped at the near plane
  row_interval,  ///< and in every row of tiles only the columns the sphere covers there
  cone,          ///< and for spots only between the two lines from the apex that touch the cone's sides
};

/// Memory that building masks keeps from one time to the next.
struct TileMaskScratch {
  TileOutlines outlines;
  std::vector<std::uint32_t> column_masks;  ///< 32 words a column of tiles, and of one column more
  std::vector<std::uint32_t> row_masks;
  std::vector<TileBand> bands;
};

/// Which lights may be seen in each tile of 32×32 pixels, as the GPU reads them; a view resource.
struct TileLightMasks {
  uvec2 tiles = uvec2(0);            ///< columns, rows
  std::vector<std::uint32_t> words;  ///< GLOAM_MASK_WORDS a tile, row by row: group word, then 32 words. Words whose
                                     ///< group bit is 0 may hold anything
  std::uint64_t lists = 0;           ///< VisibleLights::version they were made from, with this bound:
  TileBound bound = TileBound::rect;
  TileMaskScratch scratch;
};

/// What the masks are made from: one item a sorted local light, camera-relative.
struct MaskLight {
  Sphere bounds;           ///< of everything it lights; a spot's: the tight sphere of its cone
  vec3 apex = vec3(0.0f);  ///< spot: where it is
  vec3 direction = vec3(0.0f, 0.0f, -1.0f);
  float cos_outer = -1.0f;  ///< spot: of its half angle; -1 for a point light
  float range_m = 0.0f;
};

[[nodiscard]] constexpr uvec2 mask_tiles_of(std::uint32_t width, std::uint32_t height) {
  return uvec2((width + GLOAM_LIGHT_TILE - 1) / GLOAM_LIGHT_TILE, (height + GLOAM_LIGHT_TILE - 1) / GLOAM_LIGHT_TILE);
}

/// Sets the bit of every light in every tile where it may be seen: never less. `lights`: at most
/// GLOAM_MAX_LOCAL_LIGHTS. Resizes `masks`; allocates only when the picture or the light count grows.
void build_tile_light_masks(std::span<const MaskLight> lights, const RenderView& view, TileBound bound,
                            JobExecutor& executor, TileLightMasks& masks);

}  // namespace gloam

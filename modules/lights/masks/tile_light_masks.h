// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/bounds.h"
#include "engine/math/types.h"
#include "engine/math/view_projection.h"
#include "modules/lights/masks/tile_outlines.h"
#include "modules/lights/masks/tile_row_intervals.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {

/// How tightly a light's screen bound is computed (knob lights.tile_bound). Each value finds a subset of the tiles that
/// the value before it finds.
enum class TileBound : std::uint8_t {
  rect,          ///< screen rectangle of the bounding sphere, clipped at the near plane
  row_interval,  ///< and, in each row of tiles, only the columns the sphere covers there
  cone,          ///< and, for spots, only the part between the two lines from the apex tangent to the cone's sides
};
[[nodiscard]] constexpr std::string_view name_of(TileBound bound) {
  switch (bound) {
    case TileBound::rect:
      return "rect";
    case TileBound::row_interval:
      return "row_interval";
    case TileBound::cone:
      return "cone";
  }
  return {};
}

/// Scratch memory of build_tile_light_masks, reused between calls.
struct TileMaskScratch {
  TileOutlines outlines;
  std::vector<std::uint32_t> column_masks;  ///< 32 words per column of tiles, plus one extra column
  std::vector<std::uint32_t> row_masks;
  std::vector<TileBand> bands;
};

/// The lights that may be visible in each tile of 32×32 pixels, in the GPU's layout; a view resource.
struct TileLightMasks {
  uvec2 tiles = uvec2(0);            ///< columns, rows
  std::vector<std::uint32_t> words;  ///< GLOAM_MASK_WORDS per tile, row by row: group word, then 32 words. A word whose
                                     ///< group bit is 0 is undefined
  std::uint64_t lists = 0;           ///< VisibleLights::version the masks were built from
  TileBound bound = TileBound::rect;  ///< kind of bound the masks were built with
  TileMaskScratch scratch;
};

/// A light as build_tile_light_masks reads it: one item per sorted local light, camera-relative.
struct MaskLight {
  Sphere bounds;           ///< sphere around everything it lights; for a spot the tight sphere of its cone
  vec3 apex = vec3(0.0f);  ///< spot: position
  vec3 direction = vec3(0.0f, 0.0f, -1.0f);
  float cos_outer = -1.0f;  ///< cosine of the spot's half angle; -1 for a point light
  float range_m = 0.0f;
};

[[nodiscard]] constexpr uvec2 mask_tiles_of(std::uint32_t width, std::uint32_t height) {
  return uvec2((width + GLOAM_LIGHT_TILE - 1) / GLOAM_LIGHT_TILE, (height + GLOAM_LIGHT_TILE - 1) / GLOAM_LIGHT_TILE);
}

/// Builds the masks. A light's bit is set in every tile where the light may be visible (conservative). `lights`: at
/// most GLOAM_MAX_LOCAL_LIGHTS. Resizes `masks`; allocates only when the image size or the light count grows.
void build_tile_light_masks(std::span<const MaskLight> lights, const ViewProjection& view, TileBound bound,
                            JobExecutor& executor, TileLightMasks& masks);

}  // namespace gloam

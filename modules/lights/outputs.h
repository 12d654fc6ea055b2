// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/math/types.h"

namespace gloam {

/// What the lights module leaves for a view.
struct LightsOutputs {
  gpu::Binding::BufferRange lights;  ///< a LightBlock (shaders/lights/lights_shared.h), uniform
  std::uint32_t local_count = 0;
  std::uint32_t directional_count = 0;
  ImageRef texels;  ///< rgba32f, 3 × GLOAM_MAX_LOCAL_LIGHTS: local lights as light_texels.comp writes them; none
                    ///< without local lights

  /// What follows exists with local lights and lights.culling = tiled.
  gpu::Binding::BufferRange grid;        ///< a LightGrid, uniform
  gpu::Binding::BufferRange z_bins;      ///< one word a bin: the standard set, then the ranged one; storage
  gpu::Binding::BufferRange mask_tiles;  ///< GLOAM_MASK_WORDS a tile of 32×32 pixels, as the CPU made them; storage
  BufferRef group_masks;                 ///< GLOAM_MASK_WORDS a tile group: lights of the approximate search
  ImageRef tile_lists;  ///< rg32ui, one texel a shadow tile: slot (first list entry, a multiple of 3) or GLOAM_NO_SLOT;
                        ///< lights in the low 16 bits by the accurate search, in the high 16 by the approximate one
  BufferRef early_lists;            ///< list entry e: 10 bits at bit 10 · (e % 3) of word e / 3
  BufferRef counters;               ///< a LightCounters
  std::uint32_t slot_capacity = 0;  ///< list entries early_lists holds
  bool lists_always_fit =
      false;  ///< slot_capacity is enough for every tile to list every light: no tile is without a list
  [[nodiscard]] bool has_lists() const { return static_cast<bool>(tile_lists); }
};

/// A later module puts this on the board, before PassPhase::visualize, when it shows view light_list of the view's
/// lights itself: what became of the early lists.
struct LightListViewTaken {};

/// The lights of one view; a view resource that system light_sort makes. What other modules' systems may ask of it
/// stands here.
struct VisibleLights;
/// Point and spot lights that may touch the view's frustum, in the order of LightBlock::local. None has NaN or infinity
/// where no sense can be made of it; each had Light and WorldTransform when the world's systems ran.
[[nodiscard]] std::span<const Entity> local_lights(const VisibleLights& visible);
/// The same for LightBlock::directional.
[[nodiscard]] std::span<const Entity> directional_lights(const VisibleLights& visible);

/// What of a directional light does not depend on where one looks.
struct DirectionalLook {
  vec3 direction = vec3(0.0f, -1.0f, 0.0f);  ///< where it shines, unit
  float brightest = 0.0f;                    ///< lux, of its brightest component
};
/// By index of LightBlock::directional.
[[nodiscard]] std::vector<DirectionalLook> directional_looks(const VisibleLights& visible);

/// Pixels along a side of a shadow tile, which has a light list.
inline constexpr std::uint32_t kShadowTile = 8;

/// Bytes of a LightBlock without lights, for shading a scene that has none.
[[nodiscard]] std::span<const std::byte> empty_light_block();

/// One texel of LightsOutputs::tile_lists.
struct TileList {
  bool has_list = true;            ///< false: no room was left, the tile's lights are those of its group's mask
  std::uint32_t slot = 0;          ///< its first list entry
  std::uint32_t count = 0;         ///< lights with a pixel of the tile in their volume
  std::uint32_t approx_count = 0;  ///< lights that touch the tile's froxel
};
[[nodiscard]] TileList decode_tile_list(uvec2 texel);

/// Indices of the lights in one mask of mask_tiles or group_masks. `words`: its GLOAM_MASK_WORDS words; words whose
/// group bit is 0 are not looked at.
[[nodiscard]] std::vector<std::uint32_t> decode_light_mask(std::span<const std::uint32_t> words);

/// Light indices of `count` list entries from `slot` on. `early_lists`: the buffer's words. Entries beyond the buffer
/// are left out.
[[nodiscard]] std::vector<std::uint32_t> decode_light_list(std::span<const std::uint32_t> early_lists,
                                                           std::uint32_t slot, std::uint32_t count);

}  // namespace gloam

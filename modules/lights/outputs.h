// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/math/types.h"
#include "engine/render/declare/shader_pass.h"
#include "engine/render/frame_builder.h"
#include "engine/render/knobs/knob_table.h"
#include "modules/lights/components.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {

struct TileLightMasks;

/// Lights that are evaluated at a pixel.
enum class LightCulling : std::uint8_t {
  brute,  ///< all lights
  tiled,  ///< the lights in the list of its tile
};
[[nodiscard]] constexpr std::string_view name_of(LightCulling culling) {
  switch (culling) {
    case LightCulling::brute:
      return "brute";
    case LightCulling::tiled:
      return "tiled";
  }
  return {};
}

inline constexpr EnumKnob<LightCulling> kLightCulling{
    .name = "lights.culling",
    .meaning = "lights evaluated at a pixel: all lights (brute), or the lights in the list of its tile (tiled)",
    .default_value = LightCulling::tiled,
    .exact = LightCulling::brute};

/// Outputs of the lights module for a view; later modules read them from the board.
struct LightsOutputs {
  gpu::Binding::BufferRange lights;  ///< a LightBlock (shaders/lights/lights_shared.h), uniform
  std::uint32_t local_count = 0;
  std::uint32_t directional_count = 0;
  ImageRef texels;  ///< rgba32f, 3 × GLOAM_MAX_LOCAL_LIGHTS: local lights in the layout of light_texels.comp; empty
                    ///< without local lights

  /// The following fields are set only with local lights and lights.culling = tiled.
  gpu::Binding::BufferRange grid;  ///< a LightGrid, uniform
  BufferRef z_bins;                ///< one word per bin: the standard set, then the ranged set
  BufferRef mask_tiles;            ///< GLOAM_MASK_WORDS per tile of 32×32 pixels, built on the CPU
  BufferRef group_masks;           ///< GLOAM_MASK_WORDS per tile group: lights found by the approximate search
  ImageRef tile_lists;  ///< rg32ui, one texel per shadow tile. x: slot (first list entry, a multiple of 3) or
                        ///< GLOAM_NO_SLOT. y: light count of the accurate search in the low 16 bits, of the approximate
                        ///< search in the high 16
  BufferRef early_lists;                  ///< list entry e: 10 bits at bit 10 · (e % 3) of word e / 3
  BufferRef counters;                     ///< a LightCounters
  std::uint32_t slot_capacity = 0;        ///< list entries that early_lists holds
  std::uint64_t entry_bound = 0;          ///< the most list entries that the view's tiles can need
  const TileLightMasks* masks = nullptr;  ///< for most_tile_lights(); valid while the frame is declared
  bool lists_always_fit = false;          ///< every tile has room to list every light, so every tile gets a list
  [[nodiscard]] bool has_lists() const { return static_cast<bool>(tile_lists); }
};

/// Whether highlights are as wide as the lights that make them; false without the lights module.
[[nodiscard]] bool wide_highlights(const KnobRegistry& knobs);

/// Binds the light data that the program in use declares: lights, grid (a LightGrid), light_texels, tile_lists,
/// early_lists, group_masks, mask_tiles and z_bin_words. What the view does not have becomes a placeholder.
void read_light_lists(ShaderPass& pass, const LightsOutputs& lights);

/// The most pairs of a shadow tile and one of the `chosen` local lights that the early lists can hold, by the tile
/// masks of the CPU. chosen: bit i % 32 of word i / 32 for light i; empty: all. 0 if the view has no lists.
[[nodiscard]] std::uint64_t most_tile_lights(const LightsOutputs& lights, uvec2 shadow_tiles,
                                             std::span<const std::uint32_t> chosen);

/// Whether a later module wants room for all lists of a view; a view resource. The lights module resets it in
/// Module::prepare_view; a later module sets it in its own. The early lists then have room for every light of the tile
/// masks, up to 128 MiB.
struct ListRoom {
  bool all = false;
};
/// Whether the view's early lists will have room for every light in this frame. Can be asked in PassPhase::announce.
[[nodiscard]] bool light_lists_will_fit(const FrameBuilder& frame);
/// most_tile_lights() of some shadow tiles, which can be asked in PassPhase::announce. tiles: bit i % 32 of word i / 32
/// for the tile of index i = row · columns + column.
[[nodiscard]] std::uint64_t most_tile_lights_of(const FrameBuilder& frame, std::span<const std::uint32_t> tiles,
                                                std::span<const std::uint32_t> chosen);

/// A later module puts this on the board, before PassPhase::visualize, if it draws the visualizer light_list of the
/// view's lights itself, to show the final use of the early lists.
struct LightListViewTaken {};

/// The lights of one view; a view resource written by system light_sort. The functions below are its interface for the
/// systems of other modules.
struct VisibleLights;
/// Point and spot lights that may touch the view's frustum, in the order of LightBlock::local. Lights made unusable by
/// NaN or infinity are not among them. Each had Light and WorldTransform when the world's systems ran.
[[nodiscard]] std::span<const Entity> local_lights(const VisibleLights& visible);
/// Directional lights, in the order of LightBlock::directional.
[[nodiscard]] std::span<const Entity> directional_lights(const VisibleLights& visible);

/// Properties of a directional light that do not depend on the view.
struct DirectionalLook {
  vec3 direction = vec3(0.0f, -1.0f, 0.0f);  ///< direction in which it shines, unit length
  float brightest = 0.0f;                    ///< lux, of the brightest colour channel
};
/// Indexed as LightBlock::directional.
[[nodiscard]] std::vector<DirectionalLook> directional_looks(const VisibleLights& visible);

/// What decides where a local light falls: equal for two lights that fall on the same points. Its colour channels are 1
/// or 0: whether they emit. Camera-relative. light: indexed as LightBlock::local.
[[nodiscard]] shaders::LocalLight local_light_reach(const VisibleLights& visible, std::size_t light);

/// A hash of all local lights of the view, as LightBlock::local holds them.
[[nodiscard]] std::uint64_t local_lights_hash(const VisibleLights& visible);

/// Illuminance in lux, the luminance of its linear RGB, that a light sheds on a camera-relative point of a surface, if
/// nothing casts a shadow. normal: unit length. light: indexed as LightBlock::local, or LightBlock::directional.
[[nodiscard]] double local_illuminance_at(const VisibleLights& visible, std::size_t light, const vec3& point,
                                          const vec3& normal);
[[nodiscard]] double directional_illuminance_at(const VisibleLights& visible, std::size_t light, const vec3& normal);
/// The same of all lights of the view's last frame, with their entities; those that shed none are left out. Empty if
/// the view has no lights.
struct LightOnPoint {
  Entity entity = kNoEntity;
  double lux = 0.0;
};
[[nodiscard]] std::vector<LightOnPoint> illuminance_at(const World& world, ViewId view, const vec3& point,
                                                       const vec3& normal);

/// Bytes of a LightBlock with no lights, for shading a scene that has none.
[[nodiscard]] std::span<const std::byte> empty_light_block();

/// One texel of LightsOutputs::tile_lists.
struct TileList {
  bool has_list = true;            ///< false: the buffer was full; use the lights of the tile group's mask
  std::uint32_t slot = 0;          ///< first list entry
  std::uint32_t count = 0;         ///< lights whose volume contains a pixel of the tile
  std::uint32_t approx_count = 0;  ///< lights that touch the tile's froxel
};
[[nodiscard]] TileList decode_tile_list(uvec2 texel);

/// Indices of the lights in one mask of mask_tiles or group_masks. `words`: GLOAM_MASK_WORDS words; words whose group
/// bit is 0 are ignored.
[[nodiscard]] std::vector<std::uint32_t> decode_light_mask(std::span<const std::uint32_t> words);

/// Light indices of the `count` list entries that start at `slot`. `early_lists`: the words of that buffer. Entries
/// beyond the end of the buffer are omitted.
[[nodiscard]] std::vector<std::uint32_t> decode_light_list(std::span<const std::uint32_t> early_lists,
                                                           std::uint32_t slot, std::uint32_t count);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/math/types.h"
#include "modules/shadows/extra_maps.h"  // IWYU pragma: export
#include "modules/shadows/overlay_maps.h"  // IWYU pragma: export
#include "modules/shadows/shadow_views.h"

namespace gloam {

/// What lights each shadow tile of a view and how much of each light its pixels see (shaders/shadows/final_lists_shared.h), for shaders that
/// include shaders/shadows/final_lists_api.glsl. Opaque surfaces only.
struct FinalLists {
  ImageRef tiles;                   ///< rgba32ui, one texel a shadow tile
  BufferRef entries;                ///< a word an entry
  BufferRef visibilities[2];        ///< words of slots; the second is the first when one is enough
  BufferRef commands;               ///< ShadowListCommands
  std::uint64_t fallback_draw = 0;  ///< where in `commands` the arguments of the draw of fallback_tiles lie, bytes
  BufferRef counters;               ///< ShadowListCounters
  BufferRef fallback_tiles;  ///< y << 16 | x of tiles without a list, as many as ShadowListCommands::fallback_draw says
  gpu::Binding::BufferRange grid;  ///< a FinalGrid, uniform
  bool always_complete = false;  ///< there is room for every light of every tile: no tile is without a list
  std::uint32_t visibility_bits = 8;
  std::uint32_t slot_capacity = 0;  ///< slots the visibilities hold
  std::uint32_t pair_capacity = 0;
  /// GLOAM_FINAL_…_ID; `variant` names them.
  std::vector<gpu::SpecConstant> constants;
  std::string variant;
};

/// What the shadows module leaves for a view, for shaders that include shaders/shadows/shadows_api.glsl. On the board only when shadows are
/// to be looked at.
struct ShadowsOutputs {
  gpu::Binding::BufferRange block;  ///< a ShadowBlock (shaders/shadows/shadows_shared.h), uniform
  shaders::ShadowBlock block_values{};  ///< what it holds
  ImageRef rows;                    ///< rgba32f, GLOAM_SHADOW_ROW_TEXELS × local lights: ShadowRow
  std::shared_ptr<const std::vector<shaders::ShadowRow>> row_values;  ///< what it holds; directional lights' are CascadeRow
  ImageRef atlas;                   ///< r32f or r16_unorm: depth of all faces and their mips
  ImageRef pyramid;                 ///< rg32f: farthest and nearest depth
  ImageRef cookies;  ///< rgba8_srgb, an array: cookies of spot lights; one white layer when there is none
  ImageRef
      traced;  ///< r8_unorm, an array: visibility a light and pixel that a reference has traced; the cookies' image when there is none
  gpu::SamplerHandle nearest;
  gpu::SamplerHandle linear;

  /// No light asks for a map or traced visibility: shaders may take cookies_api.glsl in place of shadows_api.glsl, many times smaller.
  bool cookies_only = false;
  /// The filter is what GLOAM_SHADOWS_STANDARD compiles, half as large.
  bool standard = false;
  /// GLOAM_SHADOWS_…_ID, the same for every shader of the frame. `variant` names them, for names of pipelines.
  std::vector<gpu::SpecConstant> constants;
  std::string variant;

  std::uint32_t cookie_lights = 0;  ///< lights of the scene with a cookie

  /// With shadows.mode = deferred, when there are maps.
  std::optional<FinalLists> final_lists;
};

void declare_shadow_reads(PassBuilder& pass, const ShadowsOutputs& shadows, gpu::Access access);
/// Bindings that shadows_api.glsl takes, from number `first` on: block, rows, atlas, pyramid, cookies, traced.
void append_shadow_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                            const ShadowsOutputs& shadows);

/// The same for shaders that include cookies_api.glsl when shadows.cookies_only, else shadows_api.glsl. The former takes block, rows, cookies.
void declare_arriving_reads(PassBuilder& pass, const ShadowsOutputs& shadows, gpu::Access access);
void append_arriving_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                              const ShadowsOutputs& shadows);

/// Block, rows and cookies: what cookies_api.glsl takes.
void append_cookie_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                            const ShadowsOutputs& shadows);

/// Bindings that final_lists_api.glsl takes, from number `first` on: tiles, entries, both visibilities.
void declare_final_list_reads(PassBuilder& pass, const FinalLists& lists, gpu::Access access);
void append_final_list_bindings(std::vector<gpu::Binding>& bindings, std::uint32_t first, const PassContext& context,
                                const FinalLists& lists, gpu::SamplerHandle nearest);

/// Casters that the maps of a light leave out, because a later module sees to what they keep of it. Put on the board in PassPhase::announce;
/// looked at only in frames that have final lists.
struct WithheldCasters {
  struct OfLight {
    Entity light;
    std::vector<Entity> casters;  ///< Caster::entity, ascending by Entity::index
  };
  std::vector<OfLight> lights;  ///< ascending by Entity::index
  [[nodiscard]] std::span<const Entity> of(Entity light) const;
};

/// One texel of FinalLists::tiles.
struct FinalList {
  bool complete = true;  ///< false: a buffer was full, the tile is shaded from shadow maps
  std::uint32_t directional_first = 0;
  std::uint32_t directional_count = 0;
  std::uint32_t local_first = 0;
  std::uint32_t local_count = 0;
};
[[nodiscard]] FinalList decode_final_list(uvec4 texel);

/// One word of FinalLists::entries.
struct FinalEntry {
  std::uint32_t light = 0;  ///< index among the view's directional or local lights
  std::uint32_t slot = 0;   ///< of visibilities, or GLOAM_ALL_LIT
};
[[nodiscard]] FinalEntry decode_final_entry(std::uint32_t word);

/// 0 … 1, of a pixel (0 … 63, row by row) of the tile that the entry is in. `words`: of all slots, one buffer after the other. 0 where the slot
/// lies beyond them.
[[nodiscard]] float decode_visibility(FinalEntry entry, std::uint32_t pixel, std::span<const std::uint32_t> words,
                                      std::uint32_t visibility_bits);

}  // namespace gloam

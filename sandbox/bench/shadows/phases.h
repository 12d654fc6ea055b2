// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/render/renderer.h"

namespace gloam {

/// Steps from lights to a lit picture: FF figure 13 shows their shares, FF table 1 their sum. Drawing shadow maps is
/// not one of them.
enum class ShadowPhase : std::uint8_t {
  prepare,   ///< depth bounds, light texels, light rows, clears, readback of counters
  approx,    ///< lights whose volume touches a tile's froxel
  accurate,  ///< lights with a pixel of the tile in their volume
  classify,  ///< tiles that are lit or unlit as a whole
  generate,  ///< visibilities of the others
  finish,    ///< final lists
  closeups,  ///< composes close-ups into final lists, transfers them into maps for forward-lit surfaces
  lighting,
};
inline constexpr std::size_t kShadowPhases = 8;
inline constexpr std::array<const char*, kShadowPhases> kShadowPhaseNames = {
    "prepare", "find_approx", "find_accurate", "classify", "generate", "finish", "closeups", "lighting"};

/// The phase of a pass; none for shadow maps, geometry and passes after lighting. Unknown passes of the modules lights
/// and shadows count as `prepare`, so that none is left out by mistake.
[[nodiscard]] std::optional<ShadowPhase> shadow_phase_of(const PassTime& pass);
/// Whether a pass makes shadow maps or the data kept with them (mips, planes). These passes run only for faces that are
/// redrawn, and for close-up pairs (closeup_map_ms).
[[nodiscard]] bool makes_shadow_maps(const PassTime& pass);

/// Milliseconds that a frame spends on maps of close-up pairs: drawing, and resolving into mips and pyramids. These
/// maps are made anew in every frame.
[[nodiscard]] double closeup_map_ms(const FrameReport& report);

/// Milliseconds of one frame by phase.
struct PhaseTimes {
  std::array<double, kShadowPhases> ms{};
  [[nodiscard]] double of(ShadowPhase phase) const { return ms[static_cast<std::size_t>(phase)]; }
  [[nodiscard]] double total() const;
};
[[nodiscard]] PhaseTimes phase_times(const FrameReport& report);

/// A counter of a frame; 0 if there is none of that name.
[[nodiscard]] double counter_of(const FrameReport& report, std::string_view name);
/// Whether every tile had room for its lights and visibilities.
[[nodiscard]] bool lists_had_room(const FrameReport& report);

/// Bytes of lists in FF's layout with 32 lights per tile of 8×8 pixels: early entries of a third of a 32-bit word and
/// final entries of a word.
[[nodiscard]] double fixed_list_bytes(std::uint32_t width, std::uint32_t height);
/// Bytes of visibilities in the same layout: 64 bytes per light.
[[nodiscard]] double fixed_visibility_bytes(std::uint32_t width, std::uint32_t height);

}  // namespace gloam

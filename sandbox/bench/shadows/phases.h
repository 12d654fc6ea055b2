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

/// Steps from lights to a lit picture: what FF figure 13 shows the shares of, and what table 1 adds up. Maps are none
/// of them.
enum class ShadowPhase : std::uint8_t {
  prepare,   ///< bounds of tiles' depths, lights and faces as texels, clears, counters read back
  approx,    ///< lights whose volume touches a tile's froxel
  accurate,  ///< lights with a pixel of the tile in their volume
  classify,  ///< tiles that are lit or unlit as a whole
  generate,  ///< visibilities of the others
  finish,    ///< final lists
  closeups,  ///< what close-up subjects keep of the light, into final lists and into maps for forward-lit things
  lighting,
};
inline constexpr std::size_t kShadowPhases = 8;
inline constexpr std::array<const char*, kShadowPhases> kShadowPhaseNames = {
    "prepare", "find_approx", "find_accurate", "classify", "generate", "finish", "closeups", "lighting"};

/// Of a pass; none for maps, geometry and what comes after lighting. Passes of the modules lights and shadows that are
/// not known here are counted as `prepare`, so that none is left out by mistake.
[[nodiscard]] std::optional<ShadowPhase> shadow_phase_of(const PassTime& pass);
/// Whether a pass makes shadow maps or what is kept beside them; such passes run only for faces that are drawn anew.
[[nodiscard]] bool makes_shadow_maps(const PassTime& pass);

/// Milliseconds of one frame by phase.
struct PhaseTimes {
  std::array<double, kShadowPhases> ms{};
  [[nodiscard]] double of(ShadowPhase phase) const { return ms[static_cast<std::size_t>(phase)]; }
  [[nodiscard]] double total() const;
};
[[nodiscard]] PhaseTimes phase_times(const FrameReport& report);

/// A counter of a frame; 0 when there is none of that name.
[[nodiscard]] double counter_of(const FrameReport& report, std::string_view name);
/// Whether every tile had room for its lights and visibilities.
[[nodiscard]] bool lists_had_room(const FrameReport& report);

/// FF's layout with 32 lights a tile, of 8×8 pixels: early entries of a third of a word and final ones of a word, in
/// bytes.
[[nodiscard]] double fixed_list_bytes(std::uint32_t width, std::uint32_t height);
/// The same with 64 bytes of visibility a light.
[[nodiscard]] double fixed_visibility_bytes(std::uint32_t width, std::uint32_t height);

}  // namespace gloam

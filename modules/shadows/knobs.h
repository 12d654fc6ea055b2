// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/gpu/types.h"
#include "engine/render/knobs/knobs.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// The module's knobs as numbers (shadows.NAME, see add_shadow_knobs).
struct ShadowKnobs {
  bool enabled = true;
  bool deferred = true;            ///< final lists are made
  bool classify = true;            ///< tiles are classified before pixels are filtered
  std::uint32_t slot_limit = ~0u;  ///< greatest number of visibility slots per view
  std::uint32_t pair_limit = ~0u;  ///< greatest number of tile-light pairs per view
  std::uint32_t filter = 3;        ///< value of kFilter (shadows_api.glsl)
  std::uint32_t kernel = 8;        ///< texels of the kernel's side
  bool mips = true;
  std::uint32_t mip_operator = GLOAM_SHADOW_MIPS_COVERAGE;  ///< GLOAM_SHADOW_MIPS_…; with d16 never coverage
  bool square = false;                                      ///< the widest kernel is a square, not a disc
  bool receiver_plane = true;  ///< taps are compared with the receiver plane, not with the receiver's depth
  bool d16 = false;            ///< the atlas is r16_unorm, else r32f
  bool oriented = true;        ///< oriented bias, else the rasteriser's
  float bias_m = 0.002f;       ///< oriented bias in metres; 0 with hardware bias
  float bias_units = 0.0f;  ///< constant depth bias of map draws, away from the light, in steps of the depth format; 0
                            ///< with oriented bias
  std::uint32_t levels = 255;  ///< steps of a visibility: 15 or 255; 0: not quantised
  std::uint32_t atlas_size = 4096;
  float texels_per_pixel = 3.0f;
  bool simplified = false;  ///< casters are drawn with their simplified triangles
  std::uint32_t near = 1;   ///< estimate of near blockers: 0 off, 1 wide, 2 all
  bool terminator = false;  ///< smooth-shaded surfaces are judged at their smooth surface
  bool early_outs = true;   ///< a filter stops as soon as the result is known; false only for measurements
};

/// The knobs that systems read; a view resource.
struct ShadowSettings {
  bool enabled = true;              ///< shadows.mode is not off
  std::uint32_t atlas_size = 4096;  ///< texels, a power of two
  std::uint32_t cascades = 4;       ///< cascades of a directional light, at most GLOAM_MAX_CASCADES
  float kernel_rim = 0.125f;        ///< width of a rim as a share of the half extent inside it; see rim_share()
  float texels_per_pixel = 3.0f;    ///< wanted shadow-map texels along a pixel's side; lowered until the maps fit
};

void add_shadow_knobs(KnobRegistry& registry);
[[nodiscard]] ShadowKnobs shadow_knobs(const KnobRegistry& registry);
[[nodiscard]] ShadowSettings shadow_settings(const ShadowKnobs& knobs);

/// Specialisation constants of the knobs, for shaders that include shadows_api.glsl. filter: value of kFilter.
[[nodiscard]] gpu::SpecConstants shadow_constants(const ShadowKnobs& knobs, std::uint32_t filter);

// Values of kFilter.
inline constexpr std::uint32_t kContactHardening = 3;
inline constexpr std::uint32_t kTracedShadows = 4;
inline constexpr std::uint32_t kNoShadows = 5;  ///< no shadows, cookies only

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/gpu/types.h"
#include "engine/render/knobs/knobs.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// The module's knobs as numbers.
struct ShadowKnobs {
  bool enabled = true;
  bool deferred = true;            ///< final lists are made, with a visibility for every pixel that needs one
  bool classify = true;            ///< whole tiles before pixels
  std::uint32_t slot_limit = ~0u;  ///< most slots of visibility of a view
  std::uint32_t pair_limit = ~0u;  ///< most pairs of a tile and a light whose pixels are asked
  std::uint32_t filter = 3;        ///< GLOAM_SHADOWS_FILTER_ID
  std::uint32_t kernel = 8;        ///< texels
  bool mips = true;
  std::uint32_t mip_operator = GLOAM_SHADOW_MIPS_COVERAGE;
  bool square = false;
  bool receiver_plane = true;
  bool d16 = false;
  bool oriented = true;
  float bias_m = 0.002f;
  float bias_units = 0.0f;  ///< of the map's draws, towards the light's far side; 0 with oriented bias
  std::uint32_t levels = 255;
  std::uint32_t atlas_size = 4096;
  float texels_per_pixel = 3.0f;
  bool simplified = false;  ///< casters have fewer triangles where that does not show
  bool early_outs = true;
};

/// The part of the knobs that systems read; a view resource.
struct ShadowSettings {
  bool enabled = true;              ///< shadows.mode is not off
  std::uint32_t atlas_size = 4096;  ///< texels, a power of two
  std::uint32_t cascades = 4;       ///< of a directional light
  float kernel_rim = 0.125f;        ///< rim of a face for kernels, as a share of its half extent
  float texels_per_pixel = 3.0f;    ///< to a pixel's side, where the atlas has room
};

void add_shadow_knobs(KnobRegistry& registry);
[[nodiscard]] ShadowKnobs shadow_knobs(const KnobRegistry& registry);
[[nodiscard]] ShadowSettings shadow_settings(const ShadowKnobs& knobs);

/// What shading knows of the knobs when its pipelines are made. `filter`: GLOAM_SHADOWS_FILTER_ID.
[[nodiscard]] std::vector<gpu::SpecConstant> shadow_constants(const ShadowKnobs& knobs, std::uint32_t filter);
/// The same in a few words, another one for other constants.
[[nodiscard]] std::string shadow_variant(const std::vector<gpu::SpecConstant>& constants);

// Of GLOAM_SHADOWS_FILTER_ID.
inline constexpr std::uint32_t kContactHardening = 3;
inline constexpr std::uint32_t kTracedShadows = 4;
inline constexpr std::uint32_t kNoShadows = 5;  ///< cookies alone

}  // namespace gloam

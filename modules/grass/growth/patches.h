// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/grass/components.h"
#include "modules/grass/growth/blade_types.h"
#include "modules/grass/growth/scatter.h"
#include "modules/grass/growth/surface.h"

namespace gloam {

/// Texture layers that growth gives to blades.
inline constexpr std::uint32_t kGrassLayers = 16;

/// Inputs of the patches of one surface.
struct PatchSource {
  Entity entity;  ///< with the GrassSurface
  GrassSurface values;
  std::span<const BladeType> types;     ///< at least one
  std::uint32_t first_type = 0;         ///< number of types[0] in GrassField::types
  std::uint32_t slaves_per_master = 4;  ///< 0: every blade is a master
};

/// Groups the roots into patches of at most 256 neighbouring blades and appends them: one GrassPatch and 256 slots in
/// `blades` each. Empty slots, the last ones of a patch, have length 0. Each patch consists of small groups of
/// neighbours: one master, near the group's middle, and at most slaves_per_master slaves. blades.size() must be
/// 256 · patches.size().
void append_patches(const GrowthSurface& surface, std::span<const ScatteredRoot> roots, const PatchSource& source,
                    JobExecutor& jobs, std::vector<GrassPatch>& patches, std::vector<GrassBlade>& blades);

}  // namespace gloam

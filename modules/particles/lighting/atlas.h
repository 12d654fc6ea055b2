// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modules/particles/baked_light.h"
#include "modules/particles/frame.h"

namespace gloam {

/// Places of maps in an atlas: slices of one volume, stacked along z, each map in the corner of its slices.
struct AtlasPlan {
  uvec3 size = uvec3(0);                   ///< texels; 0: no map is usable
  std::vector<std::uint32_t> first_slice;  ///< first_slices() of the maps
};
[[nodiscard]] AtlasPlan plan_atlas(std::span<const ParticleLightMap> maps);

/// The world's maps on the GPU; uploaded when their version has changed.
[[nodiscard]] BakedLightAtlas add_atlas(FrameBuilder& frame, const ParticleLightMaps& maps, const AtlasPlan& plan);

/// Sets the row's map. slice: AtlasPlan::first_slice.
void set_map(const ParticleLightMap& map, std::uint32_t slice, const RenderView& view,
             shaders::ParticleEmitterRow& row);

}  // namespace gloam

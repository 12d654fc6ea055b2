// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/knobs.h"

#include "modules/shadows/outputs.h"

namespace gloam {

void add_shadow_knobs(KnobRegistry& registry) {
  add_knobs(registry, "shadows", kShadowMode, kShadowClassify, kShadowFilter, kShadowKernel, kShadowNear,
            kShadowNearDirections, kShadowMips, kShadowMipOperator, kSquareShadowKernel, kShadowReceiverPlane,
            kShadowTerminator, kShadowDepth16, kOrientedShadowBias, kSubsurfaceBacks, kShadowBiasMm, kShadowBiasUnits,
            kVisibilityLevels, kShadowAtlas, kShadowKeptAtlases, kShadowTexelsPerPixel, kSimplifiedCasters,
            kShadowLodTexels, kShadowSlotLimit, kShadowPairLimit, kShadowReuse, kShadowMinContribution,
            kShadowEarlyOuts);
}

ShadowKnobs shadow_knobs(const KnobRegistry& registry) {
  ShadowKnobs knobs;
  knobs.enabled = registry.value(kShadowMode) != ShadowMode::off;
  knobs.filter = registry.value(kShadowFilter);
  knobs.kernel = registry.value(kShadowKernel);
  knobs.mips = registry.value(kShadowMips);
  knobs.mip_operator = registry.value(kShadowMipOperator);
  knobs.square = registry.value(kSquareShadowKernel);
  knobs.receiver_plane = registry.value(kShadowReceiverPlane);
  knobs.terminator = registry.value(kShadowTerminator);
  knobs.subsurface_backs = registry.value(kSubsurfaceBacks);
  knobs.d16 = registry.value(kShadowDepth16);
  // 16-bit depths have no spare bits for coverage.
  if (knobs.d16 && knobs.mip_operator == GLOAM_SHADOW_MIPS_COVERAGE) knobs.mip_operator = GLOAM_SHADOW_MIPS_NEAREST;
  knobs.oriented = registry.value(kOrientedShadowBias);
  knobs.bias_m = knobs.oriented ? static_cast<float>(registry.value(kShadowBiasMm) * 1e-3) : 0.0f;
  knobs.bias_units = knobs.oriented ? 0.0f : static_cast<float>(registry.value(kShadowBiasUnits));
  knobs.levels = registry.value(kVisibilityLevels);
  knobs.atlas_size = registry.value(kShadowAtlas);
  knobs.kept_atlas_bytes = std::uint64_t{registry.value(kShadowKeptAtlases)} << 20;
  knobs.texels_per_pixel = static_cast<float>(registry.value(kShadowTexelsPerPixel));
  knobs.simplified = registry.value(kSimplifiedCasters);
  knobs.lod_texels = static_cast<float>(registry.value(kShadowLodTexels));
  knobs.near = registry.value(kShadowNear);
  knobs.near_directions = registry.value(kShadowNearDirections);
  knobs.thin_filter = registry.try_value(kGrassShadowFilter).value_or(0);
  knobs.reuse = registry.value(kShadowReuse);
  knobs.min_contribution = static_cast<float>(registry.value(kShadowMinContribution));
  knobs.early_outs = registry.value(kShadowEarlyOuts);
  knobs.deferred = registry.value(kShadowMode) == ShadowMode::deferred;
  knobs.classify = registry.value(kShadowClassify);
  knobs.slot_limit = registry.value(kShadowSlotLimit);
  knobs.pair_limit = registry.value(kShadowPairLimit);
  return knobs;
}

ShadowSettings shadow_settings(const ShadowKnobs& knobs) {
  ShadowSettings settings;
  settings.enabled = knobs.enabled;
  settings.atlas_size = knobs.atlas_size;
  settings.texels_per_pixel = knobs.texels_per_pixel;
  settings.d16 = knobs.d16;
  return settings;
}

gpu::SpecConstants shadow_constants(const ShadowKnobs& knobs, std::uint32_t filter) {
  gpu::SpecConstants constants;
  constants.set_if_present("kFilter", filter);
  constants.set_if_present("kKernel", static_cast<std::int32_t>(knobs.kernel));
  constants.set_if_present("kMips", knobs.mips ? 1u : 0u);
  constants.set_if_present("kReceiverPlane", knobs.receiver_plane ? 1u : 0u);
  constants.set_if_present("kBias", knobs.oriented ? 1u : 0u);
  constants.set_if_present("kKernelShape", knobs.square ? 1u : 0u);
  constants.set_if_present("kLevels", knobs.levels);
  constants.set_if_present("kFullPenumbra", knobs.early_outs ? 0u : 1u);
  constants.set_if_present("kCoverage", knobs.mip_operator == GLOAM_SHADOW_MIPS_COVERAGE ? 1u : 0u);
  constants.set_if_present("kNear", knobs.near);
  constants.set_if_present("kNearDirections", static_cast<std::int32_t>(knobs.near_directions));
  constants.set_if_present("kTerminator", knobs.terminator ? 1u : 0u);
  constants.set_if_present("kDimLights", knobs.min_contribution > 0.0f ? 1u : 0u);
  constants.set_if_present("kTransmission", knobs.transmission ? 1u : 0u);
  constants.set_if_present("kSubsurfaceBias", knobs.subsurface_backs ? 1u : 4u);
  return constants;
}

}  // namespace gloam

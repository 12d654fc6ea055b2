// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/knobs.h"

#include "modules/shadows/outputs.h"

namespace gloam {

void add_shadow_knobs(KnobRegistry& registry) {
  add_knobs(registry, "shadows", kShadowMode, kShadowClassify, kShadowFilter, kShadowKernel, kShadowNear, kShadowMips,
            kShadowMipOperator, kSquareShadowKernel, kShadowReceiverPlane, kShadowTerminator, kShadowDepth16,
            kOrientedShadowBias, kShadowBiasMm, kShadowBiasUnits, kVisibilityLevels, kShadowAtlas,
            kShadowTexelsPerPixel, kSimplifiedCasters, kShadowSlotLimit, kShadowPairLimit, kShadowEarlyOuts);
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
  knobs.d16 = registry.value(kShadowDepth16);
  // 16-bit depths have no spare bits for coverage.
  if (knobs.d16 && knobs.mip_operator == GLOAM_SHADOW_MIPS_COVERAGE) knobs.mip_operator = GLOAM_SHADOW_MIPS_NEAREST;
  knobs.oriented = registry.value(kOrientedShadowBias);
  knobs.bias_m = knobs.oriented ? static_cast<float>(registry.value(kShadowBiasMm) * 1e-3) : 0.0f;
  knobs.bias_units = knobs.oriented ? 0.0f : static_cast<float>(registry.value(kShadowBiasUnits));
  knobs.levels = registry.value(kVisibilityLevels);
  knobs.atlas_size = registry.value(kShadowAtlas);
  knobs.texels_per_pixel = static_cast<float>(registry.value(kShadowTexelsPerPixel));
  knobs.simplified = registry.value(kSimplifiedCasters);
  knobs.near = registry.value(kShadowNear);
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
  return settings;
}

std::vector<gpu::SpecConstant> shadow_constants(const ShadowKnobs& knobs, std::uint32_t filter) {
  return {{GLOAM_SHADOWS_FILTER_ID, filter},
          {GLOAM_SHADOWS_KERNEL_ID, knobs.kernel},
          {GLOAM_SHADOWS_MIPS_ID, knobs.mips ? 1u : 0u},
          {GLOAM_SHADOWS_RECEIVER_PLANE_ID, knobs.receiver_plane ? 1u : 0u},
          {GLOAM_SHADOWS_BIAS_ID, knobs.oriented ? 1u : 0u},
          {GLOAM_SHADOWS_KERNEL_SHAPE_ID, knobs.square ? 1u : 0u},
          {GLOAM_SHADOWS_LEVELS_ID, knobs.levels},
          {GLOAM_SHADOWS_FULL_PENUMBRA_ID, knobs.early_outs ? 0u : 1u},
          {GLOAM_SHADOWS_COVERAGE_ID, knobs.mip_operator == GLOAM_SHADOW_MIPS_COVERAGE ? 1u : 0u},
          {GLOAM_SHADOWS_NEAR_ID, knobs.near},
          {GLOAM_SHADOWS_TERMINATOR_ID, knobs.terminator ? 1u : 0u}};
}

}  // namespace gloam

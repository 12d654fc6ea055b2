// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/knobs.h"

namespace gloam {

void add_reflection_knobs(KnobRegistry& registry) {
  add_knobs(registry, "reflections", kReflectionMode, kReflectionTiers, kReflectionTemporal, kReflectionPixelRoughness,
            kReflectionBlur, kReflectionDilation, kReflectionBump, kReflectionPixelNormals, kReflectionLightScale,
            kSsrK1, kSsrK2, kSsrReach, kSsrRefine, kSsrFullResolution, kSsrHierarchical, kProxyTiles, kProxyTileBound,
            kProxyLayers, kProxySort, kProxySphereTest, kNaiveProxyLoop, kReflectionRecapture, kIndirectLight);
}

ReflectionKnobs reflection_knobs(const KnobRegistry& registry) {
  ReflectionKnobs knobs;
  knobs.mode = registry.value(kReflectionMode);
  const ReflectionTiers tiers = registry.value(kReflectionTiers);
  knobs.screen_space = tiers.screen_space;
  knobs.proxies = tiers.proxies;
  // The mirrored picture takes the place of both.
  if (knobs.mode == ReflectionKnobs::Mode::planar) knobs.screen_space = knobs.proxies = false;
  knobs.temporal = registry.value(kReflectionTemporal);
  knobs.pixel_roughness = registry.value(kReflectionPixelRoughness);
  knobs.blur = registry.value(kReflectionBlur);
  knobs.dilation = registry.value(kReflectionDilation);
  knobs.bump = registry.value(kReflectionBump);
  // The mirrored picture has no rays.
  knobs.pixel_normals = registry.value(kReflectionPixelNormals) && knobs.mode != ReflectionKnobs::Mode::planar;
  knobs.light_scale = registry.value(kReflectionLightScale);
  knobs.k1 = static_cast<float>(registry.value(kSsrK1));
  knobs.k2 = static_cast<float>(registry.value(kSsrK2));
  knobs.reach_m = static_cast<float>(registry.value(kSsrReach));
  knobs.refine = registry.value(kSsrRefine);
  knobs.full_resolution = registry.value(kSsrFullResolution);
  knobs.hierarchical = registry.value(kSsrHierarchical);
  knobs.tiles.tiles = registry.value(kProxyTiles);
  knobs.tiles.bound = registry.value(kProxyTileBound);
  knobs.layers = registry.value(kProxyLayers);
  knobs.sort = registry.value(kProxySort);
  knobs.sphere_test = registry.value(kProxySphereTest);
  // Tiles hold the proxies that rays mirrored at horizontal planes may meet.
  knobs.naive = registry.value(kNaiveProxyLoop) || knobs.pixel_normals;
  knobs.recapture = registry.value(kReflectionRecapture);
  return knobs;
}

}  // namespace gloam

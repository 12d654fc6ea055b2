// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"

namespace gloam {

/// Square images of one size with all mips down to `last_side` texels, as layers of an image array. Texels are four
/// half floats; those of a layer follow each other mip by mip, rows from the top.
struct CapturedLayers {
  std::uint32_t side = 0;   ///< texels of mip 0, a power of two; 0: no layers
  std::uint32_t mips = 0;   ///< mip m has side >> m texels
  std::uint32_t count = 0;  ///< layers
  std::vector<std::uint16_t> texels;

  /// Halves (std::uint16_t) of one layer.
  [[nodiscard]] std::size_t layer_halves() const;
  /// Index of the first half of a mip within its layer.
  [[nodiscard]] std::size_t mip_offset(std::uint32_t mip) const;
};

/// A light that dims a proxy, as it was when the proxy was captured.
struct CapturedProxyLight {
  std::uint32_t layer = 0;  ///< of ReflectionCaptures::proxies
  Entity light = kNoEntity;
  float weight = 0.0f;  ///< its share of the light on the proxy, 0…1; those of one proxy sum to 1
};

/// A light's state at the time of capture.
struct CapturedLightState {
  Entity light = kNoEntity;
  vec3 emitted = vec3(0.0f);  ///< color · intensity: candela; directional: lux
};

/// Images of all proxies and probes of a world under its default lights: a world resource, made by bake_reflections()
/// or read from a cache. Without it (`content` 0) reflections use screen space and the sky only.
struct ReflectionCaptures {
  std::uint64_t content = 0;  ///< hash of all that the captures were made from; 0: there are none
  /// Factor from cd/m² to the images' half floats: a power of two, light_scale() of the world's brightness.
  float light_scale = 1.0f;
  /// One layer per proxy. Radiance in cd/m² · light_scale, premultiplied by alpha; alpha 0 where the capture met no
  /// surface. u runs along the node's +X, v from the top (+Y) to the bottom. Mips are box-filtered.
  CapturedLayers proxies;
  std::vector<Entity> proxy_entities;            ///< of each layer; entities with IbrProxy, by entity index
  std::vector<CapturedProxyLight> proxy_lights;  ///< by layer, then by entity index of the light
  /// One layer per probe: octahedral maps of radiance in cd/m² · light_scale. Texel (u, v) in 0…1 shows direction
  /// octahedral_decode(2 (u, v) − 1) with the axes (x, z, y) of the world: the middle of the image looks up (+Y), its
  /// corners look down. Mip m is prefiltered for roughness m / (mips − 1).
  CapturedLayers probes;
  std::vector<Entity> probe_entities;      ///< of each layer; entities with CubeProbe, by entity index
  std::vector<CapturedLightState> lights;  ///< all lights of the world, by entity index
  std::uint64_t version = 0;               ///< changes whenever another set of captures is put into the world
};

}  // namespace gloam

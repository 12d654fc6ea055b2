// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/lights/components.h"

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

/// What captures depend on in a light. A light with a NaN or an infinity in it emits nothing and has no place.
struct CapturedLightState {
  Entity light = kNoEntity;
  vec3 emitted = vec3(0.0f);  ///< color · intensity, each ≥ 0: candela; directional: lux
  LightKind kind = LightKind::point;
  float range_m = 0.0f;                    ///< Light::range_m; 0: as far as can be
  vec2 cone = vec2(0.0f);                  ///< spot: inner and outer half angle, radians; otherwise 0
  dvec3 position = dvec3(0.0);             ///< world; directional: 0
  dvec3 direction = dvec3(0.0, 0.0, 0.0);  ///< in which it shines, unit length; point: 0
  friend bool operator==(const CapturedLightState&, const CapturedLightState&) = default;
  /// Whether the two differ in nothing but what they emit.
  [[nodiscard]] bool same_place(const CapturedLightState& other) const {
    return kind == other.kind && range_m == other.range_m && cone == other.cone && position == other.position &&
           direction == other.direction;
  }
};

/// The surface that a probe shows in the middle of a cell of its map.
struct CapturedSurface {
  vec3 position = vec3(0.0f);  ///< from the probe, metres
  vec3 normal = vec3(0.0f);    ///< unit length, on the visible side; 0: the sky
};

/// The light of one capture by where it comes from. The image of the capture's own layer shows all of it.
struct CapturedParts {
  /// Layer of the same images with the part that no lamp causes: emission, and the sky with what it lights. −1: none.
  std::int32_t emission = -1;
  float surface_m = 0.0f;  ///< of a proxy: mean distance of what it shows, along its normal, from its rectangle
  std::vector<CapturedSurface> surfaces;  ///< of a probe: in kProbeCells × kProbeCells cells, rows from the top
  /// Illuminance by the lamps that count, lux, without shadows: mean of each cell of the image (CaptureFactors).
  std::vector<vec3> lamps_lux;
  float lit = 0.0f;    ///< mean luminance of the part that lamps cause, cd/m²
  float unlit = 0.0f;  ///< mean luminance of the other part, cd/m²
};

/// Values of the knob lighting.indirect: where light of the surroundings comes from.
enum class IndirectSource : std::uint8_t { sky, probes };
[[nodiscard]] constexpr std::string_view name_of(IndirectSource source) {
  switch (source) {
    case IndirectSource::sky:
      return "sky";
    case IndirectSource::probes:
      return "probes";
  }
  return {};
}

/// Terms of diffuse light: spherical harmonics of order 2.
inline constexpr std::size_t kDiffuseTerms = 9;

/// Diffuse light of a probe: terms of the mean radiance of the hemisphere around a normal, cd/m² (diffuse_value()). It
/// has the light of lamps and emission that has met one surface, and the sky as the probe sees it.
struct ProbeDiffuse {
  std::array<vec3, kDiffuseTerms> lamps{};  ///< the part that lamps cause
  std::array<vec3, kDiffuseTerms> unlit{};  ///< the rest
  /// Of a probe without a box: see ProbeNeighbourhood. 0 and 0: the light holds everywhere.
  float reach = 0.0f, open = 0.0f;
};

/// A place of a grid at which diffuse light was captured, for scenes without probes.
struct GridProbe {
  dvec3 center = dvec3(0.0);    ///< of its cell, world
  vec3 half = vec3(0.0f);       ///< of its cell, along the world's axes
  vec3 lamps_lux = vec3(0.0f);  ///< illuminance by lamps at capture, without shadows, from all sides together
  ProbeDiffuse diffuse;
};

/// Images of all proxies and probes of a world under its default lights: a world resource, made by bake_reflections()
/// or read from a cache. Without it (`content` 0) reflections use screen space and the sky only.
struct ReflectionCaptures {
  std::uint64_t content = 0;  ///< hash of all that the captures were made from; 0: there are none
  /// Factor from cd/m² to the images' half floats: a power of two, light_scale() of the world's brightness.
  float light_scale = 1.0f;
  /// One layer per proxy, then the layers that CapturedParts::emission names. Radiance in cd/m² · light_scale,
  /// premultiplied by alpha; alpha 0 where the capture met no surface. u runs along the node's +X, v from the top (+Y)
  /// to the bottom. Mips are box-filtered.
  CapturedLayers proxies;
  std::vector<Entity> proxy_entities;            ///< of each layer; entities with IbrProxy, by entity index
  std::vector<CapturedParts> proxy_parts;        ///< of each layer; empty: one without parts for all
  std::vector<CapturedProxyLight> proxy_lights;  ///< by layer, then by entity index of the light
  /// One layer per probe, then the layers that CapturedParts::emission names: octahedral maps of radiance in cd/m² ·
  /// light_scale. Texel (u, v) in 0…1 shows direction octahedral_decode(2 (u, v) − 1) with the axes (x, z, y) of the
  /// world: the middle of the image looks up (+Y), its corners look down. Mip m is prefiltered for roughness
  /// m / (mips − 1).
  CapturedLayers probes;
  std::vector<Entity> probe_entities;       ///< of each layer; entities with CubeProbe, by entity index
  std::vector<CapturedParts> probe_parts;   ///< of each layer; empty: one without parts for all
  std::vector<ProbeDiffuse> probe_diffuse;  ///< of each probe; empty: none
  std::vector<GridProbe> grid;              ///< in the order of its cells; empty: none was baked
  std::vector<CapturedLightState> lights;   ///< all lights of the world, by entity index
  std::uint64_t version = 0;                ///< changes whenever another set of captures is put into the world
};

}  // namespace gloam

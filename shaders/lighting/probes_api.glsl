// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_PROBES_API_GLSL
#define GLOAM_SHADERS_LIGHTING_PROBES_API_GLSL

#include "shaders/common/math.glsl"
#include "shaders/lighting/changed_light_api.glsl"
#include "shaders/lighting/probe_boxes_api.glsl"
#include "shaders/lighting/probes_shared.h"

// Cube probes: captured surroundings, as octahedral maps in the layers of `probe_images`, prefiltered by roughness in
// their mips. Include this after the image `probe_images` and the buffers `probe_rows` and `capture_factors`; rows are
// ordered: probes with a box from the smallest to the largest, then the global one.

// Whether a row may have factors; a shader may know better.
#ifndef GLOAM_FACTORS_IN_USE
#define GLOAM_FACTORS_IN_USE true
#endif

// Most rows that there may be; a shader may know it.
#ifndef GLOAM_MOST_PROBES
#define GLOAM_MOST_PROBES ~0u
#endif

// Point of a probe's map that shows a direction.
vec2 probe_uv(vec3 direction) { return octahedral_encode(direction.xzy) * 0.5 + 0.5; }

// Radiance that a layer shows at a point of its map, for a roughness.
vec3 probe_layer_radiance(float layer, vec2 uv, float roughness) {
  float lod = roughness * float(textureQueryLevels(probe_images) - 1);
  // The border of the image is the fold of the lower half: no texel beyond it may be filtered in.
  float half_texel = 0.5 * exp2(ceil(lod)) / float(textureSize(probe_images, 0).x);
  // Written so that NaN becomes a point of the image: a processor also looks up for threads that take no part.
  vec2 inside = mix(vec2(half_texel), min(uv, 1.0 - half_texel), greaterThan(uv, vec2(half_texel)));
  return textureLod(probe_images, vec3(inside, layer), lod).rgb;
}

// Radiance of a probe in a direction, with lamps as they are now. layer, emission, factor: of its row.
vec3 probe_radiance(float layer, float emission, float factor, vec3 direction, float roughness) {
  vec2 uv = probe_uv(direction);
  vec3 light = probe_layer_radiance(layer, uv, roughness);
  if (!GLOAM_FACTORS_IN_USE) return light;
  // Choices, not branches: where a uniform decides a branch, Mesa 22.3 compiles a shader for each of its values, and
  // may crash when it reads them.
  vec3 unscaled = probe_layer_radiance(max(emission, 0.0), uv, roughness) * float(emission >= 0.0);
  vec3 followed = followed_light(light, unscaled, captured_factor(max(factor, 0.0), GLOAM_PROBE_CELLS, uv));
  return mix(light, followed, bvec3(factor >= 0.0));
}

// The direction from the probe's centre to the point of its box that a ray from inside meets; of a probe without a box,
// the ray's.
vec3 parallax_direction(ProbeRow probe, vec3 at, vec3 position, vec3 direction) {
  vec3 along = in_probe_axes(probe, direction);
  along = mix(along, vec3(1e-9), lessThan(abs(along), vec3(1e-9)));
  vec3 distances = (sign(along) - at) / along;
  float distance_m = min(distances.x, min(distances.y, distances.z));
  vec3 toward = position + direction * max(distance_m, 0.0) - probe.center;
  return mix(toward, direction, bvec3(probe.global > 0.5));
}

// What to look up in a probe. Its row is not read again: at a place that differs between threads, that costs processors
// more than the lookup.
struct ProbeLookup {
  vec3 direction;
  float share;
  float layer, emission, factor;  // of its row
};

// The first two probes that have a share at a point of a surface. Others are left out: their share goes to these.
struct ChosenProbes {
  ProbeLookup first, second;
  float covered;  // share of all probes, 0…1; the rest is the sky's
};

const ProbeLookup kNoProbe = ProbeLookup(vec3(0.0, 1.0, 0.0), 0.0, 0.0, -1.0, -1.0);

void choose(inout ProbeLookup chosen, ProbeLookup probe, bool take) {
  chosen.direction = mix(chosen.direction, probe.direction, bvec3(take));
  chosen.share = mix(chosen.share, probe.share, take);
  chosen.layer = mix(chosen.layer, probe.layer, take);
  chosen.emission = mix(chosen.emission, probe.emission, take);
  chosen.factor = mix(chosen.factor, probe.factor, take);
}

void consider_probe(inout ChosenProbes chosen, ProbeRow probe, vec3 position, vec3 normal, vec3 direction) {
  vec3 at = place_in_probe(probe, position);
  float share = facing_share(probe, at, normal) * (1.0 - chosen.covered);
  vec3 toward = parallax_direction(probe, at, position, direction);
  ProbeLookup lookup = ProbeLookup(toward, share, probe.layer, probe.emission, probe.factor);
  chosen.covered += share;
  bvec2 empty = equal(vec2(chosen.first.share, chosen.second.share), vec2(0.0));
  choose(chosen.second, lookup, all(bvec3(share > 0.0, !empty.x, empty.y)));
  choose(chosen.first, lookup, all(bvec2(share > 0.0, empty.x)));
}

#ifndef GLOAM_CHOOSE_PROBES
ChosenProbes choose_probes(uint count, vec3 position, vec3 normal, vec3 direction) {
  ChosenProbes chosen = ChosenProbes(kNoProbe, kNoProbe, 0.0);
  for (uint i = 0u; i < count; ++i) consider_probe(chosen, probe_rows[i], position, normal, direction);
  return chosen;
}
#else
GLOAM_CHOOSE_PROBES
#endif

vec3 seen_in_probe(ProbeLookup probe, float roughness) {
  return probe.share * probe_radiance(probe.layer, probe.emission, probe.factor, probe.direction, roughness);
}

// Radiance of all probes for a reflected ray. normal: facing_share(). covered: how much of it the probes give, 0…1; the
// rest is the sky's.
vec3 probes_radiance(uint count, vec3 position, vec3 normal, vec3 direction, float roughness, out float covered) {
  ChosenProbes chosen = choose_probes(count, position, normal, direction);
  covered = chosen.covered;
  vec3 light = seen_in_probe(chosen.first, roughness);
  if (GLOAM_MOST_PROBES > 1u) light += seen_in_probe(chosen.second, roughness);
  return light * (covered / max(chosen.first.share + chosen.second.share, 1e-6));
}

// The same at a point without a surface.
vec3 probes_radiance(uint count, vec3 position, vec3 direction, float roughness, out float covered) {
  return probes_radiance(count, position, vec3(0.0), direction, roughness, covered);
}

#endif

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_PROBES_API_GLSL
#define GLOAM_SHADERS_REFLECTIONS_PROBES_API_GLSL

#include "shaders/common/math.glsl"
#include "shaders/reflections/reflections_shared.h"

// Where row i is; a shader may define it in another way.
#ifndef GLOAM_PROBE_ROW
#define GLOAM_PROBE_ROW(i) probe_rows[i]
#endif

// Cube probes: captured surroundings, as octahedral maps in the layers of `probe_images`, prefiltered by roughness in
// their mips. Include this after the image `probe_images` and the buffer `probe_rows`; rows are ordered: probes with a
// box from the smallest to the largest, then the global one.

// Radiance that the probe's layer shows in a direction, for a roughness.
vec3 probe_radiance(float layer, vec3 direction, float roughness) {
  float lod = roughness * float(textureQueryLevels(probe_images) - 1);
  vec2 uv = octahedral_encode(direction.xzy) * 0.5 + 0.5;
  // The border of the image is the fold of the lower half: no texel beyond it may be filtered in.
  float half_texel = 0.5 * exp2(ceil(lod)) / float(textureSize(probe_images, 0).x);
  return textureLod(probe_images, vec3(clamp(uv, half_texel, 1.0 - half_texel), layer), lod).rgb;
}

// Share of the probe at a point: 1 inside, falling to 0 toward the faces of its box.
float probe_share(ProbeRow probe, vec3 at) {
  if (probe.global > 0.5) return 1.0;
  vec3 inside = (1.0 - abs(at)) / probe.fade;
  return clamp(min(inside.x, min(inside.y, inside.z)), 0.0, 1.0);
}

// The direction from the probe's centre to the point of its box that a ray from inside meets.
vec3 parallax_direction(ProbeRow probe, vec3 at, vec3 position, vec3 direction) {
  vec3 along = vec3(dot(probe.to_x, direction), dot(probe.to_y, direction), dot(probe.to_z, direction));
  along = mix(along, vec3(1e-9), lessThan(abs(along), vec3(1e-9)));
  vec3 distances = (sign(along) - at) / along;
  float distance_m = min(distances.x, min(distances.y, distances.z));
  return position + direction * max(distance_m, 0.0) - probe.center;
}

// The lookup of a reflected ray in one probe.
struct ProbeLookup {
  vec3 toward;  // direction in the probe's map
  float layer;
  float share;  // 0: no probe
  uint index;
};

// The first probe from `first` on that has a share at the ray's origin.
ProbeLookup next_probe(uint first, uint count, vec3 position, vec3 direction) {
  ProbeLookup found = ProbeLookup(direction, 0.0, 0.0, count);
  for (uint i = 0u; i < count; ++i) {
    ProbeRow probe = GLOAM_PROBE_ROW(i);
    vec3 offset = position - probe.center;
    vec3 at = vec3(dot(probe.to_x, offset), dot(probe.to_y, offset), dot(probe.to_z, offset));
    float share = probe_share(probe, at);
    vec3 toward = probe.global > 0.5 ? direction : parallax_direction(probe, at, position, direction);
    bool taken = i >= first && share > 0.0 && found.index == count;
    found.toward = taken ? toward : found.toward;
    found.layer = taken ? probe.layer : found.layer;
    found.share = taken ? share : found.share;
    found.index = taken ? i : found.index;
  }
  return found;
}

// Radiance of all probes for a reflected ray. covered: how much of it the probes give, 0…1; the rest is the sky's.
// Most points lie in one probe: one lookup for each probe that has a share costs less than one for each probe.
vec3 probes_radiance(uint count, vec3 position, vec3 direction, float roughness, out float covered) {
  vec3 light = vec3(0.0);
  covered = 0.0;
  ProbeLookup probe = next_probe(0u, count, position, direction);
  while (probe.share > 0.0 && covered < 1.0) {
    float share = probe.share * (1.0 - covered);
    light += share * probe_radiance(probe.layer, probe.toward, roughness);
    covered += share;
    probe = next_probe(probe.index + 1u, count, position, direction);
  }
  return light;
}

#endif

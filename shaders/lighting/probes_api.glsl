// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_PROBES_API_GLSL
#define GLOAM_SHADERS_LIGHTING_PROBES_API_GLSL

#include "shaders/common/math.glsl"
#include "shaders/lighting/changed_light_api.glsl"
#include "shaders/lighting/probes_shared.h"

// Cube probes: captured surroundings, as octahedral maps in the layers of `probe_images`, prefiltered by roughness in
// their mips. Include this after the image `probe_images` and the buffers `probe_rows` and `capture_factors`; rows are
// ordered: probes with a box from the smallest to the largest, then the global one.

// Whether a row may have factors; a shader may know better.
#ifndef GLOAM_FACTORS_IN_USE
#define GLOAM_FACTORS_IN_USE true
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
  if (GLOAM_FACTORS_IN_USE && factor >= 0.0) {
    vec3 unscaled = vec3(0.0);
    if (emission >= 0.0) unscaled = probe_layer_radiance(emission, uv, roughness);
    light = followed_light(light, unscaled, captured_factor(factor, GLOAM_PROBE_CELLS, uv));
  }
  return light;
}

// Share of the probe at a point: 1 inside, falling to 0 toward the faces of its box.
float probe_share(ProbeRow probe, vec3 at) {
  if (probe.global > 0.5) return 1.0;
  vec3 inside = (1.0 - abs(at)) / probe.fade;
  return clamp(min(inside.x, min(inside.y, inside.z)), 0.0, 1.0);
}

// Where a point lies in the probe's box, −1…1 inside.
vec3 place_in_probe(ProbeRow probe, vec3 position) {
  vec3 offset = position - probe.center;
  return vec3(dot(probe.to_x, offset), dot(probe.to_y, offset), dot(probe.to_z, offset));
}

// Share of the probe at a point of a surface. A box that ends a little before the surface is that of the room behind
// it: its share is what it is further out, along the normal. normal: unit length; zero: a point without a surface.
float facing_share(ProbeRow probe, vec3 position, vec3 normal) {
  vec3 at = place_in_probe(probe, position);
  vec3 out_of_surface = vec3(dot(probe.to_x, normal), dot(probe.to_y, normal), dot(probe.to_z, normal));
  vec3 size = abs(out_of_surface);
  float longest = max(max(size.x, size.y), max(size.z, 1e-30));
  return min(probe_share(probe, at), probe_share(probe, at + out_of_surface * (probe.fade / longest)));
}

// The direction from the probe's centre to the point of its box that a ray from inside meets.
vec3 parallax_direction(ProbeRow probe, vec3 at, vec3 position, vec3 direction) {
  vec3 along = vec3(dot(probe.to_x, direction), dot(probe.to_y, direction), dot(probe.to_z, direction));
  along = mix(along, vec3(1e-9), lessThan(abs(along), vec3(1e-9)));
  vec3 distances = (sign(along) - at) / along;
  float distance_m = min(distances.x, min(distances.y, distances.z));
  return position + direction * max(distance_m, 0.0) - probe.center;
}

// The first two probes that have a share at a point of a surface. Others are left out: their share goes to these.
struct ChosenProbes {
  uvec2 rows;
  vec2 shares;
  float covered;  // share of all probes, 0…1; the rest is the sky's
};

void consider_probe(inout ChosenProbes chosen, ProbeRow probe, uint row, vec3 position, vec3 normal) {
  float share = facing_share(probe, position, normal) * (1.0 - chosen.covered);
  chosen.covered += share;
  bool is_first = share > 0.0 && chosen.shares.x == 0.0;
  bool is_second = share > 0.0 && !is_first && chosen.shares.y == 0.0;
  chosen.rows.x = is_first ? row : chosen.rows.x;
  chosen.rows.y = is_second ? row : chosen.rows.y;
  chosen.shares.x = is_first ? share : chosen.shares.x;
  chosen.shares.y = is_second ? share : chosen.shares.y;
}

#ifndef GLOAM_CHOOSE_PROBES
ChosenProbes choose_probes(uint count, vec3 position, vec3 normal) {
  ChosenProbes chosen = ChosenProbes(uvec2(0u), vec2(0.0), 0.0);
  for (uint i = 0u; i < count; ++i) consider_probe(chosen, probe_rows[i], i, position, normal);
  return chosen;
}
#else
GLOAM_CHOOSE_PROBES
#endif

vec3 seen_in_probe(uint row, vec3 position, vec3 direction, float roughness) {
  ProbeRow probe = probe_rows[row];
  vec3 toward = parallax_direction(probe, place_in_probe(probe, position), position, direction);
  return probe_radiance(probe.layer, probe.emission, probe.factor, probe.global > 0.5 ? direction : toward, roughness);
}

// Radiance of all probes for a reflected ray. normal: facing_share(). covered: how much of it the probes give, 0…1; the
// rest is the sky's.
vec3 probes_radiance(uint count, vec3 position, vec3 normal, vec3 direction, float roughness, out float covered) {
  ChosenProbes chosen = choose_probes(count, position, normal);
  covered = chosen.covered;
  vec3 light = vec3(0.0);
  light = chosen.shares.x * seen_in_probe(chosen.rows.x, position, direction, roughness);
  light += chosen.shares.y * seen_in_probe(chosen.rows.y, position, direction, roughness);
  return light * (covered / max(chosen.shares.x + chosen.shares.y, 1e-6));
}

// The same at a point without a surface.
vec3 probes_radiance(uint count, vec3 position, vec3 direction, float roughness, out float covered) {
  return probes_radiance(count, position, vec3(0.0), direction, roughness, covered);
}

#endif

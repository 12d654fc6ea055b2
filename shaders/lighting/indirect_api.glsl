// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_INDIRECT_API_GLSL
#define GLOAM_SHADERS_LIGHTING_INDIRECT_API_GLSL

#include "shaders/lighting/environment_api.glsl"
#include "shaders/lighting/indirect_shared.h"
#include "shaders/lighting/probe_boxes_api.glsl"

// Diffuse light of the surroundings: that of the probes by their boxes and, beyond them, that of sky and ground. Before
// including this, declare the uniform `environment` and define GLOAM_INDIRECT_BINDING, the first of two bindings;
// read_surroundings() binds them. Ramamoorthi and Hanrahan 2001, "An efficient representation for irradiance
// environment maps"; the light is windowed where it would be negative (modules/reflections/diffuse/harmonics.h).

// 0: sky and ground alone. Otherwise the rows of probes plus one, up to GLOAM_FEW_PROBES + 1; more:
// IndirectConstants::probes rows.
layout(constant_id = 31) const uint kIndirect = 0u;

layout(set = 0, binding = GLOAM_INDIRECT_BINDING, scalar) uniform Indirect { IndirectConstants indirect; };
layout(set = 0, binding = GLOAM_INDIRECT_BINDING + 1, scalar) readonly buffer DiffuseProbes {
  DiffuseProbe diffuse_probes[];
};

// Light of the surroundings at a surface.
struct SurroundingLight {
  vec3 radiance;  // mean of the hemisphere around the normal, weighted by the cosine
  float covered;  // share of it that is not the sky's, 0…1
};

// Mean radiance of the hemisphere around a normal as a probe has it.
vec3 diffuse_terms(DiffuseProbe probe, vec3 n) {
  vec3 light = probe.terms[0].rgb + n.y * probe.terms[1].rgb + n.z * probe.terms[2].rgb + n.x * probe.terms[3].rgb;
  light += (n.x * n.y) * probe.terms[4].rgb + (n.y * n.z) * probe.terms[5].rgb;
  light += (3.0 * n.z * n.z - 1.0) * probe.terms[6].rgb + (n.x * n.z) * probe.terms[7].rgb;
  light += (n.x * n.x - n.y * n.y) * probe.terms[8].rgb;
  return max(light, vec3(0.0));
}

// ∫ L(ω) (1 + n · ω) dω / 4π of the light L around a probe. n: at most unit length.
vec3 volume_terms(DiffuseProbe probe, vec3 n) {
  vec3 along = n.y * probe.terms[1].rgb + n.z * probe.terms[2].rgb + n.x * probe.terms[3].rgb;
  return max(probe.terms[0].rgb + 0.5 * along, vec3(0.0));  // a cosine lobe has twice that of the linear part
}

// Share of a probe without a box: all of it near the probe; far from it the sky's light takes its place if the probe
// sees the sky. 1 with a box.
float certain_share(DiffuseProbe probe, vec3 position) {
  vec3 away = position - probe.row.center;
  float square = min(dot(away, away) * probe.per_square_reach, 1e30);
  return 1.0 - probe.open * square / (1.0 + square);
}

// GLOAM_INDIRECT_VOLUME: for points without a surface; normal is n of volume_terms().
void add_diffuse_probe(inout SurroundingLight sum, DiffuseProbe probe, vec3 position, vec3 normal) {
#ifdef GLOAM_INDIRECT_VOLUME
  vec3 facing = vec3(0.0), light = volume_terms(probe, normal);
#else
  vec3 facing = normal, light = diffuse_terms(probe, normal);
#endif
  float share = facing_share(probe.row, place_in_probe(probe.row, position), facing) * (1.0 - sum.covered);
  share *= certain_share(probe, position);
  sum.radiance += share * light;
  sum.covered += share;
}

// normal: unit length; with GLOAM_INDIRECT_VOLUME n.
SurroundingLight surrounding_light(vec3 position, vec3 normal) {
  vec3 beyond = hemisphere_radiance(environment, normal);
  SurroundingLight sum = SurroundingLight(vec3(0.0), 0.0);
  // Not a loop: rows at constant places of a uniform are read once, not by each thread.
  if (kIndirect > 1u) add_diffuse_probe(sum, indirect.few_probes[0], position, normal);
  if (kIndirect > 2u) add_diffuse_probe(sum, indirect.few_probes[1], position, normal);
  if (kIndirect > 3u) add_diffuse_probe(sum, indirect.few_probes[2], position, normal);
  if (kIndirect > 4u) add_diffuse_probe(sum, indirect.few_probes[3], position, normal);
  if (kIndirect > 5u) add_diffuse_probe(sum, indirect.few_probes[4], position, normal);
  if (kIndirect > 6u) add_diffuse_probe(sum, indirect.few_probes[5], position, normal);
  if (kIndirect > 7u)
    for (uint i = 6u; i < indirect.probes; ++i) add_diffuse_probe(sum, diffuse_probes[i], position, normal);
  sum.radiance = kIndirect == 0u ? beyond : sum.radiance + (1.0 - sum.covered) * beyond;
  return sum;
}

// The diffuse ambient term, before occlusion: radiance toward the eye.
vec3 diffuse_surroundings(ShadingPoint p, SurroundingLight around) { return kPi * p.diffuse * around.radiance; }

// Radiance in the mirror direction of surfaces that do not show probes' pictures: the sky's, and within the probes the
// mean of the hemisphere: a dark room has no highlights of the sky.
vec3 mirrored_surroundings(ShadingPoint p, float roughness, SurroundingLight around) {
  vec3 sky = mirrored_radiance(environment, p, roughness);
  return around.covered > 0.0 ? mix(sky, around.radiance, around.covered) : sky;
}

#endif

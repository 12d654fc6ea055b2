// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_SURROUNDINGS_API_GLSL
#define GLOAM_SHADERS_LIGHTING_SURROUNDINGS_API_GLSL

#include "shaders/lighting/environment_api.glsl"
#include "shaders/lighting/probes_shared.h"

// What a surface mirrors of its surroundings: the probes and, beyond them, sky and ground. Before including this,
// declare the uniform `environment` and define GLOAM_SURROUNDINGS_BINDING, the first of four bindings;
// read_surroundings() binds them.

// 0: sky and ground alone, for all surfaces alike. 1: by the probes' rows, as far as a surface is reflective.
layout(constant_id = 26) const uint kReflects = 0u;
// Rows, up to GLOAM_FEW_PROBES; more: SurroundingsConstants::probes rows.
layout(constant_id = 27) const uint kProbes = 0u;
// 0: all lamps are as captured, no row has factors.
layout(constant_id = 28) const uint kFactors = 1u;
#define GLOAM_FACTORS_IN_USE (kFactors != 0u)
#define GLOAM_MOST_PROBES kProbes

layout(set = 0, binding = GLOAM_SURROUNDINGS_BINDING, scalar) uniform Surroundings {
  SurroundingsConstants surroundings;
};
layout(set = 0, binding = GLOAM_SURROUNDINGS_BINDING + 1, scalar) readonly buffer ProbeRows { ProbeRow probe_rows[]; };
layout(set = 0, binding = GLOAM_SURROUNDINGS_BINDING + 2) uniform sampler2DArray probe_images;
layout(set = 0, binding = GLOAM_SURROUNDINGS_BINDING + 3, scalar) readonly buffer CaptureFactors {
  vec4 capture_factors[];
};

// Calls visit(row) for each row; not a loop: rows at constant places of a uniform are read once, not by each thread.
#define GLOAM_FOR_EACH_PROBE(visit)                    \
  if (kProbes > 0u) visit(surroundings.few_probes[0]); \
  if (kProbes > 1u) visit(surroundings.few_probes[1]); \
  if (kProbes > 2u) visit(surroundings.few_probes[2]); \
  if (kProbes > 3u) visit(surroundings.few_probes[3]); \
  if (kProbes > 4u) visit(surroundings.few_probes[4]); \
  if (kProbes > 5u) visit(surroundings.few_probes[5]); \
  if (kProbes > 6u)                                    \
    for (uint i = 6u; i < surroundings.probes; ++i) visit(probe_rows[i]);

#define GLOAM_CONSIDER(row) consider_probe(chosen, row, position, normal, direction)
#define GLOAM_CHOOSE_PROBES                                                            \
  ChosenProbes choose_probes(uint count, vec3 position, vec3 normal, vec3 direction) { \
    ChosenProbes chosen = ChosenProbes(kNoProbe, kNoProbe, 0.0);                       \
    GLOAM_FOR_EACH_PROBE(GLOAM_CONSIDER)                                               \
    return chosen;                                                                     \
  }
#include "shaders/lighting/probes_api.glsl"

// The radiance of the surroundings that a point mirrors toward the eye, through fog. around: mirrored_radiance().
vec3 far_radiance(ShadingPoint p, vec3 around, float roughness) {
  vec3 light = around;
  if (kProbes != 0u) {
    float covered;
    light =
        probes_radiance(surroundings.probes, p.position, p.normal, reflect(-p.to_eye, p.normal), roughness, covered);
    light = light * surroundings.probe_scale + around * (1.0 - covered);
  }
  return light * surroundings.fog_through + surroundings.fog_light;
}

// The specular ambient term, before occlusion: radiance toward the eye. around: mirrored_radiance().
vec3 specular_surroundings(ShadingPoint p, float roughness, float reflectivity, vec3 around) {
  return specular_share(p, roughness) * mix(around, far_radiance(p, around, roughness), reflectivity);
}

#endif

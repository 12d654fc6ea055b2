// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_ENVIRONMENT_API_GLSL
#define GLOAM_SHADERS_LIGHTING_ENVIRONMENT_API_GLSL

#include "shaders/lighting/brdf_api.glsl"
#include "shaders/lighting/lighting_shared.h"

// Light of the surroundings (sky and ground): the light of the scene that comes from no light source. The constants
// are the uniform `environment` that read_lighting() binds.

// Radiance of the sky (and of the ground, below the horizon) in a unit direction.
vec3 sky_radiance(EnvironmentConstants sky, vec3 direction) {
  float up = direction.y;
  return mix(sky.horizon.rgb, up >= 0.0 ? sky.zenith.rgb : sky.ground.rgb, sqrt(abs(up)));
}

// Mean radiance of the hemisphere around the normal: the sky above, the ground below.
vec3 hemisphere_radiance(EnvironmentConstants sky, vec3 normal) {
  vec3 above = mix(sky.horizon.rgb, sky.zenith.rgb, 0.5);
  return mix(sky.ground.rgb, above, 0.5 + 0.5 * normal.y);
}

// The diffuse ambient term, before occlusion: radiance toward the eye.
vec3 diffuse_ambient(EnvironmentConstants sky, ShadingPoint p) {
  return kPi * p.diffuse * hemisphere_radiance(sky, p.normal);
}

// Share of the mirrored radiance that a point reflects toward the eye: the fit of Karis 2014 to the split-sum integral.
vec3 specular_share(ShadingPoint p, float roughness) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * p.n_dot_v)) * r.x + r.y;
  vec2 scale_bias = vec2(-1.04, 1.04) * a + r.zw;
  return p.f0 * scale_bias.x + scale_bias.y;
}

// Radiance of the surroundings in the mirror direction: of one direction on a smooth surface, of the hemisphere on a
// rough one.
vec3 mirrored_radiance(EnvironmentConstants sky, ShadingPoint p, float roughness) {
  vec3 mirrored = reflect(-p.to_eye, p.normal);
  return mix(sky_radiance(sky, mirrored), hemisphere_radiance(sky, p.normal), roughness);
}

// The specular ambient term, before occlusion: radiance toward the eye. With SpecularAmbientTaken, deferred lighting
// leaves out exactly occlusion · specular_ambient().
vec3 specular_ambient(EnvironmentConstants sky, ShadingPoint p, float roughness) {
  return specular_share(p, roughness) * mirrored_radiance(sky, p, roughness);
}

// Radiance of the surroundings that a point reflects toward the eye.
vec3 ambient(EnvironmentConstants sky, ShadingPoint p, float roughness, float occlusion) {
  return occlusion * (diffuse_ambient(sky, p) + specular_ambient(sky, p, roughness));
}

#endif

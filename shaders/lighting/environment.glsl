// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_ENVIRONMENT_GLSL
#define GLOAM_SHADERS_LIGHTING_ENVIRONMENT_GLSL

#include "shaders/lighting/brdf.glsl"
#include "shaders/lighting/lighting_shared.h"

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

// Radiance of the surroundings that a point reflects; specular by the fit of Karis 2014 to the split-sum integral.
vec3 ambient(EnvironmentConstants sky, ShadingPoint p, float roughness, float occlusion) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * p.n_dot_v)) * r.x + r.y;
  vec2 scale_bias = vec2(-1.04, 1.04) * a + r.zw;
  vec3 mirrored = reflect(-p.to_eye, p.normal);
  vec3 specular = (p.f0 * scale_bias.x + scale_bias.y) *
                  mix(sky_radiance(sky, mirrored), hemisphere_radiance(sky, p.normal), roughness);
  return occlusion * (kPi * p.diffuse * hemisphere_radiance(sky, p.normal) + specular);
}

#endif

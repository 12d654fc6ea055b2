// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_PARTICLES_LIGHTING_SCATTERED_LIGHT_GLSL
#define GLOAM_SHADERS_PARTICLES_LIGHTING_SCATTERED_LIGHT_GLSL

// Light that a particle scatters towards the eye. Before including this, declare the uniforms `view` and `frame`, and
// define GLOAM_PARTICLE_LIGHT_BINDING, the first of six bindings for the emitters, the maps and the light block and
// environment, and of three more with GLOAM_FORWARD_COOKIES; the 15th and 16th are those of indirect_api.glsl.
//
// A particle is a small volume, without a surface. Of the light L from all directions ω it scatters
//   albedo · ∫ L(ω) (1 + n · ω) dω / 4π
// where n, shorter than 1, points out of the plume and out of the sprite: it stands for the light that the plume itself
// keeps away from the far side. Only ∫ L dω and ∫ L ω dω enter, which are the texels of the baked light. Shadow maps
// are not looked up: sprites would show their planes.

#define GLOAM_FORWARD_RESPONSE
#include "shaders/common/math.glsl"
#include "shaders/particles/particles_shared.h"

layout(constant_id = 2) const uint kMaps = 0u;  // 1: some emitter has baked light

layout(set = 0, binding = GLOAM_PARTICLE_LIGHT_BINDING) uniform sampler3D flux_red;
layout(set = 0, binding = GLOAM_PARTICLE_LIGHT_BINDING + 1) uniform sampler3D flux_green;
layout(set = 0, binding = GLOAM_PARTICLE_LIGHT_BINDING + 2) uniform sampler3D flux_blue;
layout(set = 0, binding = GLOAM_PARTICLE_LIGHT_BINDING + 3) uniform sampler3D baked_visibility;

#define GLOAM_FORWARD_BINDING (GLOAM_PARTICLE_LIGHT_BINDING + 4)
#include "shaders/lighting/forward_lights_api.glsl"
#define GLOAM_INDIRECT_BINDING (GLOAM_PARTICLE_LIGHT_BINDING + 14)
#define GLOAM_INDIRECT_VOLUME
#include "shaders/lighting/indirect_api.glsl"

// p.normal: n. p.diffuse: albedo / 4π.
vec3 light_response(ShadingPoint p, vec3 to_light, vec3 illuminance) {
  return illuminance * p.diffuse * (1.0 + dot(p.normal, to_light));
}

// Position in the atlas of maps; clamped to the middle of the emitter's outermost texels.
vec3 map_place(ParticleEmitterRow e, vec3 position) {
  vec3 texel = clamp((position - e.map_from) * e.map_scale, vec3(0.5), e.map_size - 0.5);
  return (texel + vec3(0.0, 0.0, e.map_slice)) * frame.atlas_scale;
}

vec3 baked_light(ParticleEmitterRow e, ShadingPoint p, vec3 place) {
  vec4 n = vec4(p.normal, 1.0);
  vec3 sum = vec3(dot(textureLod(flux_red, place, 0.0), n), dot(textureLod(flux_green, place, 0.0), n),
                  dot(textureLod(flux_blue, place, 0.0), n));
  return p.diffuse * max(sum, vec3(0.0)) * e.map_light_scale;
}

vec3 one_light(ShadingPoint p, uint light) {
  if ((light & GLOAM_PARTICLE_DIRECTIONAL) == 0u) return forward_light(p, light, lights.local[light]);
  uint index = light & ~GLOAM_PARTICLE_DIRECTIONAL;
  DirectionalLight d = lights.directional[index];
  return light_response(p, -d.direction, arriving_directional(d.color, index, d.direction, p.normal));
}

// Radiance towards the eye of an opaque particle of the emitter. outward: n for forward = 1.
vec3 scattered_light(ParticleEmitterRow e, vec3 position, vec3 outward) {
  ShadingPoint p;
  p.position = position;
  p.normal = e.forward * outward;
  p.to_eye = vec3(0.0);
  p.diffuse = e.albedo / (4.0 * kPi);
  set_receiver(position, p.normal, false);
  vec3 light;
  vec4 visibility = vec4(1.0);
  if (kMaps != 0u && e.map_slice >= 0.0) {
    vec3 place = map_place(e, position);
    light = baked_light(e, p, place);
    // Maps hold the light of sky and ground. That of the probes takes its place.
    if (kIndirect != 0u) {
      vec3 difference = surrounding_light(position, p.normal).radiance - hemisphere_radiance(environment, p.normal);
      light = max(light + e.albedo * difference, vec3(0.0));
    }
    visibility = textureLod(baked_visibility, place, 0.0);
  } else {
    light = e.albedo * surrounding_light(position, p.normal).radiance;
  }
  for (uint i = 0u; i < e.light_count; ++i) {
    uint channel = e.light_channels[i];
    float share = e.light_weights[i] * (channel < GLOAM_PARTICLE_UNBAKED ? visibility[channel] : 1.0);
    light += share * one_light(p, e.lights[i]);
  }
  return min(light, vec3(65504.0));
}

// The direction n of a point of a sprite: out of the plume, and out of the sprite. plume: Particle::outward. corner:
// the point's place in the sprite, −1…1 along the picture's axes.
vec3 outward_direction(uint plume, vec2 corner) {
  vec3 outward = (vec3(uvec3(plume, plume >> 10u, plume >> 20u) & 1023u) - 512.0) / 511.0;
  return outward + 0.22 * (corner.x * frame.right + corner.y * frame.up);
}

#endif

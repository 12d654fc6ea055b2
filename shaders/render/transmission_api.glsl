// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_TRANSMISSION_API_GLSL
#define GLOAM_SHADERS_RENDER_TRANSMISSION_API_GLSL

// Light through thin parts (gloam.subsurface). The side of a body that faces away from a light gets the light that has
// crossed the body: transmitted() of brdf_api.glsl, times the transmittance of the body's thickness (Beer-Lambert).

// 1: the scene has materials that let light through; 0: no shader spends anything on them.
layout(constant_id = 23) const uint kTransmission = 0u;

// Extinction length in metres of a texel of the geometry buffer: alpha of its emissive colour is the square root, which
// keeps lengths from 4 nm up in the range of normal half floats. 0: no light passes.
float decode_extinction(float emissive_alpha) { return emissive_alpha * emissive_alpha; }

// Share of the light that is left after thickness_m metres inside the body.
float transmittance_of(float thickness_m, float extinction_m) { return exp(-max(thickness_m, 0.0) / extinction_m); }

// The extinction length for light from this direction: 0 if it arrives on the side of the shading normal, where it is
// reflected.
float extinction_behind(float extinction_m, vec3 normal, vec3 to_light) {
  return kTransmission != 0u && dot(normal, to_light) < 0.0 ? extinction_m : 0.0;
}

#endif

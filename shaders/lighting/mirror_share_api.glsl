// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_MIRROR_SHARE_API_GLSL
#define GLOAM_SHADERS_LIGHTING_MIRROR_SHARE_API_GLSL

// How surfaces take part in reflections.

const float kFullTilt = 0.966;  // cosine of 15°: up to here a surface counts as horizontal
const float kMostTilt = 0.866;  // cosine of 30°: from here on it has probes alone
const float kSmooth = 0.38;     // roughness up to which mirrored images are blurred
const float kTooRough = 0.49;   // roughness from which on the prefiltered probes serve alone
const float kLeastRise = 1e-4;  // sine of the least angle between a mirrored ray and the horizon
const float kStrong = 0.3;      // reflectivity of metals, and of smooth surfaces

// Share of the reflection that comes from mirrored images, 0…1; the probes have the rest. up: y of the face normal;
// rise: y of the unit direction to the eye. The underside of a surface mirrors nothing in this way.
float mirror_share(float up, float rise, float roughness, float reflectivity) {
  float tilt = smoothstep(kMostTilt, kFullTilt, up);
  return reflectivity > 0.0 && rise > kLeastRise ? tilt * (1.0 - smoothstep(kSmooth, kTooRough, roughness)) : 0.0;
}

// Whether a surface's reflection shows details. Others mirror a few hundredths of their surroundings, blurred: blocks
// of their pixels share what they mirror (SurroundingsOutput).
bool reflects_strongly(float roughness, float reflectivity) {
  return reflectivity > kStrong || (reflectivity > 0.0 && roughness < kTooRough);
}

#endif

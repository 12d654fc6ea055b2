// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_CHANGED_LIGHT_API_GLSL
#define GLOAM_SHADERS_LIGHTING_CHANGED_LIGHT_API_GLSL

// Where factor i is; a shader may define it in another way.
#ifndef GLOAM_CAPTURE_FACTOR
#define GLOAM_CAPTURE_FACTOR(i) capture_factors[i].rgb
#endif

// Captured light of proxies and probes, after lamps have changed since the capture. Factors scale the part that lamps
// cause: theirs now, as a share of that at capture, in a grid over the captured image. The rest (emission, the sky and
// what it lights) is in a layer of its own. With all lamps as captured a row has no factors, and one fetch shows the
// sum of both. Include this after the buffer `capture_factors` (vec4).

// Factor at a point of an image, interpolated between the middles of its side × side cells. first: ≥ 0.
vec3 captured_factor(float first, int side, vec2 uv) {
  vec2 at = clamp(uv * float(side) - 0.5, vec2(0.0), vec2(float(side - 1)));
  int x = min(int(at.x), side - 2), y = min(int(at.y), side - 2), corner = int(first) + y * side + x;
  vec2 t = at - vec2(x, y);
  vec3 upper = mix(GLOAM_CAPTURE_FACTOR(corner), GLOAM_CAPTURE_FACTOR(corner + 1), t.x);
  vec3 lower = mix(GLOAM_CAPTURE_FACTOR(corner + side), GLOAM_CAPTURE_FACTOR(corner + side + 1), t.x);
  return mix(upper, lower, t.y);
}

// all: the captured light. unscaled: the part of it that is not scaled.
vec3 followed_light(vec3 all, vec3 unscaled, vec3 factor) { return unscaled + factor * max(all - unscaled, vec3(0.0)); }

#endif

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_FORWARD_LIGHTS_API_GLSL
#define GLOAM_SHADERS_LIGHTING_FORWARD_LIGHTS_API_GLSL

// Sums the lights of the view at points that the shader chooses, such as fragments of blended surfaces, vertices and
// particles. Works in every shader stage.
//
// Before including this, declare the uniform `view` (ViewConstants), and define:
//   GLOAM_FORWARD_BINDING     the first of six bindings: lights, environment, grid, light_texels, z_bin_words,
//   mask_tiles GLOAM_FORWARD_TILED       only in frames with ForwardLighting::tiled. The loop visits the lights in the
//   mask of the
//                             pixel's 32×32 tile that are in the zBin of the point's depth. Otherwise it visits all
//                             lights and declares only the first two bindings. Both give the same sum.
//   GLOAM_FORWARD_SHADOWS     with shadows and cookies: six more bindings (shadows_api.glsl). With
//                             GLOAM_SHADOWS_STANDARD, only the standard filter is compiled. Shaders that are not
//                             fragment shaders define GLOAM_SHADOWS_PIXEL
//   GLOAM_FORWARD_COOKIES     with cookies but without shadows: three more bindings (cookies_api.glsl)
//   GLOAM_FORWARD_RESPONSE    the shader defines light_response() itself
// ForwardLighting (modules/lighting/outputs.h) says which of these a frame needs; read_lighting() binds the inputs.
//
// Usage:
//   set_receiver(position, face_normal, subsurface);
//   extinction_m = …;  if light passes through the surface, see transmission_api.glsl
//   vec3 light = emissive + ambient(environment, p, roughness, occlusion);
//   add_forward_lights(light, p, pixel);

#include "shaders/lighting/environment_api.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"

layout(set = 0, binding = GLOAM_FORWARD_BINDING, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = GLOAM_FORWARD_BINDING + 1, scalar) uniform Environment { EnvironmentConstants environment; };

#ifdef GLOAM_FORWARD_SHADOWS
#define GLOAM_SHADOWS_BINDING (GLOAM_FORWARD_BINDING + 6)
#elif defined(GLOAM_FORWARD_COOKIES)
#define GLOAM_COOKIES_BINDING (GLOAM_FORWARD_BINDING + 6)
#endif
#ifdef GLOAM_FORWARD_RESPONSE
#define GLOAM_LIGHT_FROM_BEHIND
#endif
#include "shaders/lighting/arriving_light.glsl"

// Radiance toward the eye for an illuminance (on a plane that faces the light) from the unit direction `to_light`. A
// shader's own response may also use light from behind the surface (dot(p.normal, to_light) < 0).
#ifdef GLOAM_FORWARD_RESPONSE
vec3 light_response(ShadingPoint p, vec3 to_light, vec3 illuminance);
#endif

// The response to a light of this apparent radius, in radians; a shader's own response is that to a point.
vec3 response_to(ShadingPoint p, vec3 to_light, vec3 illuminance, float half_angle) {
#ifdef GLOAM_FORWARD_RESPONSE
  return light_response(p, to_light, illuminance);
#else
  vec3 light = reflected_disc(p, to_light, illuminance, half_angle);
  if (extinction_behind(extinction_m, p.normal, to_light) > 0.0)
    light += p.diffuse * light_through(p, to_light, illuminance);
  return light;
#endif
}

// Radiance from a local light.
vec3 forward_light(ShadingPoint p, uint index, LocalLight light) {
  vec3 to_light;
  vec3 illuminance = local_illuminance(light, p.position, to_light);
  illuminance = arriving_local(illuminance, index, light.position, p.normal, to_light);
  return response_to(p, to_light, illuminance, half_angle_of(index, light.position - p.position));
}

#ifdef GLOAM_FORWARD_TILED
#define GLOAM_Z_BINS_BINDING (GLOAM_FORWARD_BINDING + 4)
#include "shaders/lights/z_bins_api.glsl"

layout(set = 0, binding = GLOAM_FORWARD_BINDING + 2, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = GLOAM_FORWARD_BINDING + 3) uniform sampler2D light_texels;
layout(set = 0, binding = GLOAM_FORWARD_BINDING + 5, scalar) readonly buffer MaskTiles { uint mask_tiles[]; };

LocalLight forward_local(uint index) { return fetch_light(light_texels, index); }
#else
LocalLight forward_local(uint index) { return lights.local[index]; }
#endif

uint lowest_bit(uint bits) { return bits & (~bits + 1u); }
uint lowest_light(uint word, uint bits) { return word * 32u + uint(findLSB(bits)); }

#ifdef GLOAM_FORWARD_SHADOWS
// Software devices execute a loop's whole body while any of their threads is in the loop, and the filter for each light
// that one of them visits. So lights are sorted first, in loops of short bodies: each thread then visits only those
// that it needs. The loops test their condition at the end, see shaders/shadows/filter/space.glsl.

// Of these lights of a mask word, those that reach the point.
uint reaching_lights(ShadingPoint p, uint word, uint bits) {
  uint found = 0u;
  if (bits != 0u) do {
      vec3 to_light;
      vec3 illuminance = local_illuminance(forward_local(lowest_light(word, bits)), p.position, to_light);
      found |= gives_light(illuminance, p.normal, to_light) ? lowest_bit(bits) : 0u;
      bits &= bits - 1u;
    } while (bits != 0u);
  return found;
}

// Of the lights that reach the point, x: those that are visible, y: those whose visibility the filter must find.
uvec2 certain_lights(ShadingPoint p, uint word, uint bits) {
  if (!kCertainBeforeFilter) return uvec2(0u, bits);
  uvec2 found = uvec2(0u);
  if (bits != 0u) do {
      uint index = lowest_light(word, bits);
      LocalLight light = forward_local(index);
      float share = certain_local_visibility(index, light.position, receiver);
      bool behind = kTransmission != 0u && dot(p.normal, light.position - p.position) <= 0.0;
      found.x |= share == 1.0 && !behind ? lowest_bit(bits) : 0u;
      found.y |= share < 0.0 || behind ? lowest_bit(bits) : 0u;
      bits &= bits - 1u;
    } while (bits != 0u);
  return found;
}

// Radiance from a local light that the point sees.
vec3 unshadowed_light(ShadingPoint p, uint index, LocalLight light) {
  vec3 to_light;
  vec3 illuminance = local_illuminance(light, p.position, to_light);
  illuminance = through_cookie(illuminance, index, light.position);
  return response_to(p, to_light, illuminance, half_angle_of(index, light.position - p.position));
}

// Radiance from these lights of a mask word.
vec3 forward_word(ShadingPoint p, uint word, uint bits) {
  uvec2 sorted = certain_lights(p, word, reaching_lights(p, word, bits));
  vec3 sum = vec3(0.0);
  if (sorted.x != 0u) do {
      uint index = lowest_light(word, sorted.x);
      sum += unshadowed_light(p, index, forward_local(index));
      sorted.x &= sorted.x - 1u;
    } while (sorted.x != 0u);
  if (sorted.y != 0u) do {
      uint index = lowest_light(word, sorted.y);
      sum += forward_light(p, index, forward_local(index));
      sorted.y &= sorted.y - 1u;
    } while (sorted.y != 0u);
  return sum;
}
#else
vec3 forward_word(ShadingPoint p, uint word, uint bits) {
  vec3 sum = vec3(0.0);
  for (; bits != 0u; bits &= bits - 1u) {
    uint index = lowest_light(word, bits);
    sum += forward_light(p, index, forward_local(index));
  }
  return sum;
}
#endif

// Radiance from local lights, summed by mask words, in an order within each word that depends only on the lights that
// reach the point: versions that leave out other lights get bit-identical sums.
#ifdef GLOAM_FORWARD_TILED
vec3 forward_local_lights(ShadingPoint p, uvec2 pixel) {
  vec3 sum = vec3(0.0);
  float depth_m = view_depth(view, p.position);
  uvec2 range = z_bin_range(grid, depth_m, depth_m);
  uvec2 tile = pixel / uint(GLOAM_LIGHT_TILE);
  uint mask = (tile.y * grid.mask_tiles.x + tile.x) * uint(GLOAM_MASK_WORDS);
  uint words = range.x < range.y ? z_bin_bits(uvec2(range.x >> 5, (range.y + 31u) >> 5), 0u) : 0u;
  for (uint groups = mask_tiles[mask] & words; groups != 0u; groups &= groups - 1u) {
    uint word = uint(findLSB(groups));
    sum += forward_word(p, word, mask_tiles[mask + 1u + word] & z_bin_bits(range, word));
  }
  return sum;
}
#else
vec3 forward_local_lights(ShadingPoint p, uvec2 pixel) {
  vec3 sum = vec3(0.0);
  for (uint first = 0u; first < lights.local_count; first += 32u)
    sum += forward_word(p, first >> 5u, ~0u >> (32u - min(lights.local_count - first, 32u)));
  return sum;
}
#endif

// Adds the radiance from all lights to `light`. Call set_receiver() first, with the point's camera-relative position.
// pixel: the pixel of the view that shows the point; must be inside the picture. Without GLOAM_FORWARD_TILED it is not
// used, so points outside of the view need the other version.
void add_forward_lights(inout vec3 light, ShadingPoint p, uvec2 pixel) {
  for (uint i = 0u; i < lights.directional_count; ++i) {
    DirectionalLight d = lights.directional[i];
    light += response_to(p, -d.direction, arriving_directional(d.color, i, d.direction, p.normal), d.half_angle);
  }
  light += forward_local_lights(p, pixel);
}

#endif

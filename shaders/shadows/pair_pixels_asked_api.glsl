// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_PAIR_PIXELS_ASKED_API_GLSL
#define GLOAM_SHADERS_SHADOWS_PAIR_PIXELS_ASKED_API_GLSL

#include "shaders/shadows/pair_pixels_api.glsl"

// The pixel loop; see pair_pixels_api.glsl.

PixelOfPair pixel_of_pair(LightOfPair light, uvec2 pixel) {
  ivec2 at = ivec2(min(pixel, view.size - 1u));
  float depth = texelFetch(depth_image, at, 0).r;
  vec3 position = relative_position(view, vec2(at), max(depth, 1e-30));
  uvec2 normals = texelFetch(normal_image, at, 0).xy;
  bool subsurface = texelFetch(base_color_image, at, 0).a > 0.5;
  PixelOfPair p;
  float cosine = light_cosine(light, position, unpack_normal(normals.x));
  p.extinction_m = 0.0;
  if (kTransmission != 0u && cosine < 0.0) p.extinction_m = decode_extinction(texelFetch(emissive_image, at, 0).a);
  p.matters = depth > 0.0 && all(lessThan(pixel, view.size)) && (cosine > 0.0 || p.extinction_m > 0.0);
  p.point = shadow_point(light, pixel_receiver(position, unpack_normal(normals.y), subsurface, at));
  p.point.live = p.point.live && p.matters;
  return p;
}

uvec2 pixel_at(uvec2 tile, uint pixel) { return tile * uint(GLOAM_SHADOW_TILE) + uvec2(pixel & 7u, pixel >> 3); }

// Evaluates the tile's pixels. First each thread evaluates its own pixels as far as possible without the filter; then
// the pixels that need the filter are distributed over all threads, then those with near blockers, and then those that
// take light from behind. A loop each: within the first, the rare pixels of the others would cost all pixels time.
void ask_pixels(LightOfPair light, uvec2 tile, uint lane) {
  uint some = 0u, i = 0u, steps;
  do {
    uint pixel = lane * kPixels + i;
    PixelOfPair p = pixel_of_pair(light, pixel_at(tile, pixel));
    bool known = true;
    float visibility, width = 0.0;
    uint sectors = 0u;
    bool live = p.point.live, behind = kTransmission != 0u && p.matters && p.extinction_m > 0.0;
    p.point.live = live && !behind;
    if (kFilter == 3u)
      known = known_before_filter(p.point, visibility, width, sectors) || !p.matters;
    else
      visibility = unquantised_visibility(p.point);
    p.point.live = live;
    widths[pixel] = width;
    uint says = keep_visibility(pixel, p, visibility, steps);
    if (behind) {
      filtered[uint(GLOAM_SLOT_PIXELS) - 1u - atomicAdd(behind_count, 1u)] = pixel;
    } else if (known) {
      some |= says;
      pack_own_steps(pixel, steps);
    } else if (width < 0.0) {
      near_pixels[atomicAdd(near_count, 1u)] = pixel | sectors << 8;
    } else {
      filtered[atomicAdd(filtered_count, 1u)] = pixel;
    }
  } while (++i < kPixels);
  keep_own_words(lane);
  if (some != 0u) atomicOr(found, some);
  barrier();
  uint count = kFilter == 3u ? filtered_count : 0u;
  i = lane;
  if (i < count) do {
      uint pixel = filtered[i];
      PixelOfPair p = pixel_of_pair(light, pixel_at(tile, pixel));
      uint says = keep_visibility(pixel, p, kernel_visibility(p.point, widths[pixel]), steps);
      atomicOr(found, says);  // in the loop, not once after it: see never()
      pack_steps(pixel, steps);
      i += kThreads;
    } while (i < count);
  count = kFilter == 3u && kNear != 0u ? near_count : 0u;
  i = lane;
  if (i < count) do {
      uint pixel = near_pixels[i] & 255u, sectors = near_pixels[i] >> 8;
      PixelOfPair p = pixel_of_pair(light, pixel_at(tile, pixel));
      uint says = keep_visibility(pixel, p, near_visibility(p.point, -widths[pixel], sectors), steps);
      atomicOr(found, says);
      pack_steps(pixel, steps);
      i += kThreads;
    } while (i < count);
  count = kTransmission != 0u ? behind_count : 0u;
  i = lane;
  if (i < count) do {
      uint pixel = filtered[uint(GLOAM_SLOT_PIXELS) - 1u - i];
      PixelOfPair p = pixel_of_pair(light, pixel_at(tile, pixel));
      uint says = keep_visibility(pixel, p, transmittance(p.point, p.extinction_m), steps);
      atomicOr(found, says);
      pack_steps(pixel, steps);
      i += kThreads;
    } while (i < count);
}

#endif

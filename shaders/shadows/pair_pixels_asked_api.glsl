// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_PAIR_PIXELS_ASKED_API_GLSL
#define GLOAM_SHADERS_SHADOWS_PAIR_PIXELS_ASKED_API_GLSL

#include "shaders/shadows/pair_pixels_api.glsl"

// The pixel loop; see pair_pixels_api.glsl. Set leaves_out_pixels where keep_visibility() need not be called for pixels
// that the light does not illuminate, and there may be many of them. They are then left out of the loop.

uvec2 pixel_at(uvec2 tile, uint pixel) { return tile * uint(GLOAM_SHADOW_TILE) + uvec2(pixel & 7u, pixel >> 3); }

#ifdef GLOAM_PAIR_LISTS_PIXELS
const bool kListsPixels = true;
#else
const bool kListsPixels = false;
#endif
bool leaves_out_pixels = false;

PixelOfPair pixel_of_pair(LightOfPair light, uvec2 tile, uint in_tile) {
  uvec2 pixel = pixel_at(tile, in_tile);
  ivec2 at = ivec2(min(pixel, view.size - 1u));
  float depth = texelFetch(depth_image, at, 0).r;
  vec3 position = relative_position(view, vec2(at), max(depth, 1e-30));
  uvec2 normals = texelFetch(normal_image, at, 0).xy;
  float alpha = texelFetch(base_color_image, at, 0).a;
  PixelOfPair p;
  float cosine = light_cosine(light, position, unpack_normal(normals.x));
  p.extinction_m = 0.0;
  if (kTransmission != 0u && cosine < 0.0) p.extinction_m = decode_extinction(texelFetch(emissive_image, at, 0).a);
  p.matters = depth > 0.0 && all(lessThan(pixel, view.size)) && (cosine > 0.0 || p.extinction_m > 0.0);
  ShadowReceiver receiver = pixel_receiver(position, unpack_normal(normals.y), alpha > 0.5, at);
  receiver.thin = kThinFilter != 0u && is_thin(alpha);
  p.point = shadow_point(light, receiver);
  p.point.live = p.point.live && p.matters;
  return p;
}

// Whether ask_pixels() evaluates GLOAM_DIM_PIXELS pixels only, for dim lights: few_pixel() of each row.
bool asks_few = false;
// One pixel in each row, and one in each column.
uint few_pixel(uint row) { return row << 3 | ((5u * row + 2u) & 7u); }

// Whether the light may matter at a pixel. Costs less than pixel_of_pair().
bool may_matter(LightOfPair light, uvec2 tile, uint in_tile) {
  uvec2 pixel = pixel_at(tile, in_tile);
  ivec2 at = ivec2(min(pixel, view.size - 1u));
  float depth = texelFetch(depth_image, at, 0).r;
  vec3 normal = unpack_normal(texelFetch(normal_image, at, 0).x);
  float cosine = light_cosine(light, relative_position(view, vec2(at), max(depth, 1e-30)), normal);
  return depth > 0.0 && all(lessThan(pixel, view.size)) && (cosine > 0.0 || (kTransmission != 0u && cosine < 0.0));
}

// Lists the tile's pixels that are asked, those of thin surfaces apart if these have a filter of their own. Each thread
// lists its own.
void list_pixels(LightOfPair light, uvec2 tile, uint lane, bool apart, bool few_only, uint turns) {
  uint thin = 0u, others = 0u, i = 0u;
  do {
    uint pixel = lane * kPixels + i;
    bool wanted = !few_only || pixel == few_pixel(pixel >> 3), is_one = false;
    if (kListsPixels && leaves_out_pixels) wanted = wanted && may_matter(light, tile, pixel);
    if (apart) {
      ivec2 at = ivec2(min(pixel_at(tile, pixel), view.size - 1u));
      is_one = is_thin(texelFetch(base_color_image, at, 0).a);
    }
    thin |= wanted && is_one ? 1u << i : 0u;
    others |= wanted && !is_one ? 1u << i : 0u;
  } while (++i < turns);
  uint thin_at = apart ? atomicAdd(thin_count, uint(bitCount(thin))) : 0u;
  uint other_at = atomicAdd(other_count, uint(bitCount(others)));
  i = 0u;
  do {
    bool is_one = (thin >> i & 1u) != 0u, is_other = (others >> i & 1u) != 0u;
    if (is_one || is_other) listed[is_one ? uint(GLOAM_SLOT_PIXELS) - 1u - thin_at : other_at] = lane * kPixels + i;
    thin_at += is_one ? 1u : 0u;
    other_at += is_other ? 1u : 0u;
  } while (++i < turns);
  barrier();
}

// Evaluates the pixels of thin surfaces.
void ask_thin_pixels(LightOfPair light, uvec2 tile, uint lane) {
  uint count = thin_count, i = lane, steps;
  if (i < count) do {
      uint pixel = listed[uint(GLOAM_SLOT_PIXELS) - 1u - i];
      PixelOfPair p = pixel_of_pair(light, tile, pixel);
      float visibility = 1.0;
      if (p.point.live) do {
          visibility = thin_visibility(p.point);
        } while (never(p.point));
      uint says = keep_visibility(pixel, p, visibility, steps);
      atomicOr(found, says);  // in the loop, not once after it: see never()
      pack_steps(pixel, steps);
      i += kThreads;
    } while (i < count);
}

// Evaluates the tile's pixels. First each thread evaluates its own pixels as far as possible without the filter; then
// the pixels that need the filter are distributed over all threads, then those with near blockers, and then those that
// take light from behind. A loop each: within the first, the rare pixels of the others would cost all pixels time.
// Pixels of thin surfaces with a filter of their own are evaluated apart; the others are then distributed over all
// threads in the first loop.
void ask_pixels(LightOfPair light, uvec2 tile, uint lane) {
  const bool apart = kThinFilter != 0u && kFilter == 3u;
  bool few_only = kDimLights != 0u && asks_few;
  bool by_list = apart || few_only || (kListsPixels && leaves_out_pixels);
  // Devices that run both sides of a condition need a loop to save the time of the list.
  if (apart || kDimLights != 0u || kListsPixels)
    list_pixels(light, tile, lane, apart, few_only, by_list ? kPixels : 1u);
  uint others = by_list ? other_count : uint(GLOAM_SLOT_PIXELS);
  // Where the list saves no turn, threads evaluate their own pixels, and build whole words of the slot.
  by_list = apart || few_only || others + kThreads <= uint(GLOAM_SLOT_PIXELS);
  uint turns = by_list ? max((others + kThreads - 1u) / kThreads, 1u) : kPixels;
  uint some = 0u, i = 0u, steps;
  do {
    uint place = i * kThreads + lane;
    uint pixel = by_list ? listed[min(place, max(others, 1u) - 1u)] : lane * kPixels + i;
    bool known = true, asked = !by_list || place < others;
    PixelOfPair p = pixel_of_pair(light, tile, asked ? pixel : 0u);
    p.matters = p.matters && asked;
    p.point.live = p.point.live && asked;
    float visibility, width = 0.0;
    uint sectors = 0u;
    bool live = p.point.live, behind = kTransmission != 0u && p.matters && p.extinction_m > 0.0;
    p.point.live = live && !behind;
    if (kFilter == 3u)
      known = known_before_filter(p.point, visibility, width, sectors) || !p.matters;
    else
      visibility = unquantised_visibility(p.point);
    p.point.live = live;
    if (asked) widths[pixel] = width;
    uint says = keep_visibility(pixel, p, visibility, steps);
    if (asked && behind) {
      filtered[uint(GLOAM_SLOT_PIXELS) - 1u - atomicAdd(behind_count, 1u)] = pixel;
    } else if (asked && !known && width < 0.0) {
      near_pixels[atomicAdd(near_count, 1u)] = pixel | sectors << 8;
    } else if (asked && !known) {
      filtered[atomicAdd(filtered_count, 1u)] = pixel;
    } else if (asked) {
      some |= says;
      if (by_list)
        pack_steps(pixel, steps);
      else
        pack_own_steps(pixel, steps);
    }
  } while (++i < turns);
  if (!by_list) keep_own_words(lane);
  if (some != 0u) atomicOr(found, some);
  if (apart) ask_thin_pixels(light, tile, lane);
  barrier();
  uint count = kFilter == 3u ? filtered_count : 0u;
  i = lane;
  if (i < count) do {
      uint pixel = filtered[i];
      PixelOfPair p = pixel_of_pair(light, tile, pixel);
      uint says = keep_visibility(pixel, p, kernel_visibility(p.point, widths[pixel]), steps);
      atomicOr(found, says);  // in the loop, not once after it: see never()
      pack_steps(pixel, steps);
      i += kThreads;
    } while (i < count);
  count = kFilter == 3u && kNear != 0u ? near_count : 0u;
  i = lane;
  if (i < count) do {
      uint pixel = near_pixels[i] & 255u, sectors = near_pixels[i] >> 8;
      PixelOfPair p = pixel_of_pair(light, tile, pixel);
      uint says = keep_visibility(pixel, p, near_visibility(p.point, -widths[pixel], sectors), steps);
      atomicOr(found, says);
      pack_steps(pixel, steps);
      i += kThreads;
    } while (i < count);
  count = kTransmission != 0u ? behind_count : 0u;
  i = lane;
  if (i < count) do {
      uint pixel = filtered[uint(GLOAM_SLOT_PIXELS) - 1u - i];
      PixelOfPair p = pixel_of_pair(light, tile, pixel);
      uint says = keep_visibility(pixel, p, transmittance(p.point, p.extinction_m), steps);
      atomicOr(found, says);
      pack_steps(pixel, steps);
      i += kThreads;
    } while (i < count);
}

#endif

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_LINE_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_LINE_GLSL

#include "shaders/depth_of_field/depth_of_field_shared.h"

// Thief, section 1.5.2: a workgroup of n threads filters n texels of a line with radius k. It fetches the 2k + n texels
// that they need once, k being the greatest of the workgroup's tiles. A slanted line needs the texels above and below
// its own, too. Include this after keep() and kept(), which store 3 · kRoom texels in workgroup memory.

layout(local_size_x = GLOAM_DOF_LINE) in;
layout(constant_id = 2) const uint kDirection = 0u;  // kernel.glsl
layout(constant_id = 3) const uint kList = 0u;       // runs in the tiles of this list
// Share of other_image, which is added: 0 nothing, 1 kUpShare, 2 kRightShare.
layout(constant_id = 4) const uint kOther = 0u;

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D reach_image;
layout(set = 0, binding = 2) uniform sampler2D layer_image;
layout(set = 0, binding = 3) uniform sampler2D other_image;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D blurred_image;
layout(set = 0, binding = 5, scalar) readonly buffer Flags { uint tile_flags[]; };

#include "shaders/depth_of_field/blur/radius.glsl"

shared uint most;  // farthest texel that a kernel of the workgroup reads, and 1; 0: the list holds none of its tiles

// The texel at this place of the workgroup's line. Lines are numbered so that each texel lies on one.
ivec2 on_line(int along) {
  int line = int(gl_WorkGroupID.y);
  if (kDirection == kRow) return ivec2(along, line);
  if (kDirection == kColumn || kDirection == kUpward) return ivec2(line, along);
  int slanted = line - int((dof.layer_size.x + 1u) >> 1);
  if (kDirection == kRightward) return ivec2(along, slanted + (along >> 1));
  return ivec2(along, line - ((along + 1) >> 1));
}

// add_row_trio() from workgroup memory.
void add_kept_trio(inout LineSum sum, int at, float weight) {
  add(sum, kept(at), 0.5 * weight);
  add(sum, kept(at + 2 * kRoom), 0.25 * weight);
  add(sum, kept(at + kRoom), 0.25 * weight);
}

bool is_round() { return kDirection == kRow || kDirection == kColumn; }

void main() {
  int lane = int(gl_LocalInvocationIndex);
  int first = int(gl_WorkGroupID.x) * GLOAM_DOF_LINE;
  ivec2 texel = on_line(first + lane);
  bool is_inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(dof.layer_size)));
  ivec2 tile = inside(texel) * int(kScale) / GLOAM_DOF_TILE;
  uint flags = tile_flags[uint(tile.y) * dof.tiles.x + uint(tile.x)];
  bool is_listed = is_inside && (flags >> kList & 1u) != 0u;
  if (lane == 0) most = 0u;
  barrier();
  if (is_listed) atomicMax(most, (flags >> (8u + 8u * kNear) & 0xFFu) + 1u);
  barrier();
  int taps = int(most) - 1;
  if (taps < 0) return;
  if (kDirection >= kRightward) taps = (taps + 1) & ~1;  // steps are added in pairs
  // Texels before the first thread's and behind the last thread's that are read.
  int before = kDirection == kRightward ? 0 : taps;
  int behind = kDirection == kUpward || kDirection == kLeftward ? 0 : taps;
  for (int at = lane; at < GLOAM_DOF_LINE + before + behind; at += GLOAM_DOF_LINE) {
    ivec2 place = on_line(first + at - before);
    keep(at, texelFetch(layer_image, inside(place), 0));
    if (kDirection < kRightward) continue;
    keep(at + kRoom, texelFetch(layer_image, inside(place + ivec2(0, 1)), 0));
    keep(at + 2 * kRoom, texelFetch(layer_image, inside(place - ivec2(0, 1)), 0));
  }
  barrier();
  if (!is_listed) return;
  // Texels beyond the tile's own reach may not have been written.
  taps = int(flags >> (8u + 8u * kNear) & 0xFFu);
  int own_place = lane + before;
  vec4 own = kept(own_place);
  float radius = kernel_radius(texel, own.a);
  LineSum sum = no_sum();
  if (is_round()) {
    add(sum, own, 1.0);
    for (int n = 1; n <= taps; ++n) {
      float weight = round_weight(n, radius);
      add(sum, kept(own_place - n), weight);
      add(sum, kept(own_place + n), weight);
    }
  } else if (kDirection == kUpward) {
    add(sum, own, line_weight(0, radius));
    for (int n = 1; n <= taps; ++n) add(sum, kept(own_place - n), line_weight(n, radius));
  } else {
    float length = kSlanted * radius;
    int turn = kDirection == kRightward ? 1 : -1;
    // The line's texels are those of whole steps from even columns. An odd step from an even column lies between such a
    // texel and the one below it, and one from an odd column between it and the one above.
    int low = (texel.x & 1) == 0 ? 0 : 2 * kRoom, high = (texel.x & 1) == 0 ? kRoom : 0;
    add_kept_trio(sum, own_place, line_weight(0, length));
    for (int n = 1; n <= taps; n += 2) {
      int between = own_place + turn * n;
      float weight = 0.5 * line_weight(n, length);
      add(sum, kept(between + low), weight);
      add(sum, kept(between + high), weight);
      add_kept_trio(sum, between + turn, line_weight(n + 1, length));
    }
  }
  vec4 light = mean(sum, own.a);
  if (kOther != 0u) light = mix(light, texelFetch(other_image, texel, 0), kOther == 1u ? kUpShare : kRightShare);
  imageStore(blurred_image, texel, light);
}

#endif

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_TRANSFER_GLSL
#define GLOAM_SHADERS_CLOSEUPS_TRANSFER_GLSL

#include "shaders/closeups/closeups_shared.h"
#include "shaders/shadows/shadow_maps_api.glsl"

// Transfer (FF XVI paper, §3.5): adds the depths of a pair's face to a standard face. Unlike the paper it gathers: each
// texel of the standard face reads the area of the pair's face that it covers, so no texel is missed and each is
// written once. It reads the whole area, in the finest mip that has at most two texels across the smaller side, and
// keeps the nearest depth. Each mip texel is assigned to the standard texel that contains its centre, so no mip texel
// is lost and outlines do not grow. Before including this, define GLOAM_SHADOW_ATLAS_FORMAT, and
// GLOAM_SHADOW_ATLAS_STEPS if the atlas stores depths with less precision than floats.

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform Transfer { CloseupTransfer transfer; };
layout(set = 0, binding = 1) uniform sampler2D closeup_map;
layout(set = 0, binding = 2) uniform sampler2D closeup_pyramid;
layout(set = 0, binding = 3, GLOAM_SHADOW_ATLAS_FORMAT) uniform image2D atlas;

// An area of the pair's face, texels.
struct Area {
  vec2 low;
  vec2 high;
  bool ahead;  // the whole area is in front of the pair's face
};

void add_corner(inout Area area, vec2 corner) {
  vec3 p = vec3(corner, 1.0);
  float w = dot(transfer.row_w, p);
  vec2 at = vec2(dot(transfer.row_u, p), dot(transfer.row_v, p)) / (w > 0.0 ? w : 1.0);
  area.low = min(area.low, at);
  area.high = max(area.high, at);
  area.ahead = area.ahead && w > 0.0;
}

Area covered_area(uvec2 texel) {
  Area area = Area(vec2(1e30), vec2(-1e30), true);
  for (uint i = 0u; i < 4u; ++i) add_corner(area, vec2(texel + uvec2(i & 1u, i >> 1)));
  return area;
}

// The finest mip that has at most two texels across the smaller side.
uint level_of(Area area) {
  vec2 sides = area.high - area.low;
  uint texels = uint(clamp(ceil(min(sides.x, sides.y) - 1.0 / 64.0), 1.0, float(transfer.size)));
  return texels <= 2u ? 0u : uint(findMSB(texels - 1u));
}

// Nearest depth of the mip-0 texels below a texel of the mip.
float nearest_depth(uvec2 at, uint mip) {
  if (mip < uint(GLOAM_SHADOW_PYRAMID_MIP)) return texelFetch(closeup_map, ivec2(transfer.origin + at), 0).x;
  uint level = mip - uint(GLOAM_SHADOW_PYRAMID_MIP), size = transfer.map_size / 4u;
  ivec2 corner = level == 0u ? ivec2(0) : ivec2(size, size - (2u * size >> level));
  return texelFetch(closeup_pyramid, corner + ivec2((transfer.origin >> mip) + at), 0).x;
}

// Depth in the standard face; 0 where a standard face would be empty.
float standard_depth(float depth, vec2 at) {
  vec3 q = vec3(at, 1.0);
  float w = dot(transfer.depth_w, q);
  if (!(depth > 0.0 && w > 0.0)) return 0.0;
  float d = (transfer.depth_scale * depth + dot(transfer.depth_row, q)) / w;
  return d <= 1.0 ? max(d, 0.0) : transfer.orthographic != 0u ? 1.0 : 0.0;
}

bool lies_in(uvec2 texel, vec2 at) {
  vec3 q = vec3(at, 1.0);
  float w = dot(transfer.depth_w, q);
  vec2 place = vec2(dot(transfer.back_u, q), dot(transfer.back_v, q)) / (w > 0.0 ? w : 1.0);
  vec2 off = abs(place - (vec2(texel) + 0.5));
  return w > 0.0 && max(off.x, off.y) <= 0.5 + 1.0 / 64.0;
}

// The depth as mip 0 of the atlas stores it.
float held_depth(float depth) {
#ifdef GLOAM_SHADOW_ATLAS_STEPS
  depth = floor(clamp(depth, 0.0, 1.0) * GLOAM_SHADOW_ATLAS_STEPS + 0.5) / GLOAM_SHADOW_ATLAS_STEPS;
#endif
  return uintBitsToFloat(floatBitsToUint(depth) & transfer.depth_bits);
}

void main() {
  uvec2 texel = transfer.begin + gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(texel, transfer.end))) return;
  Area area = covered_area(texel);
  float size = float(transfer.size);
  if (!area.ahead || any(lessThanEqual(area.high, vec2(0.0))) || any(greaterThanEqual(area.low, vec2(size)))) return;

  uint level = level_of(area);
  uint mip = level < uint(GLOAM_SHADOW_PYRAMID_MIP) ? 0u : level;
  float texels = float(1u << mip);
  ivec2 most = ivec2((transfer.size >> mip) - 1u);
  ivec2 first = clamp(ivec2(floor(area.low / texels)), ivec2(0), most);
  ivec2 last = clamp(ivec2(floor(area.high / texels)), ivec2(0), most);
  float nearest = 0.0;
  bool any_inside = false;
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) {
      vec2 middle = (vec2(x, y) + 0.5) * texels;
      if (!lies_in(texel, middle)) continue;
      any_inside = true;
      nearest = max(nearest, standard_depth(nearest_depth(uvec2(x, y), mip), middle));
    }
  if (!any_inside) {
    vec2 middle = 0.5 * (area.low + area.high);
    if (any(lessThan(middle, vec2(0.0))) || any(greaterThanEqual(middle, vec2(size)))) return;
    nearest = standard_depth(nearest_depth(uvec2(middle / texels), mip), middle);
  }
  if (nearest == 0.0) return;
  // One thread per texel, so read and write cannot race.
  ivec2 at = ivec2(transfer.target + texel);
  imageStore(atlas, at, vec4(max(held_depth(nearest), imageLoad(atlas, at).x)));
}

#endif

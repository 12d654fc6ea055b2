// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_EARLY_LISTS_BINDING 7
#include "shaders/common/workgroup.glsl"
#include "shaders/lights/light_lists_api.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"

// Counts culling errors: pairs of a pixel and a light that lights it but is missing from the list of the pixel's tile.
// Tests every local light of the view with the illuminance function of shading. One workgroup per shadow tile.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = 3) uniform sampler2D depth_image;
layout(set = 0, binding = 4) uniform sampler2D light_texels;
layout(set = 0, binding = 5, scalar) readonly buffer GroupMasks { uint group_masks[]; };
layout(set = 0, binding = 6) uniform usampler2D tile_lists;
layout(set = 0, binding = 8, scalar) buffer Counters { LightCounters counters; };

shared uint listed[GLOAM_LIGHT_GROUPS];  // the lights that shading uses in this tile

void read_lights(uint lane) {
  uvec2 tile_list = texelFetch(tile_lists, ivec2(gl_WorkGroupID.xy), 0).xy;
  uint mask = group_mask_of(grid, gl_WorkGroupID.xy * uint(GLOAM_SHADOW_TILE));
  bool full = !has_list(tile_list);
  if (lane < GLOAM_LIGHT_GROUPS)
    listed[lane] = full && (group_masks[mask] >> lane & 1u) != 0u ? group_masks[mask + 1u + lane] : 0u;
  barrier();
  for (uint i = lane; !full && i < list_count(tile_list); i += GLOAM_WORKGROUP) {
    uint light = list_light(tile_list.x, i);
    atomicOr(listed[light >> 5], 1u << (light & 31u));
  }
  barrier();
}

void main() {
  uint lane = gl_LocalInvocationIndex;
  uvec2 pixel = gl_GlobalInvocationID.xy;
  read_lights(lane);
  float depth = texelFetch(depth_image, ivec2(min(pixel, view.size - 1u)), 0).r;
  uint missing = 0u;
  if (depth > 0.0 && all(lessThan(pixel, view.size))) {
    vec3 point = relative_position(view, vec2(pixel), depth);
    for (uint i = 0u; i < grid.local_count; ++i) {
      vec3 to_light;
      vec3 light = local_illuminance(fetch_light(light_texels, i), point, to_light);
      bool absent = (listed[i >> 5] >> (i & 31u) & 1u) == 0u;
      if (absent && any(greaterThan(light, vec3(0.0)))) ++missing;
    }
  }
  uint sum = workgroup_sum(missing);
  if (lane == 0u && sum != 0u) atomicAdd(counters.culling_errors, sum);
}

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_SIMULATION_MASTERS_GLSL
#define GLOAM_SHADERS_GRASS_SIMULATION_MASTERS_GLSL

// Bindings of the shaders that simulate the listed masters.

#include "shaders/grass/simulation/solver.glsl"
#include "shaders/grass/way_api.glsl"

layout(set = 0, binding = 0, scalar) uniform StepsBlock { GrassSteps steps; };
layout(set = 0, binding = 1, scalar) readonly buffer Patches { GrassPatchRow patches[]; };
layout(set = 0, binding = 2, scalar) readonly buffer BladeRows { GrassBladeRow blade_rows[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Types { GrassTypeRow types[]; };
layout(set = 0, binding = 4, scalar) readonly buffer MasterList { GrassMaster master_list[]; };
layout(set = 0, binding = 5, scalar) readonly buffer MasterCount { uint master_count; };
layout(set = 0, binding = 6, scalar) readonly buffer Colliders { GrassCollider colliders[]; };
// 16 for each place, relative to the patch's origin; w holds the way of the last frame (pack_way).
layout(set = 0, binding = 7, scalar) buffer Knots { vec4 knots[]; };
layout(set = 0, binding = 8, scalar) buffer PreviousKnots { vec4 previous_knots[]; };  // a step earlier

uint stride_of(GrassMaster master) { return clamp(master.stride, 1u, uint(GLOAM_GRASS_MOST_STRIDE)); }

// Steps of the master's stride that it runs, at least one if it runs any.
uint turns_of(GrassMaster master) {
  uint single = min(master.steps, steps.frame_steps + stride_of(master) - 1u);
  return single == 0u ? 0u : max(single / stride_of(master), 1u);
}

// The frame's part, in its steps, that has passed when `turns` of the master's own steps are left; below 0 if they
// begin before the frame.
float passed_steps(uint turns, uint stride) { return float(steps.frame_steps) - float(turns * stride); }

// A knot a step earlier is stored as if its last way had lasted one step, so a blade may change its stride.
vec3 scaled_before(vec3 at, vec3 before, float scale) {
  precise vec3 scaled = at - (at - before) * scale;
  return scale == 1.0 ? before : scaled;
}

// In still air, a knot that would move by less than this in a frame stays where it is, so that blades come to rest.
const float kStill = 4e-7;  // metres; a few steps of floats in a patch

// Writes a knot. at, before: relative to the root, at the last step and a step earlier. fresh: the frame has put the
// knot at rest, so it has no way.
void store_knot(uint place, vec3 root, vec3 at, vec3 before, bool fresh) {
  precise vec3 at_in_patch = root + at;
  precise vec3 before_in_patch = root + before;
  precise vec3 way = at_in_patch - knots[place].xyz;
  bool still = !fresh && steps.frame_steps != 0u && steps.wind.velocity == vec3(0.0) && dot(way, way) < kStill * kStill;
  vec4 here = knots[place], earlier = previous_knots[place];
  at_in_patch = still ? here.xyz : at_in_patch;
  before_in_patch = still ? earlier.xyz : before_in_patch;
  way = still ? vec3(0.0) : way;
  vec2 stored = !fresh && dot(way, way) < 1e8 ? pack_way(way) : pack_way(vec3(0.0));  // false for NaN
  knots[place] = vec4(at_in_patch, stored.x);
  previous_knots[place] = vec4(before_in_patch, stored.y);
}

#endif

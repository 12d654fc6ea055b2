// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_TESTS_SHADOW_PROBE_GLSL
#define GLOAM_TESTS_SHADOW_PROBE_GLSL

#include "tests/shaders/shadows_test/probe_shared.h"

// Evaluates the functions of shadows_api.glsl at a list of points, for tests.

#define GLOAM_SHADOWS_BINDING 2
#define GLOAM_SHADOWS_PIXEL ivec2(gl_GlobalInvocationID.x, 0)
#include "shaders/shadows/shadows_api.glsl"

layout(local_size_x = GLOAM_SHADOW_PROBE_GROUP) in;
layout(set = 0, binding = 0, scalar) readonly buffer Probes { ShadowProbe probes[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Results { ShadowProbeResult results[]; };
layout(push_constant, scalar) uniform Constants { uint probe_count; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= probe_count) return;
  ShadowProbe probe = probes[i];
  bool directional = (probe.flags & uint(GLOAM_SHADOW_PROBE_DIRECTIONAL)) != 0u;
  ShadowReceiver r =
      drawn_receiver(probe.position, probe.face_normal, (probe.flags & uint(GLOAM_SHADOW_PROBE_SUBSURFACE)) != 0u);
  ShadowProbeResult result;
  result.visibility = 1.0;
  for (bool go = directional; go; go = false)
    result.visibility = directional_visibility(probe.light, probe.light_vector, r, 0.0);
  for (bool go = !directional; go; go = false)
    result.visibility = local_visibility(probe.light, probe.light_vector, r, 0.0);

  ShadowPoint p = directional ? directional_shadow_point(probe.light, probe.light_vector, r)
                              : local_shadow_point(probe.light, probe.light_vector, r);
  SearchRegion region = SearchRegion(0.0, 0.0, 0.0);
  Blockers blockers = Blockers(0.0, 0.0);
  for (bool go = p.live; go; go = false) {
    region = find_region(p);
    blockers = region_blockers(p, region);
  }
  result.region_width = region.width;
  result.nearest = region.nearest;
  result.blocker_count = blockers.count;
  result.blocker_depth = blockers.depth;
  result.penumbra = p.live ? penumbra_width(p, blockers.depth) : 0.0;
  result.cookie = directional ? vec2(1.0) : cookie_color(probe.light, probe.light_vector, r.position).xy;
  results[i] = result;
}

#endif

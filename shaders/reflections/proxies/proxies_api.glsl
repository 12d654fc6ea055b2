// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_PROXIES_API_GLSL
#define GLOAM_SHADERS_REFLECTIONS_PROXIES_API_GLSL

#include "shaders/reflections/reflections_shared.h"

// A ray against image-based proxies.

struct ProxyHit {
  bool met;
  float distance_m;
  vec2 uv;  // of the captured image
};

// Whether a ray from `origin` in unit direction `direction` may meet the proxy's bounding sphere. Far away, a
// difference of squared lengths would lose a small sphere; the distance beside the ray is as exact as the hit.
bool meets_sphere(ProxyRow proxy, vec3 origin, vec3 direction) {
  vec3 to_center = proxy.center - origin;
  float along = dot(to_center, direction), radius_m = proxy.radius_m + 1e-6 * abs(along);
  vec3 beside = to_center - along * direction;
  return along > -radius_m && dot(beside, beside) <= radius_m * radius_m;
}

// Whether a receiver at this height shows the proxy.
bool serves_height(ProxyRow proxy, float y) {
  return any(lessThanEqual(proxy.lowest_y, vec4(y))) &&
         any(bvec4(proxy.lowest_y.x <= y && y <= proxy.highest_y.x, proxy.lowest_y.y <= y && y <= proxy.highest_y.y,
                   proxy.lowest_y.z <= y && y <= proxy.highest_y.z, proxy.lowest_y.w <= y && y <= proxy.highest_y.w));
}

// Only rays against the normal meet the proxy.
ProxyHit meet_proxy(ProxyRow proxy, vec3 origin, vec3 direction) {
  ProxyHit hit;
  float facing = dot(proxy.normal, direction);
  vec3 to_center = proxy.center - origin;
  hit.distance_m = dot(proxy.normal, to_center) / min(facing, -1e-6);
  vec3 offset = direction * hit.distance_m - to_center;
  vec2 at = vec2(dot(proxy.to_u, offset), dot(proxy.to_v, offset));
  hit.met =
      facing < -1e-6 && hit.distance_m > 0.0 && max(abs(at.x), abs(at.y)) <= 1.0 && serves_height(proxy, origin.y);
  hit.uv = vec2(0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y);
  return hit;
}

#endif

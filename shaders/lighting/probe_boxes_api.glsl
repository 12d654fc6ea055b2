// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_PROBE_BOXES_API_GLSL
#define GLOAM_SHADERS_LIGHTING_PROBE_BOXES_API_GLSL

#include "shaders/lighting/probes_shared.h"

// Shares of cube probes at a point, by their boxes.

// Share of the probe at a point: 1 inside, falling to 0 toward the faces of its box.
float probe_share(ProbeRow probe, vec3 at) {
  vec3 inside = (1.0 - abs(at)) / probe.fade;
  return max(clamp(min(inside.x, min(inside.y, inside.z)), 0.0, 1.0), probe.global);
}

// A vector in the axes of the probe's box; half the box has length 1.
vec3 in_probe_axes(ProbeRow probe, vec3 v) { return vec3(dot(probe.to_x, v), dot(probe.to_y, v), dot(probe.to_z, v)); }

// Where a point lies in the probe's box, −1…1 inside.
vec3 place_in_probe(ProbeRow probe, vec3 position) { return in_probe_axes(probe, position - probe.center); }

// Share of the probe at a point of a surface. A box that ends a little before the surface is that of the room behind
// it: its share is what it is further out, along the normal. at: place_in_probe(). normal: unit length; zero: a point
// without a surface.
float facing_share(ProbeRow probe, vec3 at, vec3 normal) {
  vec3 out_of_surface = in_probe_axes(probe, normal);
  vec3 size = abs(out_of_surface);
  float longest = max(max(size.x, size.y), max(size.z, 1e-30));
  return min(probe_share(probe, at), probe_share(probe, at + out_of_surface * (probe.fade / longest)));
}

#endif

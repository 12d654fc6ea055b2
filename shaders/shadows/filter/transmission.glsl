// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_TRANSMISSION_GLSL
#define GLOAM_SHADERS_SHADOWS_TRANSMISSION_GLSL

// Transmittance of the body between a receiver and the side of the body that the light falls on (Green, GPU Gems, 2004,
// chapter 16; Dachsbacher and Stamminger, Translucent Shadow Maps, 2003). The map holds the depth of that side, so the
// thickness is the receiver's depth minus the map's. We change two things. Each tap of the kernel has its own thickness
// and the transmittances are averaged, not the depths: half a blocker then lets half of the light through. And a tap's
// thickness is measured from the receiver plane, so a sheet has thickness 0 at any slope. Anything else between
// light and body counts as thickness as well: a metre of it leaves nothing.

// Metres along the light's ray between two depths of a face; negative if `from` is nearer to the light than `to`.
float metres_between(ShadowPoint p, float from, float to) {
  return p.metres * (p.orthographic ? to - from : 1.0 / from - 1.0 / to);
}

// Width of the kernel in texels of mip 0: that of the penumbra, as for visibility. The body's own lit side is among the
// blockers. At least a texel, so that the map's texels do not show.
float transmission_width(ShadowPoint p) {
  if (kFilter == 0u) return 0.0;
  if (kFilter == 1u) return float(kKernel - 1);
  SearchRegion region = find_region(p);
  float blocker = p.depth;
  if (region.nearest > p.threshold) do {
#ifndef GLOAM_SHADOWS_STANDARD
      if (kFilter == 2u) blocker = spread(p, max(region.width, float(kKernel)), true).y;
#endif
      if (kFilter == 3u) blocker = region_blockers(p, region).depth;
    } while (never(p));
  return max(penumbra_width(p, blocker), 1.0);
}

// Depths in the map are behind their surfaces by the slope bias: the greater slope per texel along an axis. Returns it
// for the surface around the receiver's texel. At an edge the neighbour on the same surface counts.
float slope_bias(ShadowPoint p) {
  bool across = leaves_cube_face(p, 1.5);
  float middle = 0.0;
  vec4 beside = vec4(0.0);  // left, right, upper, lower
  for (int i = 0; i < 5; ++i) {
    vec2 at = p.at + vec2(float(i == 1) - float(i == 0), float(i == 3) - float(i == 2));
    float depth = tap_depth(p, at, across);
    if (i == 4) middle = depth;
    beside = mix(beside, vec4(depth), equal(ivec4(i), ivec4(0, 1, 2, 3)));
  }
  vec4 steps = abs(beside - middle);
  return max(min(steps.x, steps.y), min(steps.z, steps.w));
}

// extinction_m: > 0.
float kernel_transmittance(ShadowPoint p, float extinction_m) {
  const int taps = 8;
  // Without the bias: an error of depth changes the transmittance little, it does not flip a comparison.
  float quantum = max(shadow_block.depth_quantum, abs(p.depth) * shadow_block.relative_quantum);
  p.threshold = max(p.depth + quantum + slope_per_texel(p) * kTexelRounding, p.least);
  float width = transmission_width(p), spacing = width / float(taps);
  bool across = leaves_cube_face(p, 0.5 * width);
  float behind = slope_bias(p);
  float all = 0.0, sum = 0.0;
  int i = 0;
  while (i < taps * taps) {  // not do … while: a repeated body would change the sums, see never()
    vec2 off = vec2(i % taps, i / taps) - 0.5 * float(taps - 1);
    vec2 at = p.at + off * spacing;
    float depth = tap_depth(p, at, across);
    depth = depth > 0.0 ? depth + behind : 0.0;
    // Not limited in steepness, as thresholds are: of a slab, each tap then has the same thickness.
    precise float plane = p.threshold + dot(p.slope, at - p.at);
    plane = max(plane, p.least);
    float weight = covered(0.5 * float(taps), vec4(off.x), vec4(off.y)).x;
    all += weight;
    sum += weight * transmittance_of(depth > plane ? metres_between(p, plane, depth) : 0.0, extinction_m);
    ++i;
  }
  return sum / all;
}

// The mean transmittance over the emitter. 1 for lights without maps, and outside of maps: nothing is known to be
// between light and receiver.
float transmittance(ShadowPoint p, float extinction_m) {
  float share = 1.0;
  if (p.live && extinction_m > 0.0) do {
      share = kernel_transmittance(p, extinction_m);
    } while (never(p));
  return share;
}

#endif

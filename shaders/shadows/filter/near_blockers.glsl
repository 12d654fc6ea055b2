// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_NEAR_BLOCKERS_GLSL
#define GLOAM_SHADERS_SHADOWS_NEAR_BLOCKERS_GLSL

#include "shaders/shadows/filter/blocker_search.glsl"

// Visibility of an emitter whose blockers are about as near to it as it is wide. There a mean distance of blockers and
// one kernel do not describe the shadow. Instead, each surface in the map is projected from the receiver onto the
// emitter, direction by direction, and the covered part of the emitter is collected in bits.
//
// Seen from the light, let w be the direction of the receiver, r its depth and ρ the tangent between w and another
// direction. A ray from the receiver to the point e of the emitter's disc (in radii of the disc) passes through the
// directions ρ = e · k · (d − r), where d is its depth there (inverse distance along w) and k the radius in these
// units. So a surface of depth d > r in direction ρ covers the point e = ρ / (k · (d − r)).

const int kNearDirections = 16;
const int kNearSteps = 16;
const float kNearJoin = 0.4;  // least ratio of depths, beyond the receiver's, of neighbouring samples of one surface
// Place of an edge between two samples, as a share: with it the mean area is right, wherever the edge lies on the
// logarithmic scale.
const float kNearEdge = 0.43;
const float kNearFirst = 0.05;  // tangent of the first ring of near_bounds()
// Tangent at the receiver's direction from which a blocker in the cone is near.
const float kNearTangent = kNear == 2u ? 0.3 : 0.55;

// The frame in which directions are taken: w, a, b. A direction is w + ρ (cos a + sin b).
struct NearFrame {
  mat3 axes;       // a, b, w: in the axes of the cube, or of the spot's map
  float depth;     // of the receiver, along w
  float bias;      // threshold − depth, along w
  float k;         // see above
  vec3 plane;      // depth of the receiver plane in direction v is dot(plane, v)
  float to_texel;  // texels of mip 0 per tangent in a face
};

NearFrame near_frame(ShadowPoint p) {
  NearFrame f;
  f.to_texel = 0.5 * p.size / p.tan_half;
  vec2 tangent = (p.at - 0.5 * p.size) / f.to_texel;
  vec3 local = vec3(tangent.x, -tangent.y, 1.0);
  vec2 gradient = vec2(p.slope.x, -p.slope.y) * f.to_texel;
  vec3 plane = vec3(gradient, p.depth - dot(gradient, local.xy));
  mat3 own = p.face >= 0 ? cube_face_axes(p.face) : mat3(1.0);
  float far = length(local);
  vec3 w = p.face >= 0 ? own * local / far : local;
  vec3 side = abs(w.y) < 0.8 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
  vec3 a = normalize(cross(side, w));
  f.axes = p.face >= 0 ? mat3(a, cross(w, a), w) : mat3(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), local);
  float along = p.face >= 0 ? 1.0 / far : 1.0;
  f.depth = p.depth * along;
  f.bias = (p.threshold - p.depth) * along;
  // A cube's scale has the factor √far; see local_shadow_point().
  f.k = 0.5 * p.scale / f.to_texel * (p.face >= 0 ? inversesqrt(far) : 1.0);
  f.plane = own * plane;
  return f;
}

// Where a direction falls on the light's faces.
struct NearPlace {
  mat3 axes;    // of the face
  vec2 origin;  // corner of the face in the atlas
  vec3 local;   // the direction, in the face's axes
  vec2 at;      // texels of mip 0 from the face's corner
};

NearPlace near_place(ShadowPoint p, NearFrame f, vec3 v) {
  int face = cube_face_of(v);
  bool cube = p.face >= 0;
  NearPlace place;
  place.axes = cube ? cube_face_axes(face) : mat3(1.0);
  place.origin = cube ? origin_of_face(face) : p.origin;
  place.local = v * place.axes;
  place.at = vec2(place.local.x, -place.local.y) / place.local.z * f.to_texel + 0.5 * p.size;
  return place;
}

// Depth along w of the map's texel in direction v; v becomes the direction of the texel's centre. 0 outside a spot's
// map.
float near_depth(ShadowPoint p, NearFrame f, inout vec3 v) {
  NearPlace place = near_place(p, f, v);
  vec2 cell = clamp(floor(place.at), vec2(0.0), vec2(p.size - 1.0));
  bool inside = p.face >= 0 || all(equal(cell, floor(place.at)));
  float depth = texelFetch(shadow_atlas, ivec2(place.origin + cell), 0).x;
  vec2 center = (cell + 0.5 - 0.5 * p.size) / f.to_texel;
  vec3 toward = place.axes * vec3(center.x, -center.y, 1.0);
  float along = p.face >= 0 ? dot(toward, f.axes[2]) : 1.0;
  v = toward / along;
  return inside ? depth / along : 0.0;
}

// 2×2 texels of the pyramid around direction v that reach at least `reach` from it, as a tangent. Texels beyond the
// border of the face of v are left out.
struct NearTexels {
  vec2 corner;  // between the texels, in texels of the pyramid's level 0
  float along;  // depth along w of a surface in direction v, over its depth in the face
};

NearTexels texels_around(ShadowPoint p, NearFrame f, vec3 v, float reach) {
  NearPlace place = near_place(p, f, v);
  vec3 local = place.local;
  // Off the axes, a face's tangents are wider than tangents to w.
  float texels = 2.0 * reach * f.to_texel * dot(local, local) / (local.z * local.z * dot(v, v));
  int level = pyramid_level(texels, floor_log2(p.size) - GLOAM_SHADOW_PYRAMID_MIP - 1);
  MipSquare square = mip_square(place.origin * 0.25, p.size * 0.25, level, shadow_block.atlas_size * 0.25);
  vec2 corner = clamp(floor(place.at * 0.25 / square.texel - 0.5) + 1.0, vec2(1.0), vec2(square.size - 1.0));
  return NearTexels(square.corner + corner, p.face >= 0 ? local.z : 1.0);
}

// What near_visibility() need not look at.
struct NearBounds {
  bool umbra;   // surfaces surely hide all of the emitter
  float reach;  // tangent beyond which no blocker lies in the cone to the emitter; 0: there is none at all
};

// Umbra: all depths in a disc around the receiver's direction are at least d, and the disc holds what the cone cuts out
// at depth d. That cut grows with d, so the depth in the middle gives a disc that is large enough. A square of
// directions is looked at, each with the texels half-way beyond its neighbours: next to an edge of the cube, those of
// the other face come from there.
// Reach: rings of directions at tangents that double, each with the texels half-way to its neighbours.
// needed: as in near_visibility().
NearBounds near_bounds(ShadowPoint p, NearFrame f, float widest, bool needed) {
  const int kSide = 5, kRings = 1 + kSide * kSide;  // of the square; first turn of the rings
  const float kBeyond = 1.3;                        // reach in the square, as a share of its step
  const float kWidest = 1.0;                        // tangent of the disc's radius
  const float kRounding = 1.02;
  const float kAround = 0.42;  // half of the way to a neighbour on the rings, as a share of the tangent
  NearBounds bounds = NearBounds(false, 0.0);
  float least = f.depth + f.bias, step = 0.0, rise = 0.0;
  float slope = length(f.plane - dot(f.plane, f.axes[2]) / dot(f.axes[2], f.axes[2]) * f.axes[2]);
  int n = 0, rings = clamp(ceil_log2(max(widest / kNearFirst, 1.0)) + 1, 1, 8),
      end = needed ? kRings + 1 + 8 * rings : 0;
  while (n < end) {  // see near_visibility()
    bool square = n < kRings;
    int i = square ? max(n - 1, 0) : n - kRings;
    float tangent = i == 0 ? 0.0 : kNearFirst * power_of_two((i - 1) >> 3), angle = 0.78539816 * float(i & 7);
    vec2 at = square ? (vec2(i % kSide, i / kSide) - float(kSide / 2)) * step : vec2(cos(angle), sin(angle)) * tangent;
    float reach = square ? kBeyond * step : i == 0 ? kNearFirst * (1.0 - kAround) : kAround * tangent;
    vec3 v = f.axes[2] + f.axes * vec3(at, 0.0);
    NearTexels texels = texels_around(p, f, v, reach);
    vec4 depths = textureGather(shadow_pyramid,
                                texels.corner * shadow_texel_size() * vec2(4.0, 2.0) + vec2(0.0, square ? 0.5 : 0.0));
    float farthest = farthest_of(depths) * max(texels.along - 1.5 * reach, 0.0);
    float nearest = nearest_of(depths) * texels.along;
    float radius = kRounding * f.k * max(farthest - f.depth, 0.0) + 2.0 / f.to_texel;
    bool hidden = farthest > max(dot(f.plane, v) + rise + f.bias, f.depth) && (n > 0 || radius < kWidest);
    step = n == 0 ? radius / float(kSide / 2) : step;
    rise = 1.5 * kBeyond * step * slope;
    bool blocks = !square && nearest > max(least, f.depth + max(tangent - 1.5 * reach, 0.0) / f.k);
    bounds.reach = blocks ? max(bounds.reach, tangent + reach) : bounds.reach;
    bounds.umbra = bounds.umbra || (hidden && n == kRings - 1);
    n = !square || hidden ? n + 1 : kRings;
    n = bounds.umbra ? end : n;
  }
  return bounds;
}

// Bits of the emitter's rings between the radii a and b, in any order. The 32 rings have equal areas.
uint ring_bits(float a, float b) {
  float low = min(a, b), high = max(a, b);
  uint first = uint(32.0 * min(low * low, 1.0) + 0.5), last = uint(32.0 * min(high * high, 1.0) + 0.5);
  uint below = first >= 32u ? ~0u : (1u << first) - 1u;
  uint to = last >= 32u ? ~0u : (1u << last) - 1u;
  return to & ~below;
}

// The part of the emitter that surfaces along one direction cover, from samples of increasing tangent.
struct NearLine {
  uint covered;  // ring_bits
  float at;      // tangent of the last sample
  float radius;  // of the emitter's point that it covers
  float over;    // its depth beyond the receiver's; 0: it does not block
  float rise;  // of the depth per tangent to the last sample, if that is on the surface of the one before, otherwise 0
};

// Adds a sample. over: as in NearLine. Neighbouring samples of one surface cover what lies between their points.
// Otherwise the edge of a surface is taken to be between them.
void add_near_sample(inout NearLine line, float at, float over, float k) {
  float middle = mix(line.at, at, kNearEdge), radius = at / (k * max(over, 1e-37));
  float less = min(over, line.over), more = max(over, line.over);
  bool joined = less > kNearJoin * more;
  if (joined) {
    line.covered |= ring_bits(line.radius, radius);
  } else {
    if (line.over > 0.0) line.covered |= ring_bits(line.radius, middle / (k * line.over));
    if (over > 0.0) line.covered |= ring_bits(middle / (k * over), radius);
  }
  line.rise = joined ? (over - line.over) / max(at - line.at, 1e-6) : 0.0;
  line.at = at;
  line.radius = radius;
  line.over = over;
}

// The surface of the last two samples goes on.
void end_near_line(inout NearLine line, float k) {
  if (line.over > 0.0 && line.rise > 0.0) line.covered |= ring_bits(line.radius, 1.0 / (k * line.rise));
}

// Share of the emitter's part above the receiver plane that the receiver sees. widest: tangent of the widest direction
// in which a blocker may lie. needed: false: the result is not used, and the loop is empty.
float near_visibility(ShadowPoint p, float widest, bool needed) {
  NearFrame f = near_frame(p);
  NearLine line = NearLine(0u, 0.0, 0.0, 0.0, 0.0);
  float first = max(0.5 / f.to_texel, widest / 64.0), octaves = max(log2(widest / first), 1.0);
  int seen = 0, all = 0, n = 0, end = needed ? kNearDirections * (kNearSteps + 1) : 0;
  while (n < end) {  // not do … while: a repeated body would change the sums, see never()
    int direction = n / (kNearSteps + 1), s = n - direction * (kNearSteps + 1);
    float angle = 6.2831853 / float(kNearDirections) * (float(direction) + 0.5);
    vec3 toward = f.axes * vec3(cos(angle), sin(angle), 0.0);
    float jitter = fract(float(direction) * 0.618034) - 0.5;
    float tangent = s == 0 ? 0.0 : first * exp2(octaves * (float(s) + jitter) / float(kNearSteps));
    vec3 v = f.axes[2] + toward * tangent;
    float depth = near_depth(p, f, v);
    bool blocks = depth > max(dot(f.plane, v) + f.bias, f.depth);
    if (s == 0) line = NearLine(0u, 0.0, 0.0, 0.0, 0.0);
    add_near_sample(line, max(dot(v - f.axes[2], toward), 0.0), blocks ? depth - f.depth : 0.0, f.k);
    if (s == kNearSteps) {
      end_near_line(line, f.k);
      float rise = dot(f.plane, toward) * f.k;  // of the receiver plane, over the emitter's radius
      uint above = ring_bits(0.0, rise > 1.0 ? 1.0 / rise : 1.0);
      seen += bitCount(above & ~line.covered);
      all += bitCount(above);
    }
    ++n;
  }
  return all > 0 ? float(seen) / float(all) : 1.0;
}

#endif

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

const int kNearSteps = 16;
const float kNearJoin = 0.4;  // least ratio of depths, beyond the receiver's, of neighbouring samples of one surface
// Place of an edge between two samples, as a share: with it the mean area is right, wherever the edge lies on the
// logarithmic scale.
const float kNearEdge = 0.43;
const uint kSectorsKnown = 256u;  // in NearBounds::sectors
const float kNearFirst = 0.05;    // tangent of the first ring of near_bounds()
const float kNearAround = 0.42;   // half of the way to a neighbour on these rings, as a share of the tangent
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
  float a_texel;   // tangent of a texel
};

NearFrame near_frame(ShadowPoint p) {
  NearFrame f;
  f.to_texel = 0.5 * p.size / p.tan_half;
  f.a_texel = 1.0 / f.to_texel;
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

// The side of a cube that a direction falls on: its axis (z where neither x nor y) and its sign. Same faces as
// cube_face_of() and cube_face_axes(), without their matrices, which cost a third of near_visibility().
struct CubeSide {
  bool x, y;
  float sign;
};

CubeSide cube_side_of(vec3 v) {
  vec3 a = abs(v);
  bool x = a.x >= a.y && a.x >= a.z, y = !x && a.y >= a.z;
  return CubeSide(x, y, (x ? v.x : y ? v.y : v.z) >= 0.0 ? 1.0 : -1.0);
}

vec3 into_side(CubeSide s, vec3 v) {
  return vec3(s.x   ? s.sign * v.z
              : s.y ? -v.x
                    : -s.sign * v.x,
              s.y ? -s.sign * v.z : v.y,
              s.sign * (s.x   ? v.x
                        : s.y ? v.y
                              : v.z));
}

vec3 out_of_side(CubeSide s, vec3 local) {
  return vec3(s.x   ? s.sign * local.z
              : s.y ? -local.x
                    : -s.sign * local.x,
              s.y ? s.sign * local.z : local.y,
              s.x   ? s.sign * local.x
              : s.y ? -s.sign * local.y
                    : s.sign * local.z);
}

vec2 origin_of_side(CubeSide s) {
  bool along = s.sign > 0.0;
  vec3 x = along ? light_faces.along_x : light_faces.against_x, y = along ? light_faces.along_y : light_faces.against_y;
  return s.x ? vec2(x.x, y.x) : s.y ? vec2(x.y, y.y) : vec2(x.z, y.z);
}

// Where a direction falls on the light's faces.
struct NearPlace {
  CubeSide side;
  vec2 origin;  // corner of the face in the atlas
  vec3 local;   // the direction, in the face's axes
  vec2 at;      // texels of mip 0 from the face's corner
};

NearPlace near_place(ShadowPoint p, NearFrame f, vec3 v) {
  bool cube = p.face >= 0;
  NearPlace place;
  place.side = cube_side_of(v);
  vec3 in_side = into_side(place.side, v);
  place.origin = cube ? origin_of_side(place.side) : p.origin;
  place.local = cube ? in_side : v;
  place.at = vec2(place.local.x, -place.local.y) * (f.to_texel / place.local.z) + 0.5 * p.size;
  return place;
}

// The map's texel in a direction.
struct NearTexel {
  float depth;  // along w; 0 outside a spot's map
  vec3 toward;  // its centre, a direction whose component along w is 1
};

NearTexel near_texel(ShadowPoint p, NearFrame f, vec3 v) {
  NearPlace place = near_place(p, f, v);
  vec2 cell = clamp(floor(place.at), vec2(0.0), vec2(p.size - 1.0));
  bool cube = p.face >= 0, inside = cube || all(equal(cell, floor(place.at)));
  float depth = texelFetch(shadow_atlas, ivec2(place.origin + cell), 0).x;
  vec2 center = (cell + 0.5 - 0.5 * p.size) * f.a_texel;
  vec3 local = vec3(center.x, -center.y, 1.0), turned = out_of_side(place.side, local);
  vec3 toward = cube ? turned : local;
  float along = 1.0 / (cube ? dot(toward, f.axes[2]) : 1.0);
  return NearTexel(inside ? depth * along : 0.0, toward * along);
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
  bool umbra;    // surfaces surely hide all of the emitter
  float reach;   // tangent beyond which no blocker lies in the cone to the emitter; 0: there is none at all
  uint sectors;  // kSectorsKnown; bit i: rings found blockers that may lie in the cone, around the angle i · 45°
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
  NearBounds bounds = NearBounds(false, 0.0, kSectorsKnown);
  float least = f.depth + f.bias, step = 0.0, rise = 0.0;
  float slope = length(f.plane - dot(f.plane, f.axes[2]) / dot(f.axes[2], f.axes[2]) * f.axes[2]);
  int n = 0, rings = clamp(ceil_log2(max(widest / kNearFirst, 1.0)) + 1, 1, 8),
      end = needed ? kRings + 1 + 8 * rings : 0;
  while (n < end) {  // see near_visibility()
    bool square = n < kRings;
    int i = square ? max(n - 1, 0) : n - kRings;
    float tangent = i == 0 ? 0.0 : kNearFirst * power_of_two((i - 1) >> 3), angle = 0.78539816 * float(i & 7);
    vec2 at = square ? (vec2(i % kSide, i / kSide) - float(kSide / 2)) * step : vec2(cos(angle), sin(angle)) * tangent;
    float reach = square ? kBeyond * step : i == 0 ? kNearFirst * (1.0 - kNearAround) : kNearAround * tangent;
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
    bounds.sectors |= blocks && i > 0 ? 1u << (i & 7) : 0u;
    bounds.umbra = bounds.umbra || (hidden && n == kRings - 1);
    n = !square || hidden ? n + 1 : kRings;
    n = bounds.umbra ? end : n;
  }
  return bounds;
}

// Bits of the emitter's rings between the radii a and b, in any order. The 32 rings have equal areas.
uint ring_bits(float a, float b) {
  float low = min(a, b), high = max(a, b);
  int first = int(32.0 * min(low * low, 1.0) + 0.5), last = int(32.0 * min(high * high, 1.0) + 0.5);
  uint below = first >= 32 ? ~0u : (1u << first) - 1u;
  uint to = last >= 32 ? ~0u : (1u << last) - 1u;
  return to & ~below;
}

// The part of the emitter that surfaces along one direction cover, from samples of increasing tangent.
struct NearLine {
  uint covered;   // ring_bits
  float at;       // tangent of the last sample
  float radius;   // of the emitter's point that it covers
  float over;     // its depth beyond the receiver's; 0: it does not block
  float per_at;   // radius over tangent
  float goes_on;  // radius at which its surface ends; its own where it is not on the surface of the sample before
};

// Adds a sample. over: as in NearLine. Neighbouring samples of one surface cover what lies between their points.
// Otherwise the edge of a surface is taken to be between them.
void add_near_sample(inout NearLine line, float at, float over, float k) {
  float middle = mix(line.at, at, kNearEdge), per_at = 1.0 / (k * max(over, 1e-37)), radius = at * per_at;
  float rise = over - line.over;
  bool joined = min(over, line.over) > kNearJoin * max(over, line.over);
  // Of an edge, both sides; of a surface, what lies between its samples.
  uint before = ring_bits(line.radius, joined ? radius : middle * line.per_at);
  uint after = ring_bits(middle * per_at, radius);
  line.covered |= line.over > 0.0 ? before : 0u;
  line.covered |= !joined && over > 0.0 ? after : 0u;
  line.goes_on = joined && rise > 0.0 ? max(at - line.at, 1e-6) / (k * rise) : radius;
  line.at = at;
  line.radius = radius;
  line.over = over;
  line.per_at = per_at;
}

// Samples of a direction in whose sector the rings found no blocker: those that the rings do not cover, and the next
// one, which ends what they found.
int inner_samples(NearFrame f, float first, float octaves) {
  float inner = kNearFirst * (1.0 - kNearAround) + f.a_texel;
  return clamp(int(ceil(log2(inner / first) * float(kNearSteps) / octaves + 0.5)) + 2, 2, kNearSteps + 1);
}

// Share of the emitter's part above the receiver plane that the receiver sees. widest: tangent of the widest direction
// in which a blocker may lie. sectors: of NearBounds. 0: the result is not used.
float near_visibility(ShadowPoint p, float widest, uint sectors) {
  // Directions are 6° to 17° from the middles of their sectors, and the texels of the rings reach 22°.
  float offset = kNearDirections == 8 ? 0.25 : 0.5;
  NearFrame f = near_frame(p);
  float first = max(0.5 * f.a_texel, widest / 64.0), octaves = max(log2(widest / first), 1.0);
  int seen = 0, all = 0, n = sectors != 0u ? 0 : kNearDirections, inner = inner_samples(f, first, octaves);
  while (n < kNearDirections) {  // not do … while: a repeated body would change the sums, see never()
    float turn = (float(n) + offset) / float(kNearDirections), jitter = fract(float(n) * 0.618034) - 0.5;
    vec3 toward = f.axes * vec3(cos(6.2831853 * turn), sin(6.2831853 * turn), 0.0);
    float middle = dot(f.axes[2], toward);
    NearLine line = NearLine(0u, 0.0, 0.0, 0.0, 0.0, 0.0);
    int s = 0, samples = (sectors >> (int(8.0 * turn + 0.5) & 7) & 1u) != 0u ? kNearSteps + 1 : inner;
    while (s < samples) {
      float tangent = s == 0 ? 0.0 : first * exp2(octaves / float(kNearSteps) * (float(s) + jitter));
      NearTexel texel = near_texel(p, f, f.axes[2] + toward * tangent);
      bool blocks = texel.depth > max(dot(f.plane, texel.toward) + f.bias, f.depth);
      add_near_sample(line, max(dot(texel.toward, toward) - middle, 0.0), blocks ? texel.depth - f.depth : 0.0, f.k);
      ++s;
    }
    uint covered = line.covered | (line.over > 0.0 ? ring_bits(line.radius, line.goes_on) : 0u);
    float rise = dot(f.plane, toward) * f.k;  // of the receiver plane, over the emitter's radius
    uint above = ring_bits(0.0, rise > 1.0 ? 1.0 / rise : 1.0);
    seen += bitCount(above & ~covered);
    all += bitCount(above);
    ++n;
  }
  return all > 0 ? float(seen) / float(all) : 1.0;
}

#endif

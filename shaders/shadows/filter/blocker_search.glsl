// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_BLOCKER_SEARCH_GLSL
#define GLOAM_SHADERS_SHADOWS_BLOCKER_SEARCH_GLSL

#include "shaders/shadows/filter/taps.glsl"

// Search region: a square around a receiver that holds all its possible blockers. It is as wide as the penumbra of the
// nearest surface in it.
struct SearchRegion {
  float width;     // texels of mip 0
  float nearest;   // at least the nearest depth in the region
  float farthest;  // at most the farthest depth in the region; 0: unknown
};

float nearest_of(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }
float farthest_of(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }

// Nearest and farthest depth of the four texels around a corner of the pyramid, in texels of its level 0.
float gather_nearest(vec2 corner) {
  return nearest_of(textureGather(shadow_pyramid, corner * shadow_texel_size() * vec2(4.0, 2.0)));
}
float gather_farthest(vec2 corner) {
  return farthest_of(textureGather(shadow_pyramid, corner * shadow_texel_size() * vec2(4.0, 2.0) + vec2(0.0, 0.5)));
}

// Nearest and farthest depth of texels [low, high] of a face, from its pyramid. Texels beyond the face are ignored.
float nearest_in_face(vec2 origin, float size, vec2 low, vec2 high, out float farthest) {
  low = clamp(low, vec2(0.0), vec2(size)) * 0.25;
  high = clamp(high, vec2(0.0), vec2(size)) * 0.25;
  int last = floor_log2(size) - GLOAM_SHADOW_PYRAMID_MIP - 1;
  float side = max(high.x - low.x, high.y - low.y);
  int level = clamp(ceil_log2(max(side / 3.0, 1.0)), 0, last);
  MipSquare square = mip_square(origin * 0.25, size * 0.25, level, shadow_block.atlas_size * 0.25);
  // Four by four texels hold a square three texels wide at any position; the coarsest level has only two by two.
  vec2 first = floor(low / square.texel) + 1.0;
  float nearest = 0.0;
  farthest = 1.0;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = clamp(first + 2.0 * vec2(i & 1, i >> 1), vec2(1.0), vec2(square.size - 1.0));
    nearest = max(nearest, gather_nearest(square.corner + corner));
    farthest = min(farthest, gather_farthest(square.corner + corner));
  }
  return nearest;
}

float penumbra_width(ShadowPoint p, float blocker) { return clamp(p.scale * (blocker - p.depth), 0.0, p.size); }

// The finest pyramid level with texels at least this wide. Two by two of its texels hold a square of that width around
// any point.
int pyramid_level(float width, int last) {
  return clamp(ceil_log2(max(width, 1.0)) - GLOAM_SHADOW_PYRAMID_MIP, 0, last);
}

vec2 pyramid_corner(ShadowPoint p, int level) {
  MipSquare square = mip_square(p.origin * 0.25, p.size * 0.25, level, shadow_block.atlas_size * 0.25);
  vec2 corner = floor(p.at * 0.25 / square.texel - 0.5) + 1.0;
  return square.corner + clamp(corner, vec2(1.0), vec2(square.size - 1.0));
}

#ifdef GLOAM_SHADOWS_CROSSING
// Whether another cube face, with this nearest depth, may hold a blocker between the emitter and a receiver of `depth`,
// which is `off` texels from the border with that face. A surface of that face at the tangent t ≥ 1 has t times its
// depth in the receiver's own face. There the cone (SearchCone) begins at depth + 2 (t − tangent of the receiver) /
// (scale · to_tangent). Both are linear in t: the surface may block only if its depth rises faster than the cone, or if
// it is in the cone at the border already.
bool may_block_from_other_face(float nearest, float depth, float off, float scale, float to_tangent) {
  float a_texel = 2.0 / max(scale, 1e-6);
  return nearest * to_tangent > a_texel || nearest > depth + a_texel * max(off - 4.0, 0.0);
}

// Texels from a point in cube face `own` to the border with another face; 1e9 when they share no border.
float texels_to_face(int own, int face, vec2 at, float size, float to_tangent) {
  mat3 axes = cube_face_axes(own);
  vec3 toward = cube_face_axes(face)[2] * axes;
  float along = dot(vec2(toward.x, -toward.y), at - 0.5 * size);
  return toward.z == 0.0 ? 1.0 / to_tangent - along : 1e9;
}

// Takes one whole cube face into account. face_nearest: its nearest depth. ahead: 1 for the receiver's own face, 0 for
// a neighbour, −1 for the opposite face. along: offset of the receiver from the middle of its own face toward this one,
// texels.
void look_at_face(ShadowPoint p, float face_nearest, float ahead, float along, float to_tangent, inout float nearest,
                  inout bool others) {
  bool other =
      ahead <= 0.0 && may_block_from_other_face(face_nearest, p.depth, ahead == 0.0 ? 1.0 / to_tangent - along : 1e9,
                                                p.scale, to_tangent);
  others = others || other;
  nearest = max(nearest, ahead > 0.0 ? face_nearest : other ? 2.0 * face_nearest : 0.0);
}

// Bound on the nearest depth of all faces that may hold blockers. Depths of other faces count twice, which covers
// tangents up to 2 in the receiver's own face. others: a face other than the receiver's own may hold blockers.
float nearest_of_cube(ShadowPoint p, mat3 own, float to_tangent, out bool others) {
  vec2 off = p.at - 0.5 * p.size;
  vec3 along = own[0] * off.x - own[1] * off.y, ahead = own[2], forward = light_faces.along_nearest,
       backward = light_faces.against_nearest;
  others = false;
  float nearest = 0.0;
  look_at_face(p, forward.x, ahead.x, along.x, to_tangent, nearest, others);
  look_at_face(p, forward.y, ahead.y, along.y, to_tangent, nearest, others);
  look_at_face(p, forward.z, ahead.z, along.z, to_tangent, nearest, others);
  look_at_face(p, backward.x, -ahead.x, -along.x, to_tangent, nearest, others);
  look_at_face(p, backward.y, -ahead.y, -along.y, to_tangent, nearest, others);
  look_at_face(p, backward.z, -ahead.z, -along.z, to_tangent, nearest, others);
  return nearest;
}

// Search region in a cube, from texels of the pyramid. across: set to true if the region leaves the receiver's face;
// only then the returned region is final.
SearchRegion find_region_of_cube(ShadowPoint p, out bool across) {
  const int taps = 9;
  int last = floor_log2(p.size) - GLOAM_SHADOW_PYRAMID_MIP;
  mat3 own = cube_face_axes(p.face);
  float to_tangent = p.tan_half * 2.0 / p.size;
  SearchRegion region = SearchRegion(p.size, 0.0, 0.0);
  bool others;
  region.width = penumbra_width(p, nearest_of_cube(p, own, to_tangent, others));
  across = p.face >= 0 && others && leaves_cube_face(p, 0.5 * region.width);
  int level = pyramid_level(0.5 * region.width, last), tap = 0;
  float nearest = 0.0;
  // First nine texels of that square. They give a smaller square; if it still leaves the face, then nine texels of it.
  for (int left = 2 * taps; across && left > 0; --left) {
    vec2 tangent = (p.at + 0.5 * region.width * vec2(tap % 3 - 1, tap / 3 - 1) - 0.5 * p.size) * to_tangent;
    vec3 v = own * vec3(tangent.x, -tangent.y, 1.0);
    int face = cube_face_of(v);
    vec3 local = v * cube_face_axes(face);
    vec2 there = vec2(local.x, -local.y) / local.z / to_tangent + 0.5 * p.size;
    MipSquare square = mip_square(origin_of_face(face) * 0.25, p.size * 0.25, level, shadow_block.atlas_size * 0.25);
    vec2 cell = clamp(floor(there * 0.25 / square.texel), vec2(0.0), vec2(square.size - 1.0));
    nearest = max(nearest, texelFetch(shadow_pyramid, ivec2(square.corner + cell), 0).x * local.z);
    if (++tap == taps) {
      region.nearest = nearest;
      region.width = min(region.width, penumbra_width(p, nearest));
      across = across && leaves_cube_face(p, 0.5 * region.width);
      level = pyramid_level(0.5 * region.width, last);
      nearest = 0.0;
      tap = 0;
    }
  }
  return region;
}
#endif

// The nearest depth among texels of the pyramid that may hold blockers: those that the cone between receiver and
// emitter meets. 4×4 texels of the level around the receiver are looked at; three texels in a row are at least `width`
// wide.
float nearest_in_cone(ShadowPoint p, float width) {
  const float margin = 2.0;  // texels of mip 0 by which the cone is widened
  int level = pyramid_level(width / 3.0, floor_log2(p.size) - GLOAM_SHADOW_PYRAMID_MIP - 1);
  MipSquare square = mip_square(p.origin * 0.25, p.size * 0.25, level, shadow_block.atlas_size * 0.25);
  float texel = 4.0 * square.texel, a_texel = 2.0 / max(p.scale, 1e-6);
  vec2 at = p.at / texel, first = floor(at - 1.5) + 1.0;
  float nearest = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = clamp(first + 2.0 * vec2(i & 1, i >> 1), vec2(1.0), vec2(square.size - 1.0));
    vec4 depth = textureGather(shadow_pyramid, (square.corner + corner) * shadow_texel_size() * vec2(4.0, 2.0));
    // Distances from the receiver to the two columns and rows of texels, then the least depth of a blocker in each.
    vec2 off = at - corner;
    vec4 beyond = vec4(max(off.x, -1.0 - off.x), max(-off.x, off.x - 1.0), max(off.y, -1.0 - off.y),
                       max(-off.y, off.y - 1.0));  // left, right, upper, lower
    vec4 least = p.depth + a_texel * max(beyond * texel - margin, 0.0);
    vec4 blocks = mix(vec4(0.0), depth, greaterThan(depth, max(least.xyyx, least.wwzz)));
    nearest = max(nearest, nearest_of(blocks));
  }
  return nearest;
}

// How often nearest_in_cone() is worth its fetches: twice where a surface in the face, with this nearest depth, is so
// near to the light that it alone would make the region wide.
int cone_steps(bool orthographic, float of_face, float depth) { return !orthographic && of_face > 4.0 * depth ? 2 : 1; }

// Finds the search region in the receiver's face from coarse to fine: the nearest depth in a square that is too large
// gives a smaller square that still holds all blockers.
SearchRegion find_region_in_face(ShadowPoint p) {
  int last = floor_log2(p.size) - GLOAM_SHADOW_PYRAMID_MIP - 1;
  SearchRegion region;
  float of_face = gather_nearest(pyramid_corner(p, last));
  region.width = penumbra_width(p, of_face);
  region.nearest = gather_nearest(pyramid_corner(p, pyramid_level(region.width, last)));
  region.width = penumbra_width(p, region.nearest);
  int step = 0, steps = cone_steps(p.orthographic, of_face, p.depth);
  if (region.nearest > p.threshold) do {
      region.nearest = nearest_in_cone(p, region.width);
      region.width = min(region.width, penumbra_width(p, region.nearest));
    } while (++step < steps);
  region.farthest = gather_farthest(pyramid_corner(p, pyramid_level(region.width, last)));
  return region;
}

// The same, in all faces of a cube that the region reaches.
SearchRegion find_region(ShadowPoint p) {
  bool across = false;
  SearchRegion region = SearchRegion(p.size, 0.0, 0.0);
#ifdef GLOAM_SHADOWS_CROSSING
  if ((kKinds & GLOAM_SHADOWS_CUBES) != 0u) region = find_region_of_cube(p, across);
#endif
  if (!across) do {
      region = find_region_in_face(p);
    } while (never(p));
  return region;
}

struct Blockers {
  float count;  // blocking texels in the cone; with whole_plane: their weights, (N − 1)² if every texel blocks
  float depth;  // depth at the mean distance of the blockers; depth of the receiver if none blocks
};

Blockers blockers_of(ShadowPoint p, float count, float sum) {
  float mean = sum / max(count, 1e-6);
  return Blockers(count, count <= 1e-6 ? p.depth : p.orthographic ? mean : 1.0 / mean);
}

// Sums over the two rows of a gather.
struct BlockerSums {
  vec2 count;  // lower row, upper row
  vec2 distance;
};

// Least half width of a search, in texels. A narrower one would miss edges between its few texels.
const float kLeastHalfWidth = 1.5;

// Blockers lie in the cone between receiver and emitter: the farther a texel is from the receiver's texel, the nearer
// to the light a blocker in it must be. Offsets are in texels of a mip. reach: offset up to which the least depth of a
// blocker is still `apex`.
struct SearchCone {
  float apex;  // depth of the receiver
  float depth_per_texel;
  float reach;
  float least;  // least depth of a blocker
};

// half_width: of the search region, texels of the mip. whole_plane: no cone; all texels of the kernel are compared with
// the receiver plane, for kernels of a fixed width. Otherwise blockers must be nearer to the light than the receiver.
SearchCone make_cone(ShadowPoint p, Kernel k, float half_width, bool whole_plane) {
  if (whole_plane) return SearchCone(0.0, 0.0, 0.0, p.least);
  return SearchCone(p.depth, 2.0 * k.square.texel / max(p.scale, 1e-6), 0.5 + max(kLeastHalfWidth - half_width, 0.0),
                    max(k.least, p.threshold));
}

// Least depths of blockers at these offsets, in texels.
vec4 cone_depths(SearchCone cone, vec4 off) {
  return max(cone.apex + (abs(off) - cone.reach) * cone.depth_per_texel, vec4(cone.least));
}

// Least depths of a cone over the gathers of an 8×8 kernel: in the left and right column of each gather column, and in
// the upper and lower row of each gather row.
struct ConeEdges8 {
  vec4 left, right, upper, lower;
};

ConeEdges8 cone_edges(SearchCone cone, Kernel k) {
  const vec4 low = vec4(-3.0, -1.0, 1.0, 3.0), high = vec4(-2.0, 0.0, 2.0, 4.0);
  return ConeEdges8(cone_depths(cone, low - k.fraction.x), cone_depths(cone, high - k.fraction.x),
                    cone_depths(cone, low - k.fraction.y), cone_depths(cone, high - k.fraction.y));
}

// Shares of the emitter that texels with these depths hide: a texel is the smaller on the emitter, the nearer its
// surface is to the light. a_texel: difference of depths at which a texel hides all of it.
vec4 hidden_shares(ShadowPoint p, vec4 depth, float a_texel) {
  vec4 ratio = a_texel / max(depth - p.depth, vec4(a_texel));
  return ratio * ratio;
}

// Adds the blockers of one gather. threshold: of each texel. rows: least depths of the cone in the lower and upper row;
// columns: in the left and right column. left, right: weights of the columns.
void add_blockers(inout BlockerSums sums, ShadowPoint p, vec2 at, vec4 threshold, vec2 rows, vec2 columns, float left,
                  float right, float a_texel) {
  vec4 depth = textureGather(shadow_atlas, at);
  vec4 share = hidden_shares(p, depth, a_texel) * vec4(left, right, right, left);
  vec4 distance = share * (p.orthographic ? depth : 1.0 / depth);
  bvec4 blocks = is_nearer(depth, threshold, rows.xxyy, columns.xyyx);
  sums.count.x = blocks.x ? sums.count.x + share.x : sums.count.x;
  sums.count.x = blocks.y ? sums.count.x + share.y : sums.count.x;
  sums.count.y = blocks.z ? sums.count.y + share.z : sums.count.y;
  sums.count.y = blocks.w ? sums.count.y + share.w : sums.count.y;
  sums.distance.x = blocks.x ? sums.distance.x + distance.x : sums.distance.x;
  sums.distance.x = blocks.y ? sums.distance.x + distance.y : sums.distance.x;
  sums.distance.y = blocks.z ? sums.distance.y + distance.z : sums.distance.y;
  sums.distance.y = blocks.w ? sums.distance.y + distance.w : sums.distance.y;
}

// Two gathers side by side. rows: least depths of the lower and upper texel row; shares: weights of these rows; ends:
// weights of the outermost columns.
void add_blocker_row(inout vec2 sums, ShadowPoint p, vec2 u, float v, vec2 columns, float row, vec4 corner, vec2 rows,
                     vec2 left, vec2 right, vec2 shares, vec2 ends, float a_texel) {
  BlockerSums s = BlockerSums(vec2(0.0), vec2(0.0));
  add_blockers(s, p, vec2(u.x, v), columns.x + row + corner, rows, vec2(left.x, right.x), ends.x, 1.0, a_texel);
  add_blockers(s, p, vec2(u.y, v), columns.y + row + corner, rows, vec2(left.y, right.y), 1.0, ends.y, a_texel);
  sums += vec2(dot(s.count, shares), dot(s.distance, shares));
}

// Finds blockers among 8×8 texels, as find_blockers() does: first in the inner 4×4, then beside them, above and below
// them, and in the corners. A cone of half_width often reaches only the inner texels. Only whole_plane kernels have
// bilinear edges; a cone limits its texels by depth.
Blockers find_blockers_8(ShadowPoint p, int mip, bool whole_plane, float half_width) {
  Kernel k = make_kernel(p, mip, 8);
  Gathers8 g = make_gathers(k);
  SearchCone cone = make_cone(p, k, half_width, whole_plane);
  ConeEdges8 e = cone_edges(cone, k);
  vec2 first = whole_plane ? 1.0 - k.fraction : vec2(1.0), last = whole_plane ? k.fraction : vec2(1.0);
  vec2 beyond = min(k.fraction, 1.0 - k.fraction),
       sums = vec2(0.0);  // the middles of outer texels are at least 2 + beyond away
  bool inner_only = !whole_plane && kFullPenumbra == 0u && half_width <= kLeastHalfWidth + min(beyond.x, beyond.y);
  float a_texel = whole_plane ? 1e9 : k.square.texel / max(p.scale, 1e-6);
  int turn = 0, turns = inner_only ? 1 : 4;
  do {
    bool outer_x = (turn & 1) != 0, outer_y = turn > 1;
    sums = turn == 0 ? vec2(0.0) : sums;  // reset, as the body may run again: see never()
    vec2 u = outer_x ? g.u.xw : g.u.yz, columns = outer_x ? g.column.xw : g.column.yz, v = outer_y ? g.v.xw : g.v.yz;
    vec2 rows = outer_y ? g.row.xw : g.row.yz, ends = outer_x ? vec2(first.x, last.x) : vec2(1.0);
    vec2 lefts = outer_x ? e.left.xw : e.left.yz, rights = outer_x ? e.right.xw : e.right.yz;
    vec2 uppers = outer_y ? e.upper.xw : e.upper.yz, lowers = outer_y ? e.lower.xw : e.lower.yz;
    add_blocker_row(sums, p, u, v.x, columns, rows.x, g.corner, vec2(lowers.x, uppers.x), lefts, rights,
                    vec2(1.0, outer_y ? first.y : 1.0), ends, a_texel);
    add_blocker_row(sums, p, u, v.y, columns, rows.y, g.corner, vec2(lowers.y, uppers.y), lefts, rights,
                    vec2(outer_y ? last.y : 1.0, 1.0), ends, a_texel);
  } while (++turn < turns);
  return blockers_of(p, sums.x, sums.y);
}

#ifndef GLOAM_SHADOWS_STANDARD
// Finds blockers among N × N texels, with (N / 2)² gathers. Parameters: see make_cone().
Blockers find_blockers(ShadowPoint p, int mip, int texels, bool whole_plane, float half_width) {
  Kernel k = make_kernel(p, mip, texels);
  SearchCone cone = make_cone(p, k, half_width, whole_plane);
  vec2 first = whole_plane ? 1.0 - k.fraction : vec2(1.0), last = whole_plane ? k.fraction : vec2(1.0);
  vec4 count = vec4(0.0), sum = vec4(0.0);
  for (int y = 0; y < texels; y += 2) {
    vec2 share_y = vec2(y == 0 ? first.y : 1.0, y + 2 == texels ? last.y : 1.0);
    float corner_y = k.base.y + float(y) + 1.0;
    for (int x = 0; x < texels; x += 2) {
      vec2 share_x = vec2(x == 0 ? first.x : 1.0, x + 2 == texels ? last.x : 1.0);
      vec2 corner = vec2(k.base.x + float(x) + 1.0, corner_y);
      vec2 off = corner - k.at;
      vec4 least = max(cone_depths(cone, off.x + vec4(-0.5, 0.5, 0.5, -0.5)),
                       cone_depths(cone, off.y + vec4(0.5, 0.5, -0.5, -0.5)));
      corner = vec2(clamp_corner(k, corner.x), clamp_corner(k, corner.y));
      vec4 depth = gather_depth(k, corner);
      vec4 threshold = max(gather_threshold(k, corner, cone.least), least);
      vec4 weight = share_x.xyyx * share_y.yyxx * vec4(greaterThan(depth, threshold));
      weight *= hidden_shares(p, depth, whole_plane ? 1e9 : k.square.texel / max(p.scale, 1e-6));
      sum += weight * (p.orthographic ? depth : 1.0 / max(depth, threshold));
      count += weight;
    }
  }
  return blockers_of(p, dot(count, vec4(1.0)), dot(sum, vec4(1.0)));
}
#endif

#ifdef GLOAM_SHADOWS_CROSSING
// The same for kernels that leave the receiver's cube face: texel by texel.
Blockers find_blockers_across(ShadowPoint p, int mip, int texels, bool whole_plane, float half_width) {
  Kernel k = make_kernel(p, mip, texels);
  SearchCone cone = make_cone(p, k, half_width, whole_plane);
  float count = 0.0, sum = 0.0;
  for (int i = 0; i < texels * texels; ++i) {
    vec2 cell = vec2(i % texels, i / texels);
    vec2 share = whole_plane ? edge_shares(k.fraction, cell, float(texels)) : vec2(1.0);
    vec2 at = (k.base + cell + 0.5) * k.square.texel;
    float rise, covered_share;
    float depth = cube_depth(p, at, mip, rise, covered_share);
    vec4 least = cone_depths(cone, vec4(at / k.square.texel - k.at, 0.0, 0.0));
    float threshold = max(tap_threshold(p, k, at, cone.least, rise), max(least.x, least.y));
    float weight = depth > threshold ? share.x * share.y : 0.0;
    weight *= hidden_shares(p, vec4(depth), whole_plane ? 1e9 : k.square.texel / max(p.scale, 1e-6)).x;
    count += weight;
    sum += weight / max(depth, threshold);
  }
  return Blockers(count, count <= 1e-6 ? p.depth : count / sum);
}
#endif

Blockers box_blockers(ShadowPoint p, int mip, int texels, bool whole_plane, float half_width) {
  Blockers found = Blockers(0.0, p.depth);
  bool across = leaves_cube_face(p, kernel_reach(mip, texels));
  if (!across) do {
#ifdef GLOAM_SHADOWS_STANDARD
      found = find_blockers_8(p, mip, whole_plane, half_width);
#else
      found = texels == 8 ? find_blockers_8(p, mip, whole_plane, half_width)
                          : find_blockers(p, mip, texels, whole_plane, half_width);
#endif
    } while (never(p));
#ifdef GLOAM_SHADOWS_CROSSING
  if (across) do {
      found = find_blockers_across(p, mip, texels, whole_plane, half_width);
    } while (never(p));
#endif
  return found;
}

// The finest mip whose kernel holds the search region.
int region_mip(ShadowPoint p, SearchRegion region) {
  return clamp(ceil_log2(max(region.width / float(kKernel - 1), 1.0)), 0, coarsest_mip(p, kKernel));
}

Blockers region_blockers(ShadowPoint p, SearchRegion region) {
  int mip = region_mip(p, region);
  return box_blockers(p, mip, kKernel, false, 0.5 * region.width * power_of_two(-mip));
}

#endif

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_MIPS_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_MIPS_GLSL

#include "shaders/shadows/maps/mips_shared.h"
#include "shaders/shadows/shadows_shared.h"

// Makes mips of faces and their pyramid. The first run copies the faces' depth from the scratch image into the atlas
// and makes mips 1 to 3; each further run makes the next three mips from the last one that exists. Each thread
// processes a block of 8 × 8 texels of its source; all threads of a workgroup belong to one face. Before including
// this, define GLOAM_SHADOW_ATLAS_FORMAT. If the atlas format is coarser than the scratch image, also define
// GLOAM_SHADOW_ATLAS_STEPS: mips are then made from the rounded depths. With GLOAM_SHADOW_MIPS_IN_PLACE there is no
// scratch image: mip 0 is in the atlas already. With GLOAM_SHADOW_BOUNDS_ONLY the atlas gets mip 0 only, and the
// coarser mips exist only in the pyramid.

layout(local_size_x = GLOAM_SHADOW_MIP_GROUP, local_size_y = GLOAM_SHADOW_MIP_GROUP) in;
#ifndef GLOAM_SHADOW_MIPS_IN_PLACE
layout(set = 0, binding = 0) uniform sampler2DArray scratch;
#endif
layout(set = 0, binding = 1, GLOAM_SHADOW_ATLAS_FORMAT) uniform image2D atlas;
layout(set = 0, binding = 2, r32f) uniform image2D pyramid;
layout(set = 0, binding = 3, scalar) readonly buffer Groups { ShadowMipGroup groups[]; };
#ifndef GLOAM_SHADOW_MIPS_IN_PLACE
// Depth of resting casters, laid out as mip 0 of the atlas.
layout(set = 0, binding = 4) uniform sampler2DArray backgrounds;
#endif
layout(push_constant, scalar) uniform Constants { ShadowMipConstants run; };
// The mip operator, so that the shader holds no code of the others.
layout(constant_id = 0) const uint kMipOperator = GLOAM_SHADOW_MIPS_AS_PUSHED;
// Which runs the pipeline makes: a processor goes through the code of both. 0: both; 1: the first; 2: further ones.
layout(constant_id = 1) const uint kRuns = 0u;

bool is_operator(int mip_operator) {
  return (kMipOperator == uint(GLOAM_SHADOW_MIPS_AS_PUSHED) ? run.mip_operator : kMipOperator) == uint(mip_operator);
}

ShadowMipGroup face;  // this workgroup's entry

// Accumulates the texels that become one texel of the next mip.
struct Texels {
  float nearest;
  float sum;      // sum over occupied texels of the distances in units of the near plane (orthographic: of the depths)
  float count;    // occupied texels
  float covered;  // texels that the nearest surface covers, summed by share
  float depths;   // sum of the nearest surface's depths, weighted by the covered share of each texel
  vec2 bounds;    // values of the pyramid: farthest, nearest
};

const Texels kNone = Texels(0.0, 0.0, 0.0, 0.0, 0.0, vec2(1.0, 0.0));

const uint kFreeBits = GLOAM_SHADOW_FREE_BITS;

float without_free_bits(float depth) { return uintBitsToFloat(floatBitsToUint(depth) & ~kFreeBits); }

// Adds a texel to the nearest surface. gap: greatest depth step of one surface from a texel to the next
// (ShadowMipGroup::gap); depths that differ by more belong to different surfaces.
void add_covered(inout Texels t, float texel, float gap) {
  float depth = without_free_bits(texel);
  float share = depth > 0.0 ? 1.0 - float(floatBitsToUint(texel) & kFreeBits) / 64.0 : 0.0;
  float near = max(depth, t.nearest), far = min(depth, t.nearest);
  bool same = far > 0.0 && (face.orthographic != 0u ? near - far <= gap : near <= far * (1.0 + gap));
  bool first = !same && depth > t.nearest;
  t.covered = same ? t.covered + share : first ? share : t.covered;
  t.depths = same ? t.depths + share * depth : first ? share * depth : t.depths;
  t.nearest = near;
}

// gap: as in add_covered(), for texels of the mip that is being made.
void add(inout Texels t, float depth, vec2 bounds, float gap) {
  t.bounds = vec2(min(t.bounds.x, bounds.x), max(t.bounds.y, bounds.y));
#ifndef GLOAM_SHADOW_BOUNDS_ONLY
  bool occupied = depth > 0.0;
  if (is_operator(GLOAM_SHADOW_MIPS_COVERAGE))
    add_covered(t, depth, gap);
  else
    t.nearest = max(t.nearest, depth);
  t.sum += occupied ? (face.orthographic != 0u ? depth : 1.0 / depth) : 0.0;
  t.count += occupied ? 1.0 : 0.0;
#endif
}

float depth_of(Texels t) {
#ifdef GLOAM_SHADOW_BOUNDS_ONLY
  return 0.0;
#endif
  if (is_operator(GLOAM_SHADOW_MIPS_COVERAGE)) {
    uint free = uint(clamp(floor((1.0 - 0.25 * t.covered) * 64.0 + 0.5), 0.0, float(kFreeBits)));
    // The mean depth of a plane is its depth in the middle.
    return t.nearest > 0.0 ? uintBitsToFloat(floatBitsToUint(without_free_bits(t.depths / t.covered)) | free) : 0.0;
  }
  if (is_operator(GLOAM_SHADOW_MIPS_NEAREST) || t.count == 0.0) return t.nearest;
  return face.orthographic != 0u ? t.sum / t.count : t.count / t.sum;
}

ivec2 mip_corner(uint mip, uint atlas_size) {
  return mip == 0u ? ivec2(0) : ivec2(atlas_size, atlas_size - (2u * atlas_size >> mip));
}

void store_depth(uint mip, uvec2 at, float depth) {
#ifdef GLOAM_SHADOW_BOUNDS_ONLY
  if (mip > 0u) return;
#endif
  imageStore(atlas, mip_corner(mip, run.atlas_size) + ivec2((face.origin >> mip) + at), vec4(depth));
}

// Texel of the pyramid that holds the nearest depth of a mip's texel. The farthest depth is at that texel +
// below_nearest().
ivec2 nearest_place(uint mip, uvec2 at) {
  return mip_corner(mip - uint(GLOAM_SHADOW_PYRAMID_MIP), run.atlas_size / 4u) + ivec2((face.origin >> mip) + at);
}

ivec2 below_nearest() { return ivec2(0, run.atlas_size / 4u); }

void store_bounds(uint mip, uvec2 at, vec2 bounds) {
  ivec2 place = nearest_place(mip, at);
  imageStore(pyramid, place, vec4(bounds.y));
  imageStore(pyramid, place + below_nearest(), vec4(bounds.x));
}

// Stores a texel of a mip, unless the face is too small to have that mip.
void store(uint mip, uvec2 at, float depth, vec2 bounds) {
  uint size = face.size >> mip;  // 0 if the face is too small to have this mip
  if (at.x >= size || at.y >= size) return;
  store_depth(mip, at, depth);
  store_bounds(mip, at, bounds);
}

// The depth rounded to the value that mip 0 of the atlas stores.
float held_depth(float depth) {
#ifdef GLOAM_SHADOW_ATLAS_STEPS
  depth = floor(clamp(depth, 0.0, 1.0) * GLOAM_SHADOW_ATLAS_STEPS + 0.5) / GLOAM_SHADOW_ATLAS_STEPS;
#endif
  return is_operator(GLOAM_SHADOW_MIPS_COVERAGE) ? without_free_bits(depth) : depth;
}

#ifdef GLOAM_SHADOW_MIPS_IN_PLACE
// Reads the four texels of mip 0 that become texel `at1` of mip 1.
Texels first_texels(uvec2 at1, float gap) {
  Texels texels = kNone;
  for (uint one = 0u; one < 4u; ++one) {
    uvec2 at = at1 * 2u + uvec2(one & 1u, one >> 1);
    // Rounds again, because loading may change the stored value by conversion.
    float depth = held_depth(imageLoad(atlas, ivec2(face.origin + at)).x);
    add(texels, depth, vec2(depth), gap);
  }
  return texels;
}
#else
// Copies four texels of the scratch image into the atlas; they become texel `at1` of mip 1.
Texels first_texels(uvec2 at1, float gap) {
  vec4 gathered = textureGather(scratch, vec3(vec2(at1 * 2u + 1u) / float(face.size), float(face.layer)));
  // The map holds the nearest depth of resting and moving casters.
  if (face.on_background != 0u)
    gathered =
        max(gathered, textureGather(backgrounds, vec3(vec2(face.origin + at1 * 2u + 1u) / float(run.atlas_size), 0.0)));
  float depths[4] = float[4](gathered.w, gathered.z, gathered.x, gathered.y);
  Texels texels = kNone;
  for (uint one = 0u; one < 4u; ++one) {
#ifdef GLOAM_SHADOW_ATLAS_STEPS
    depths[one] *= face.depth_scale;
#endif
    float depth = held_depth(depths[one]);
    store_depth(0u, at1 * 2u + uvec2(one & 1u, one >> 1), depth);
    add(texels, depth, vec2(depth), gap);
  }
  return texels;
}
#endif

// Makes mips 0 to 3 of a block (in place: 1 to 3). All faces have them, as the smallest is 16 texels wide.
void make_first_mips(uvec2 block, float gap) {
  Texels third = kNone;
  uint quarter = 0u;
  do {
    uvec2 at2 = block * 2u + uvec2(quarter & 1u, quarter >> 1);
    Texels second = kNone;
    uint four = 0u;
    do {
      uvec2 at1 = at2 * 2u + uvec2(four & 1u, four >> 1);
      Texels first = first_texels(at1, gap);
      float depth = depth_of(first);
      store_depth(1u, at1, depth);
      add(second, depth, first.bounds, 2.0 * gap);
    } while (++four < 4u);
    float depth = depth_of(second);
    store_depth(2u, at2, depth);
    store_bounds(2u, at2, second.bounds);
    add(third, depth, second.bounds, 4.0 * gap);
  } while (++quarter < 4u);  // tested at the end: see docs/development.md
  store_depth(3u, block, depth_of(third));
  store_bounds(3u, block, third.bounds);
}

// Depth and pyramid values of a texel of mip run.first.
float source_texel(uvec2 at, out vec2 bounds) {
  at = min(at, uvec2((face.size >> run.first) - 1u));
  ivec2 place = nearest_place(run.first, at);
  bounds = vec2(imageLoad(pyramid, place + below_nearest()).x, imageLoad(pyramid, place).x);
#ifdef GLOAM_SHADOW_BOUNDS_ONLY
  return 0.0;
#endif
  return imageLoad(atlas, mip_corner(run.first, run.atlas_size) + ivec2((face.origin >> run.first) + at)).x;
}

// Makes the three mips after run.first for a block.
void make_next_mips(uvec2 block, float gap) {
  Texels third = kNone;
  uint quarter = 0u;
  do {
    uvec2 at2 = block * 2u + uvec2(quarter & 1u, quarter >> 1);
    Texels second = kNone;
    uint four = 0u;
    do {
      uvec2 at1 = at2 * 2u + uvec2(four & 1u, four >> 1);
      Texels first = kNone;
      for (uint one = 0u; one < 4u; ++one) {
        vec2 bounds;
        float depth = source_texel(at1 * 2u + uvec2(one & 1u, one >> 1), bounds);
        add(first, depth, bounds, gap);
      }
      float depth = depth_of(first);
      store(run.first + 1u, at1, depth, first.bounds);
      add(second, depth, first.bounds, 2.0 * gap);
    } while (++four < 4u);
    float depth = depth_of(second);
    store(run.first + 2u, at2, depth, second.bounds);
    add(third, depth, second.bounds, 4.0 * gap);
  } while (++quarter < 4u);  // tested at the end: see docs/development.md
  store(run.first + 3u, block, depth_of(third), third.bounds);
}

void main() {
  face = groups[run.first_group + gl_WorkGroupID.x];
  uvec2 block = face.begin + gl_LocalInvocationID.xy;
  bool inside = all(lessThan(block, face.end));
  float gap = face.gap * float(1u << (run.first + 1u));
  if (inside && (kRuns == 1u || (kRuns == 0u && run.first == 0u))) make_first_mips(block, gap);
  if (inside && (kRuns == 2u || (kRuns == 0u && run.first != 0u))) make_next_mips(block, gap);
}

#endif

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_MIPS_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_MIPS_GLSL

#include "shaders/shadows/shadows_shared.h"

// Moves a face's depth from the scratch map into the atlas and makes mips 1 to 3 of it, or makes the next three mips of a mip that is
// there, and the pyramid along with them. One thread takes a block of 8 × 8 texels of its source. Before including this, define
// GLOAM_SHADOW_ATLAS_FORMAT, and GLOAM_SHADOW_ATLAS_STEPS when the atlas holds less than the scratch map: what it holds is what counts.

layout(local_size_x = GLOAM_SHADOW_MIP_GROUP, local_size_y = GLOAM_SHADOW_MIP_GROUP) in;
layout(set = 0, binding = 0) uniform sampler2D scratch;
layout(set = 0, binding = 1, GLOAM_SHADOW_ATLAS_FORMAT) uniform image2D atlas;
layout(set = 0, binding = 2, rg32f) uniform image2D pyramid;
layout(push_constant, scalar) uniform Constants { ShadowMipConstants face; };

// What becomes one texel of the next mip.
struct Texels {
  float nearest;
  float sum;    // of distances in units of the near plane, or of depths (orthographic), occupied texels only
  float count;
  float covered;  // texels that the nearest surface covers
  float depths;   // sum of its depths, by what each texel's surface covers
  vec2 bounds;    // of the pyramid
};

const Texels kNone = Texels(0.0, 0.0, 0.0, 0.0, 0.0, vec2(1.0, 0.0));

const uint kFreeBits = 63u;

float without_free_bits(float depth) { return uintBitsToFloat(floatBitsToUint(depth) & ~kFreeBits); }

// Counts a texel's share of the nearest surface. What lies behind it by more than a surface recedes over a texel is another one.
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

// gap: of the mip that the texels become.
void add(inout Texels t, float depth, vec2 bounds, float gap) {
  bool occupied = depth > 0.0;
  if (face.mip_operator == uint(GLOAM_SHADOW_MIPS_COVERAGE)) add_covered(t, depth, gap);
  else t.nearest = max(t.nearest, depth);
  t.sum += occupied ? (face.orthographic != 0u ? depth : 1.0 / depth) : 0.0;
  t.count += occupied ? 1.0 : 0.0;
  t.bounds = vec2(min(t.bounds.x, bounds.x), max(t.bounds.y, bounds.y));
}

float depth_of(Texels t) {
  if (face.mip_operator == uint(GLOAM_SHADOW_MIPS_COVERAGE)) {
    uint free = uint(clamp(floor((1.0 - 0.25 * t.covered) * 64.0 + 0.5), 0.0, float(kFreeBits)));
    // The mean of a plane's depths is its depth in the middle.
    return t.nearest > 0.0 ? uintBitsToFloat(floatBitsToUint(without_free_bits(t.depths / t.covered)) | free) : 0.0;
  }
  if (face.mip_operator == uint(GLOAM_SHADOW_MIPS_NEAREST) || t.count == 0.0) return t.nearest;
  return face.orthographic != 0u ? t.sum / t.count : t.count / t.sum;
}

ivec2 mip_corner(uint mip, uint atlas_size) {
  return mip == 0u ? ivec2(0) : ivec2(atlas_size, atlas_size - (2u * atlas_size >> mip));
}

void store(uint mip, uvec2 at, float depth, vec2 bounds) {
  uint size = face.size >> mip;
  if (mip >= face.mips || at.x >= size || at.y >= size) return;
  imageStore(atlas, mip_corner(mip, face.atlas_size) + ivec2((face.origin >> mip) + at), vec4(depth));
  if (mip < uint(GLOAM_SHADOW_PYRAMID_MIP)) return;
  uint level = mip - uint(GLOAM_SHADOW_PYRAMID_MIP);
  imageStore(pyramid, mip_corner(level, face.atlas_size / 4u) + ivec2((face.origin >> mip) + at), vec4(bounds, 0.0, 0.0));
}

float source_texel(uvec2 at, out vec2 bounds) {
  at = min(at, uvec2((face.size >> face.first) - 1u));
  float depth;
  if (face.first == 0u) {
    depth = texelFetch(scratch, ivec2(face.source + at), 0).x;
#ifdef GLOAM_SHADOW_ATLAS_STEPS
    depth = floor(clamp(depth, 0.0, 1.0) * GLOAM_SHADOW_ATLAS_STEPS + 0.5) / GLOAM_SHADOW_ATLAS_STEPS;
#endif
    if (face.mip_operator == uint(GLOAM_SHADOW_MIPS_COVERAGE)) depth = without_free_bits(depth);
    bounds = vec2(depth);
    store(0u, at, depth, bounds);
  } else {
    depth = imageLoad(atlas, mip_corner(face.first, face.atlas_size) + ivec2(face.source + at)).x;
    ivec2 corner = mip_corner(face.first - uint(GLOAM_SHADOW_PYRAMID_MIP), face.atlas_size / 4u);
    bounds = imageLoad(pyramid, corner + ivec2(face.source + at)).xy;
  }
  return depth;
}

void main() {
  uint side = 8u << face.first;  // of a block, texels of mip 0
  uvec2 block = face.begin / side + gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(block * side, face.end))) return;
  Texels third = kNone;
  float gap = face.gap * float(1u << (face.first + 1u));
  for (uint quarter = 0u; quarter < 4u; ++quarter) {
    uvec2 at2 = block * 2u + uvec2(quarter & 1u, quarter >> 1);
    Texels second = kNone;
    for (uint four = 0u; four < 4u; ++four) {
      uvec2 at1 = at2 * 2u + uvec2(four & 1u, four >> 1);
      Texels first = kNone;
      for (uint one = 0u; one < 4u; ++one) {
        vec2 bounds;
        float depth = source_texel(at1 * 2u + uvec2(one & 1u, one >> 1), bounds);
        add(first, depth, bounds, gap);
      }
      float depth = depth_of(first);
      store(face.first + 1u, at1, depth, first.bounds);
      add(second, depth, first.bounds, 2.0 * gap);
    }
    float depth = depth_of(second);
    store(face.first + 2u, at2, depth, second.bounds);
    add(third, depth, second.bounds, 4.0 * gap);
  }
  store(face.first + 3u, block, depth_of(third), third.bounds);
}

#endif

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_CLEAR_FACES_GLSL
#define GLOAM_SHADERS_SHADOWS_CLEAR_FACES_GLSL

// Whether a cube face holds no blocker for a tile that has no pixel in it, as far as the nearest depths of its pyramid
// tell. A lamp's own post is nearer to it than it is wide, so bounds by search regions would call such a face a
// blocker for every tile around. Included by classify_light.glsl.
//
// All rays from the tile's pixels to the emitter lie in the convex hull of two spheres: one around the light, which
// holds the emitter, and one around the tile. The surfaces of a block of the map lie in a pyramid of directions, and
// no nearer than the block's nearest depth.

// The hull of both spheres, seen from the light. Lengths in metres.
struct RayHull {
  vec3 toward;      // direction to the tile's sphere
  float emitter;    // radius at the light
  float per_metre;  // growth of the radius along `toward`
};

RayHull ray_hull(TileBounds t, LocalFaces l) {
  const float kRounding = 1.02;
  vec3 center = t.center - l.position;
  float along = max(length(center), 1e-20), emitter = 0.5 * kRounding * max(l.first.z, 0.0);
  float grows = (kRounding * t.radius - emitter) / along;
  // The hull is tangent to both spheres: across `toward` it is wider than they are. No bound if one holds the other.
  float stretch = inversesqrt(max(1.0 - grows * grows, 1e-8));
  return RayHull(center / along, emitter * stretch, grows * stretch);
}

// Whether surfaces in these directions, at least `distance_m` away, are outside the hull. middle: the middle direction,
// a unit vector. sine: of the greatest angle to it.
bool outside_hull(RayHull hull, vec3 middle, float sine, float distance_m) {
  float along = dot(middle, hull.toward), across = length(cross(middle, hull.toward));
  float cosine = sqrt(max(1.0 - sine * sine, 0.0));
  // Of the angle between `toward` and the nearest of the directions.
  float least_sine = across * cosine - along * sine, least_cosine = along * cosine + across * sine;
  bool behind = least_cosine <= 0.0;  // there, the hull ends at the emitter's sphere
  float opens = least_sine - hull.per_metre * least_cosine;
  return sine < 1.0 && (behind || (least_sine > 0.0 && opens > 0.0)) &&
         distance_m >= (behind ? hull.emitter : hull.emitter / max(opens, 1e-20));
}

const int kMostClearTurns = 192;

// Whether no surface in the face is in the hull. Descends from the pyramid's coarsest level where a block may hold one.
// False if a block of level 0 may, and after kMostClearTurns blocks.
bool face_is_clear(LocalFaces l, RayHull hull, int face) {
  const float kMargin = 2.0;  // texels of mip 0 that a block is widened by: filters read beside a surface
  float size = l.first.w, near = l.first.y, to_tangent = 2.0 * l.right.w / size;
  int top = floor_log2(size) - GLOAM_SHADOW_PYRAMID_MIP - 1, level = top, done = 0, turn = 0;
  vec2 origin = cube_face_origin(l.light, face);
  mat3 axes = kCube * cube_face_axes(face);
  ivec2 block = ivec2(0);
  bool clear = true, up = false;
  do {
    MipSquare square = mip_square(origin * 0.25, size * 0.25, level, shadow_block.atlas_size * 0.25);
    float depth = texelFetch(shadow_pyramid, ivec2(square.corner) + block, 0).x, side = 4.0 * square.texel;
    vec2 tangent = ((vec2(block) + 0.5) * side - 0.5 * size) * to_tangent;
    vec3 local = vec3(tangent.x, -tangent.y, 1.0);
    float half_diagonal = 1.4143 * (0.5 * side + kMargin) * to_tangent, far = length(local);
    float nearest = max(far - half_diagonal, 1.0);
    bool harmless = up || depth <= 0.0 ||
                    outside_hull(hull, axes * local / far, half_diagonal / nearest, near / max(depth, 1e-20) * nearest);
    clear = harmless || level > 0;
    if (!harmless) {
      --level;
      block *= 2;
      continue;
    }
    // Go to the next of the four blocks that form a block of the coarser level. After the fourth, that one is done.
    ivec2 child = block & 1;
    done += int(level == top);
    up = level < top && child == ivec2(1);
    block = up ? block >> 1 : block + ivec2(child.x == 0 ? 1 : -1, child.x);
    level += int(up);
  } while (++turn < kMostClearTurns && clear && done < 4);
  return clear && done == 4;
}

#endif

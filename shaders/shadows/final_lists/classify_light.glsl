// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_CLASSIFY_LIGHT_GLSL
#define GLOAM_SHADERS_SHADOWS_CLASSIFY_LIGHT_GLSL

// Bounds of a tile in the faces of a light, for classify_tile.glsl, which includes this file.

// Sets the members that depend on the planes of the tile's pixels. sines: least and greatest sine of the angle between
// the light's rays and the pixels' surfaces, negative where they face the light. emitter: greatest and least sine of
// half the angle that the emitter covers.
void set_facing(inout TileInFace f, vec2 sines, vec2 emitter, bool subsurface) {
  const float slack = 1e-5;
  f.faces_light = kBias == 0u || sines.y + slack < kFacingSine - emitter.x;
  f.turned_away = kBias != 0u && !subsurface && sines.x - slack > kFacingSine + emitter.x;
}

// Sets the least and greatest bias. depth_per_m: least and greatest depth per metre.
void set_biases(inout TileInFace f, vec2 depth_per_m, bool subsurface) {
  float relative = f.nearest * shadow_block.relative_quantum;
  float quantum = max(shadow_block.depth_quantum, relative);
  f.least_bias = kBias != 0u ? max(shadow_block.bias_m * depth_per_m.x,
                                   max(shadow_block.depth_quantum, f.farthest * shadow_block.relative_quantum))
                             : shadow_block.depth_quantum;
  f.most_bias = kBias != 0u ? max(shadow_block.bias_m * (subsurface ? 4.0 : 1.0) * depth_per_m.y, quantum)
                            : shadow_block.depth_quantum;
}

// Sets the tile's bounds in the face of a local light. Returns false when pixels of the tile are in several faces or in
// none, and when the light has no face.
bool tile_in_local_face(TileBounds t, uint light, vec3 light_position, out TileInFace f) {
  vec4 first = texelFetch(shadow_rows, ivec2(0, light), 0);  // kind, near, width, size
  vec4 right = texelFetch(shadow_rows, ivec2(1, light), 0);  // right, tan_half
  vec4 up = texelFetch(shadow_rows, ivec2(2, light), 0);     // up, tan_inner
  f.cube = first.x == float(GLOAM_SHADOW_CUBE);
  int face = f.cube ? cube_face_of((t.center - light_position) * kCube) : 0;
  mat3 axes = mat3(right.xyz, up.xyz, spot_forward(light, right.xyz, up.xyz));
  if (f.cube) axes = kCube * cube_face_axes(face);
  float near = first.y, texel = 2.0 * right.w / first.w, width = max(first.z, 0.0);
  vec2 texels[8];
  float least_z = 1e30, most_z = 0.0, most_stretch = 1.0, outermost = -1e30, least_r = 1e30, most_r = 0.0;
  for (int i = 0; i < 8; ++i) {
    vec3 v = t.corners[i] - light_position;
    vec3 local = v * axes;
    float distance = length(v);
    least_z = min(least_z, local.z);
    most_z = max(most_z, local.z);
    outermost = max(outermost, max(abs(local.x), abs(local.y)) - local.z * up.w);
    vec2 tangent = local.xy / max(local.z, 1e-9);
    texels[i] = vec2(tangent.x, -tangent.y) / texel + 0.5 * first.w;
    most_stretch = max(most_stretch, distance / max(local.z, 1e-9));
    most_r = max(most_r, distance);
  }
  least_r = max(length(t.center - light_position) - t.radius, 1e-9);
  f.face = face;
  f.tan_half = right.w;
  f.origin = cube_face_origin(light, face);
  f.size = first.w;
  set_texels(texels, 1.0 / 16.0, f);
  const float slack = 4e-6;
  f.nearest = near / max(least_z, 1e-9) * (1.0 + slack);
  f.farthest = near / max(most_z, 1e-9) * (1.0 - slack);
  f.scale = width / (near * texel) * (f.cube ? sqrt(most_stretch) : 1.0) * (1.0 + slack);
  f.surrounded = outermost < 0.0;
  f.clear = least_r > 1.74 * near;  // 1.74 > √3: the corners of a cube's near planes are farthest away
  // Planes: n · v = h for points v of the tile relative to the light. The plane that is farthest from the light is
  // below the planes of all pixels.
  float shift = dot(t.normal, light_position), error = 1e-6 * (abs(shift) + most_r);
  vec2 heights = t.offsets - shift + vec2(-error, error);
  float tilted = t.spread * most_r;
  vec2 sines = vec2(heights.x - tilted, heights.y + tilted);
  float closest = min(abs(heights.x), abs(heights.y));
  bool one_side = heights.x * heights.y > 0.0 && closest > 2.0 * tilted;
  set_facing(f, vec2(sines.x / (sines.x > 0.0 ? most_r : least_r), sines.y / (sines.y > 0.0 ? least_r : most_r)),
             0.5 * width / vec2(least_r, most_r), t.subsurface);
  set_biases(f, vec2(f.farthest / most_z, f.nearest / max(least_z, 1e-9)), t.subsurface);
  float lowest = abs(heights.x) > abs(heights.y) ? heights.x : heights.y;
  vec3 normal = t.normal * axes;
  vec3 plane = normal * (near / (one_side ? lowest : 1.0));  // depth = dot(plane, (tangent, 1))
  f.plane.yz = vec2(plane.x, -plane.y) * texel;
  f.plane.x = kReceiverPlane == 0u ? f.farthest : plane.z - 0.5 * f.size * (f.plane.y + f.plane.z);
  float per_height = 2.0 * near * texel / max(closest - tilted, 1e-9);
  f.tilt = kReceiverPlane == 0u ? 0.0 : per_height * t.spread * (1.0 + most_r / max(closest, 1e-9));
  f.slope =
      kReceiverPlane == 0u ? 0.0 : 0.5 * per_height * (abs(normal.x) + abs(normal.y) + 2.0 * t.spread) * (1.0 + slack);
  f.plane.yz = kReceiverPlane == 0u ? vec2(0.0) : f.plane.yz;
  f.faces_light = f.faces_light && one_side;
  f.slope = one_side ? f.slope : 1e30;
  return first.x != float(GLOAM_SHADOW_NONE) && least_z > near * 1.0001 && most_z < 1e18 && (!f.cube || f.surrounded);
}

// The texel (xy) and depth (z) of a point in an orthographic face.
vec3 cascade_texel(ShadowCascade c, vec3 point) {
  vec4 p = vec4(point, 1.0);
  return vec3(dot(c.row_u, p), dot(c.row_v, p), dot(c.row_depth, p));
}

// Sets the tile's bounds in a cascade. outside: no pixel is in the cascade.
void tile_in_cascade(TileBounds t, uint light, vec3 direction, ShadowCascade c, out TileInFace f, out bool outside) {
  vec3 low = vec3(1e30), high = vec3(-1e30);
  vec2 texels[8];
  for (int i = 0; i < 8; ++i) {
    vec3 at = cascade_texel(c, t.corners[i]);
    texels[i] = at.xy;
    low = min(low, at);
    high = max(high, at);
  }
  const float slack = 1.0 / 16.0;
  float inner = c.size - c.rim, texel_depth = 1.0 / c.depth_m;
  outside = high.x < c.rim - slack || high.y < c.rim - slack || low.x > inner + slack || low.y > inner + slack;
  f.surrounded = low.x > c.rim + slack && low.y > c.rim + slack && high.x < inner - slack && high.y < inner - slack &&
                 high.z < 0.9999;
  f.cube = false;
  f.origin = c.origin;
  f.size = c.size;
  set_texels(texels, slack, f);
  float rounding = 1e-6 + 4e-7 * max(abs(low.z), abs(high.z));
  f.nearest = high.z + rounding;
  f.farthest = low.z - rounding;
  float penumbra = max(fetch_sun(light).y, 0.0);
  f.scale = penumbra * c.depth_m / c.texel_m * 1.00001;
  float along = dot(t.normal, direction);
  set_facing(f, vec2(along - t.spread, along + t.spread), vec2(0.5 * penumbra), t.subsurface);
  set_biases(f, vec2(texel_depth), t.subsurface);
  bool one_side = abs(along) > 2.0 * t.spread + 1e-5;
  along = one_side ? along : 1.0;
  float scale = c.texel_m * c.texel_m * texel_depth / along;
  // A point on the pixels' plane that is farthest from the light; all these planes have the tile's normal.
  vec3 lowest = t.center + t.normal * ((along < 0.0 ? t.offsets.x : t.offsets.y) - dot(t.normal, t.center));
  vec3 at = cascade_texel(c, lowest);
  vec2 slope = kReceiverPlane == 0u ? vec2(0.0) : vec2(dot(t.normal, c.row_u.xyz), dot(t.normal, c.row_v.xyz)) * scale;
  f.plane = vec3(kReceiverPlane == 0u ? f.farthest : at.z - rounding - dot(slope, at.xy), slope);
  float clear = max(abs(along) - t.spread, 1e-5);
  f.tilt =
      kReceiverPlane == 0u ? 0.0 : 2.0 * c.texel_m * texel_depth * t.spread * (abs(along) + 1.0) / (abs(along) * clear);
  f.slope = kReceiverPlane == 0u
                ? 0.0
                : (abs(slope.x) + abs(slope.y)) * abs(along) / clear + 2.0 * c.texel_m * texel_depth * t.spread / clear;
  f.faces_light = f.faces_light && one_side;
  f.slope = one_side ? f.slope : 1e30;
}

// Each pixel uses the first cascade that it is in. So a verdict holds for the tile when all cascades that may be the
// first one of a pixel agree on it.
uint classify_directional(TileBounds t, uint light, vec3 direction, int most_turns) {
  uint count = min(uint(fetch_sun(light).x), uint(GLOAM_MAX_CASCADES));
  if (count == 0u) return kCastsNone;
  uint verdict = kUnknown, i = 0u;
  bool first = true, done = false;
  do {
    TileInFace f;
    bool outside;
    tile_in_cascade(t, light, direction, fetch_cascade(cascade_row(light, i)), f, outside);
    bool surrounded = f.surrounded;
    // Pixels outside this cascade do not count for its verdict.
    f.surrounded = f.nearest < 0.9999;
    bool in_face;
    uint here = classify_in_face(f, most_turns, in_face);
    verdict = outside ? verdict : first || here == verdict ? here : kUnknown;
    first = first && outside;
    done = surrounded || (!outside && here == kUnknown);
  } while (!done && ++i < count);
  // Pixels in no cascade are lit.
  return done ? verdict : verdict == kLit || first ? kLit : kUnknown;
}

// Whether a pixel's search region may leave the tile's cube face while another face may hold a blocker for it.
bool other_faces_matter(TileInFace f, uint light) {
  int last = floor_log2(f.size) - GLOAM_SHADOW_PYRAMID_MIP;
  float to_tangent = 2.0 * f.tan_half / f.size;
  float nearest = 0.0;
  bool matter = false;
  for (int i = 0; i < 6; ++i) {
    MipSquare square =
        mip_square(cube_face_origin(light, i) * 0.25, f.size * 0.25, last, shadow_block.atlas_size * 0.25);
    float held = texelFetch(shadow_pyramid, ivec2(square.corner), 0).x;
    float off = min(texels_to_face(f.face, i, f.low, f.size, to_tangent),
                    texels_to_face(f.face, i, f.high, f.size, to_tangent));
    bool other = i != f.face && may_block_from_other_face(held * 1.00001, f.farthest, off - 0.1, f.scale, to_tangent);
    matter = matter || other;
    nearest = max(nearest, i == f.face ? held : other ? 2.0 * held : 0.0);
  }
  return matter && leaves_face(f, 0.5 * widest(f, nearest) + 1.0);
}

// in_face: all taps of the tile's pixels are in one face.
uint classify_local(TileBounds t, uint light, vec3 light_position, int most_turns, out bool in_face) {
  TileInFace f;
  float kind = texelFetch(shadow_rows, ivec2(0, light), 0).x;
  bool inside = tile_in_local_face(t, light, light_position, f);
  bool alone = inside && (!f.cube || !other_faces_matter(f, light));
  in_face = kind == float(GLOAM_SHADOW_SPOT);
  if (kind == float(GLOAM_SHADOW_NONE)) return kCastsNone;
  // Surfaces that face away are unlit in any face, provided that each pixel is in some face: the tile is inside one
  // face, or every pixel is beyond the cube's near planes.
  if (!alone) return f.turned_away && (inside || (f.cube && f.clear)) ? kUnlit : kUnknown;
  return classify_in_face(f, most_turns, in_face);
}

#endif

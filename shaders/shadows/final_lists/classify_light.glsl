// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_CLASSIFY_LIGHT_GLSL
#define GLOAM_SHADERS_SHADOWS_CLASSIFY_LIGHT_GLSL

// Bounds of a tile in the faces of a light, for classify_tile.glsl, which includes this file.

// Whether pixels of the tile may take light from behind. What they get is a transmittance, which no verdict knows.
bool may_transmit(TileBounds t) { return kTransmission != 0u && t.transmits; }

// Sets the members that depend on the planes of the tile's pixels. sines: least and greatest sine of the angle between
// the light's rays and the pixels' surfaces, negative where they face the light. emitter: greatest and least sine of
// half the angle that the emitter covers.
void set_facing(inout TileInFace f, vec2 sines, vec2 emitter, bool subsurface) {
  const float slack = 1e-5;
  f.faces_light = kBias == 0u || sines.y + slack < kFacingSine - emitter.x;
  f.turned_away = kBias != 0u && !subsurface && sines.x - slack > kFacingSine + emitter.x;
}

// Sets the least and greatest bias. bias_depth: least and greatest depth per metre of bias.
void set_biases(inout TileInFace f, vec2 bias_depth, bool subsurface) {
  float relative = f.nearest * shadow_block.relative_quantum;
  float quantum = max(shadow_block.depth_quantum, relative);
  f.least_bias = kBias != 0u ? max(shadow_block.bias_m * bias_depth.x,
                                   max(shadow_block.depth_quantum, f.farthest * shadow_block.relative_quantum))
                             : shadow_block.depth_quantum;
  f.most_bias = kBias != 0u
                    ? max(shadow_block.bias_m * (subsurface ? float(kSubsurfaceBias) : 1.0) * bias_depth.y, quantum)
                    : shadow_block.depth_quantum;
}

#ifdef GLOAM_CLASSIFY_SUNS
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
  f.near_width = 1e30;
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
  set_biases(f, vec2(cascade_bias_depth(c.texel_m, c.depth_m)), t.subsurface);
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
  float along = dot(t.normal, direction);
  if (may_transmit(t) && along > -t.shading_spread - 1e-5) return kUnknown;
  if (along > t.shading_spread + 1e-5) return kNotAsked;
  uint verdict = kUnknown, i = 0u;
  bool first = true, done = false;
  do {
    TileInFace f;
    bool outside;
    tile_in_cascade(t, light, direction, fetch_cascade(cascade_row(light, i)), f, outside);
    bool surrounded = f.surrounded;
    // Pixels outside this cascade do not count for its verdict.
    f.surrounded = f.nearest < 0.9999;
    bool clear;
    float width = widest_region(f, clear);
    uint here = classify_in_face(f, most_turns, width, 1.0, f.surrounded, clear);
    verdict = outside ? verdict : first || here == verdict ? here : kUnknown;
    first = first && outside;
    done = surrounded || (!outside && here == kUnknown);
  } while (!done && ++i < count);
  // Pixels in no cascade are lit.
  return done ? verdict : verdict == kLit || first ? kLit : kUnknown;
}
#else
// Whether a local light is behind the shading normal of each pixel.
bool is_dark(TileBounds t, vec3 light_position) {
  float height = dot(t.normal, light_position), farthest = distance(t.center, light_position) + t.radius;
  return height - t.offsets.x + t.shading_spread * farthest < -1e-5 * (abs(height) + farthest);
}

// Whether a local light is in front of the shading normal of each pixel.
bool is_faced(TileBounds t, vec3 light_position) {
  float height = dot(t.normal, light_position), farthest = distance(t.center, light_position) + t.radius;
  return height - t.offsets.y - t.shading_spread * farthest > 1e-5 * (abs(height) + farthest);
}

// A local light's data for classification.
struct LocalFaces {
  uint light;
  vec3 position;
  vec4 first;  // kind, near_m, emitter_diameter_m, size
  vec4 right;  // right, tan_half
  vec4 up;     // up, tan_inner
  bool cube;
};

LocalFaces fetch_local_faces(uint light, vec3 light_position) {
  vec4 first = texelFetch(shadow_rows, ivec2(0, light), 0);
  return LocalFaces(light, light_position, first, texelFetch(shadow_rows, ivec2(1, light), 0),
                    texelFetch(shadow_rows, ivec2(2, light), 0), first.x == float(GLOAM_SHADOW_CUBE));
}

// Sets the tile's bounds in a face of a local light. In the six faces of a cube, a plane, a distance and a cone differ
// a little; margins: the bounds hold for pixels whose own face is another one, too. Returns false when the face cannot
// hold the bounds: pixels are beside it, too near to the light, or it does not exist.
bool tile_in_local_face(TileBounds t, LocalFaces l, int face, bool margins, out TileInFace f) {
  vec3 light_position = l.position;
  vec4 first = l.first, right = l.right, up = l.up;
  f.cube = l.cube;
  f.near_width = kFilter == 3u && kNear != 0u ? kNearTangent * first.w / right.w : 1e30;
  mat3 axes = mat3(right.xyz, up.xyz, spot_forward(l.light, right.xyz, up.xyz));
  if (f.cube) axes = kCube * cube_face_axes(face);
  float near = first.y, texel = 2.0 * right.w / first.w, diameter = max(first.z, 0.0);
  vec2 texels[8];
  float least_z = 1e30, most_z = 0.0, most_stretch = 1.0, outermost = -1e30, least_r = 1e30, most_r = 0.0;
  for (int i = 0; i < 8; ++i) {
    vec3 v = t.corners[i] - light_position;
    vec3 local = v * axes;
    float distance = length(v);
    least_z = min(least_z, local.z);
    most_z = max(most_z, local.z);
    outermost = max(outermost, max(abs(local.x), abs(local.y)) - local.z * up.w);
    vec2 tangent = local.xy / max(local.z, near);
    texels[i] = vec2(tangent.x, -tangent.y) / texel + 0.5 * first.w;
    most_stretch = max(most_stretch, distance / max(local.z, near));
    most_r = max(most_r, distance);
  }
  least_r = max(length(t.center - light_position) - t.radius, near);
  f.origin = cube_face_origin(l.light, face);
  f.size = first.w;
  set_texels(texels, 1.0 / 16.0, f);
  const float slack = 4e-6;
  f.nearest = near / max(least_z, near) * (1.0 + slack);
  f.farthest = near / max(most_z, near) * (1.0 - slack);
  f.scale = diameter / (near * texel) * (f.cube ? sqrt(most_stretch) : 1.0) * (1.0 + slack);
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
             0.5 * diameter / vec2(least_r, most_r), t.subsurface);
  set_biases(f, vec2(local_bias_depth(f.farthest), local_bias_depth(f.nearest)), t.subsurface);
  float lowest = abs(heights.x) > abs(heights.y) ? heights.x : heights.y;
  vec3 normal = t.normal * axes;
  vec3 plane = normal * (near / (one_side ? lowest : 1.0));  // depth = dot(plane, (tangent, 1))
  f.plane.yz = vec2(plane.x, -plane.y) * texel;
  f.plane.x = kReceiverPlane == 0u ? f.farthest : plane.z - 0.5 * f.size * (f.plane.y + f.plane.z);
  float per_height = 2.0 * near * texel / max(closest - tilted, near);
  f.tilt = kReceiverPlane == 0u ? 0.0 : per_height * t.spread * (1.0 + most_r / max(closest, near));
  f.slope =
      kReceiverPlane == 0u ? 0.0 : 0.5 * per_height * (abs(normal.x) + abs(normal.y) + 2.0 * t.spread) * (1.0 + slack);
  f.plane.yz = kReceiverPlane == 0u ? vec2(0.0) : f.plane.yz;
  f.faces_light = f.faces_light && one_side;
  f.slope = one_side ? f.slope : 1e30;
  if (margins) {
    const float more = 1.5, less = 0.6;
    f.scale *= more;
    f.slope *= more;
    f.tilt *= more;
    f.most_bias *= more;
    f.least_bias *= less;
  }
  const float most_tangent = 4.0;  // beside a face, bounds in it become arbitrarily loose
  return first.x != float(GLOAM_SHADOW_NONE) && least_z > near * 1.0001 && most_z < 1e18 &&
         most_r < most_tangent * least_z;
}

// Texels between the tile and the border of its cube face with another face; negative: pixels are beyond it.
float texels_to_face(TileInFace f, int own, int face, float to_tangent) {
  return min(texels_to_face(own, face, f.low, f.size, to_tangent),
             texels_to_face(own, face, f.high, f.size, to_tangent));
}

// Nearest depth in the half of a neighbouring face that is in front of the plane through the light that is parallel to
// face `own`.
float nearest_of_front_half(LocalFaces l, int own, int face) {
  float size = l.first.w;
  MipSquare square = mip_square(cube_face_origin(l.light, face) * 0.25, size * 0.25,
                                floor_log2(size) - GLOAM_SHADOW_PYRAMID_MIP - 1, shadow_block.atlas_size * 0.25);
  vec4 depths = textureGather(shadow_pyramid, (square.corner + 1.0) * shadow_texel_size() * vec2(4.0, 2.0));
  vec3 ahead = cube_face_axes(own)[2] * cube_face_axes(face);  // right, up
  vec4 right = vec4(-1.0, 1.0, 1.0, -1.0), up = vec4(-1.0, -1.0, 1.0, 1.0);
  return nearest_of(mix(vec4(0.0), depths, greaterThan(right * ahead.x + up * ahead.y, vec4(0.0))));
}

// Faces of a cube, as bits, that decide about the tile: they hold pixels, or blockers for pixels. f: the tile in face
// `own`. A surface of a neighbouring face at the tangent t ≥ 1 has t times its depth in face `own`, and blocks only if
// that is in the cone of a pixel. Both are linear in t, and no kernel reaches beyond t = 2. The opposite face is out of
// reach. width: of the search regions, as far as face `own` decides it.
uint deciding_faces(TileInFace f, LocalFaces l, int own, float width) {
  float coarse;
  kernels_reach(width, coarse);
  float slack = max(2.0 + coarse, 4.0);
  float to_tangent = 2.0 * l.right.w / f.size, a_texel = 2.0 / max(f.scale * (f.surrounded ? 1.0 : 1.5), 1e-6);
  uint faces = 1u << own;
  for (int i = 0; i < 6; ++i) {
    if (i >> 1 == own >> 1) continue;
    float off = texels_to_face(f, own, i, to_tangent);
    float face_nearest = nearest_of_front_half(l, own, i) * 1.00001;
    float at_border = f.farthest + a_texel * max(off - slack, 0.0);
    bool blocks = (face_nearest > at_border || 2.0 * face_nearest > at_border + a_texel / to_tangent) &&
                  leaves_face(f, 0.5 * widest(f, 2.0 * face_nearest) + 1.0);
    faces |= off < 0.1 || blocks ? 1u << i : 0u;
  }
  return faces;
}

// Whether kernels that reach this far beyond the tile read a face other than these.
bool reads_other_faces(TileInFace f, LocalFaces l, int own, uint faces, float reach) {
  float to_tangent = 2.0 * l.right.w / f.size;
  bool others = false;
  for (int i = 0; i < 6; ++i)
    others = others || ((faces >> i & 1u) == 0u && texels_to_face(f, own, i, to_tangent) < reach);
  return others && leaves_face(f, reach);
}

// Classifies the tile in each face that decides about it: first the width of the pixels' search regions, then the
// verdict. in_face: see classify_local().
uint classify_cube(TileBounds t, LocalFaces l, int most_turns, out bool in_face) {
  const int most_faces = 3;
  const float most_stretch = 1.6;  // of texels beside a face that kernels leave by an eighth of its side
  int own = cube_face_of((t.center - l.position) * kCube);
  TileInFace of_own, f;
  in_face = false;
  bool fits = tile_in_local_face(t, l, own, false, of_own);
  // Surfaces that face away are unlit in any face, provided that every pixel is beyond the cube's near planes.
  if (of_own.turned_away && (fits || of_own.clear)) return kUnlit;
  if (!fits) return kUnknown;
  bool clear;
  float width = widest_region(of_own, clear), coarse;
  uint faces = deciding_faces(of_own, l, own, width);
  bool several = bitCount(faces) > 1;
  if (bitCount(faces) > most_faces) return kUnknown;
  float stretch = several ? most_stretch : 1.0;
  uint left = several ? faces : 0u;
  if (several) do {
      fits = tile_in_local_face(t, l, findLSB(left), true, f) && fits;
      bool clear_here;
      width = max(width, widest_region(f, clear_here));
      clear = clear && clear_here;
      left &= left - 1u;
    } while (left != 0u);
  float reach = kernels_reach(width, coarse);
  // A texel of the filter's coarser mip is up to half as wide as the penumbra, and the kernel is eight texels wide: it
  // reaches up to two penumbra widths from the receiver.
  in_face = !several && !leaves_face(of_own, max(reach, 2.0 * width + 2.0)) && width <= of_own.near_width;
  if (!fits || (several && reach > 0.125 * of_own.size)) return kUnknown;
  bool whole = !reads_other_faces(of_own, l, own, faces, reach * stretch + 1.0);
  uint verdict = kNotAsked;
  left = faces;
  do {
    tile_in_local_face(t, l, findLSB(left), several, f);
    uint here = touches_face(f, reach * stretch + 1.0) ? classify_in_face(f, most_turns, width, stretch, whole, clear)
                                                       : kNotAsked;
    verdict = agreed(verdict, here);
    left &= left - 1u;
  } while (left != 0u && verdict != kUnknown);
  return verdict == kNotAsked ? kUnknown : verdict;
}

// in_face: all taps of the tile's pixels are in one face, and none of them may be judged by near_visibility().
uint classify_local(TileBounds t, uint light, vec3 light_position, int most_turns, out bool in_face) {
  LocalFaces l = fetch_local_faces(light, light_position);
  in_face = false;
  if (l.first.x == float(GLOAM_SHADOW_NONE)) return kCastsNone;
  bool transmits = may_transmit(t) && !is_faced(t, light_position);
  if (!transmits && is_dark(t, light_position)) return kNotAsked;
  uint verdict = kUnknown;
  if (l.cube)
    verdict = classify_cube(t, l, most_turns, in_face);
  else {
    TileInFace f;
    if (tile_in_local_face(t, l, 0, false, f)) {
      bool clear;
      float width = widest_region(f, clear);
      in_face = width <= f.near_width;
      verdict = classify_in_face(f, most_turns, width, 1.0, f.surrounded, clear);
    }
  }
  return transmits ? kUnknown : verdict;
}
#endif

#endif

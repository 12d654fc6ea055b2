// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_SPACE_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_SPACE_GLSL

// The receiver in the space of one face (ShadowPoint), for local and directional lights. Included by shadows_api.glsl.

// The faces of a local light, grouped by the axis of the cube that they look along (along) or against (against).
// along_x … against_y: corners in the atlas, texels of mip 0; component i is the face of axis i. along_nearest,
// against_nearest: nearest depth of the whole face. A spot's only face is stored as the cube's first.
struct LightFaces {
  vec3 along_x, along_y;
  vec3 against_x, against_y;
#ifdef GLOAM_SHADOWS_CROSSING
  vec3 along_nearest, against_nearest;
#endif
};

// Faces of the light that was evaluated last. A global variable: as a member of ShadowPoint, it makes compiling
// pipelines take 1.5 times as long.
LightFaces light_faces;

vec2 origin_of_face(int face) {
  bool along = (face & 1) == 0;
  vec3 x = along ? light_faces.along_x : light_faces.against_x, y = along ? light_faces.along_y : light_faces.against_y;
  return face < 2 ? vec2(x.x, y.x) : face < 4 ? vec2(x.y, y.y) : vec2(x.z, y.z);
}

// A receiver in the space of one face. Depth on the receiver plane is an affine function of texel coordinates, in
// perspective faces too, because 1 / z is.
struct ShadowPoint {
  vec2 origin;      // corner of the face in the atlas, texels of mip 0
  float size;       // side of the face, texels
  vec2 at;          // the receiver, texels of mip 0 from the face's corner
  float depth;      // depth of the receiver, without bias
  float threshold;  // depth of the receiver with bias: nearer surfaces block; > 0
  vec2 slope;       // depth per texel of mip 0 on the receiver plane
  float least;      // no tap's threshold is below this; > 0
  float scale;      // width of the penumbra in texels of mip 0 = scale · (depth of the blocker − depth)
  bool orthographic;
  bool live;       // false: no map is read; the visibility is 1 before `horizon`
  int face;        // cube face; −1: no cube
  float tan_half;  // tangent of half the face's field of view, for cubes
  float horizon;   // share of the emitter above the receiver plane; the part below gives no light
  float metres;    // metres_between(); set only with kTransmission
  bool thin;       // ShadowReceiver::thin
};

// A face's square at one mip, in texels of the atlas image.
struct MipSquare {
  vec2 corner;
  float size;
  float texel;  // texels of mip 0 per texel of this mip
};

// Exact, unlike exp2 and log2 on some devices. x: > 0 and finite.
float power_of_two(int exponent) { return intBitsToFloat((exponent + 127) << 23); }
int floor_log2(float x) { return (floatBitsToInt(x) >> 23) - 127; }
int ceil_log2(float x) { return ((floatBitsToInt(x) + 0x7FFFFF) >> 23) - 127; }

MipSquare mip_square(vec2 origin, float size, int mip, float atlas_size) {
  float scale = power_of_two(-mip);
  vec2 corner = mip == 0 ? vec2(0.0) : vec2(atlas_size, atlas_size - 2.0 * atlas_size * scale);
  return MipSquare(corner + origin * scale, size * scale, power_of_two(mip));
}

// Normals in the G-buffer have 16 bits per component. If the sine of the angle between light ray and surface is smaller
// than this, the normal is too coarse to tell on which side of the surface the light is, and the surface counts as
// facing the light.
const float kFacingSine = 2e-4;
// Where the receiver plane recedes from the light, taps follow it over at most this many texels. Surfaces farther from
// the light than the receiver cannot block the light, except for errors of a texel's width.
const float kRecedingTexels = 2.0;
// Rounding error of texel coordinates, in texels.
const float kTexelRounding = 1.0 / 64.0;

// Always false, but compilers cannot know that. It guards code as `if (condition) do … while (never(p));`. Software
// devices execute the body of a plain `if` for all threads, whether the condition holds or not. They execute the body
// of `for (bool go = condition; go; go = false)` once more than needed, and the body of this form exactly once. None of
// the three forms skips the body if no thread needs it. A thread that has left a loop with its condition at the end
// still executes the iterations that other threads need, and then some of its variables keep their old values while
// others change. So the body of this loop must give the same result when it runs again.
bool never(ShadowPoint p) { return p.size < 0.0; }

float slope_per_texel(ShadowPoint p) { return abs(p.slope.x) + abs(p.slope.y); }

// Share of a disc on one side of a line at distance u from its centre, in radii; within 0.01 of 0.5 + (asin u + u √(1 −
// u²)) / π.
float disc_share(float u) {
  u = clamp(u, -1.0, 1.0);
  return 0.5 + u * (0.6366 - 0.1366 * u * u);
}

// Texel coordinates, depths, slopes and thresholds are precise: comparisons with texels must come out alike in every
// shader, so that deferred shadows equal monolithic ones on every device.

// Oriented bias covers the rounding of positions and maps. In metres it holds 5 m from a local light, and in a cascade
// with texels of 1 cm; elsewhere it grows with that distance, and with the texel.
float local_bias_depth(float depth) { return 0.2 * depth; }
float cascade_bias_depth(float texel_m, float depth_m) { return 100.0 * texel_m / depth_m; }

// Sets threshold, least and horizon, from depth, slope and live, which must be set. Clears slope if there is no usable
// receiver plane, and live if the whole emitter is below the plane. facing_sine: sine of the angle between the light's
// rays and the surface, negative when the surface faces the light. emitter_sine: sine of half the angle that the
// emitter covers. bias_depth: depth per metre of bias, see local_bias_depth() and cascade_bias_depth().
void set_threshold(inout ShadowPoint p, float facing_sine, float emitter_sine, float bias_depth, bool subsurface) {
  float quantum = max(shadow_block.depth_quantum, abs(p.depth) * shadow_block.relative_quantum);
  // Hardware bias is already in the map, but the threshold needs at least a step of the map's format.
  float bias = kBias != 0u
                   ? max(shadow_block.bias_m * (subsurface ? float(kSubsurfaceBias) : 1.0) * bias_depth, quantum)
                   : shadow_block.depth_quantum;
  // Where the receiver plane cuts the emitter, the part above the plane decides.
  bool toward = subsurface || kBias == 0u || facing_sine < max(emitter_sine, kFacingSine);
  p.horizon =
      kBias != 0u && p.live && !subsurface ? disc_share((kFacingSine - facing_sine) / max(emitter_sine, 1e-6)) : 1.0;
  p.live = p.live && p.horizon > 0.0;
  if (kReceiverPlane == 0u || !(slope_per_texel(p) < 1e15)) p.slope = vec2(0.0);
  float rounding = slope_per_texel(p) * kTexelRounding;
  p.least = p.orthographic ? 1e-12 : p.depth * 0.25;
  precise float threshold = p.depth + (toward ? bias + rounding : -bias);
  p.threshold = max(threshold, p.least);
}

ShadowPoint no_shadow_point() {
  return ShadowPoint(vec2(0.0), 16.0, vec2(8.0), 1.0, 1.0, vec2(0.0), 1.0, 0.0, false, false, -1, 1.0, 1.0, 1.0, false);
}

// Axes of a cube in the world, as columns.
const mat3 kCube = mat3(GLOAM_CUBE_X, GLOAM_CUBE_Y, GLOAM_CUBE_Z);

// Axes of a face in the cube's axes, as columns: x, y, forward.
mat3 cube_face_axes(int face) {
  float sign = (face & 1) == 0 ? 1.0 : -1.0;
  int axis = face >> 1;
  vec3 forward = sign * vec3(float(axis == 0), float(axis == 1), float(axis == 2));
  vec3 up = axis == 1 ? vec3(0.0, 0.0, -sign) : vec3(0.0, 1.0, 0.0);
  return mat3(cross(forward, up), up, forward);
}

// The face that a direction falls on. v: in the cube's axes.
int cube_face_of(vec3 v) {
  vec3 a = abs(v);
  if (a.x >= a.y && a.x >= a.z) return v.x >= 0.0 ? 0 : 1;
  if (a.y >= a.z) return v.y >= 0.0 ? 2 : 3;
  return v.z >= 0.0 ? 4 : 5;
}

vec2 cube_face_origin(uint light, int face) {
  vec4 two = texelFetch(shadow_rows, ivec2(3 + (face >> 1), light), 0);
  return (face & 1) == 0 ? two.xy : two.zw;
}

// The values that all receivers of a local light share.
struct LocalShadow {
  vec3 position;  // camera-relative
  vec4 first;     // kind, near_m, emitter_diameter_m, size
  vec4 right;     // right, tan_half
  vec4 up;        // up, tan_inner
  vec3 forward;
  LightFaces faces;
};

// Nearest depth in a whole face, from the coarsest level of its pyramid.
float nearest_of_face(vec2 origin, float size) {
  MipSquare square = mip_square(origin * 0.25, size * 0.25, floor_log2(size) - GLOAM_SHADOW_PYRAMID_MIP,
                                shadow_block.atlas_size * 0.25);
  return texelFetch(shadow_pyramid, ivec2(square.corner), 0).x;
}

// For a spot, the components of the other five faces stay undefined and are never read.
LightFaces fetch_faces(uint light, float size, bool cube) {
  LightFaces faces;
  int axis = 0;
  do {
    vec4 corners = texelFetch(shadow_rows, ivec2(3 + axis, light), 0);
    bvec3 own = equal(ivec3(axis), ivec3(0, 1, 2));
    faces.along_x = mix(faces.along_x, corners.xxx, own);
    faces.along_y = mix(faces.along_y, corners.yyy, own);
    faces.against_x = mix(faces.against_x, corners.zzz, own);
    faces.against_y = mix(faces.against_y, corners.www, own);
#ifdef GLOAM_SHADOWS_CROSSING
    faces.along_nearest = mix(faces.along_nearest, vec3(nearest_of_face(corners.xy, size)), own);
    faces.against_nearest = mix(faces.against_nearest, vec3(nearest_of_face(corners.zw, size)), own);
#endif
  } while (cube && ++axis < 3);
  return faces;
}

bool is_cube(float kind) {
  return kKinds == GLOAM_SHADOWS_CUBES || (kind == float(GLOAM_SHADOW_CUBE) && (kKinds & GLOAM_SHADOWS_CUBES) != 0u);
}

LocalShadow fetch_local_shadow(uint light, vec3 light_position) {
  vec4 right = texelFetch(shadow_rows, ivec2(1, light), 0), up = texelFetch(shadow_rows, ivec2(2, light), 0);
  vec4 first = texelFetch(shadow_rows, ivec2(0, light), 0);
  return LocalShadow(light_position, first, right, up, spot_forward(light, right.xyz, up.xyz),
                     fetch_faces(light, first.w, is_cube(first.x)));
}

ShadowPoint local_shadow_point(LocalShadow l, ShadowReceiver r) {
  ShadowPoint p = no_shadow_point();
  vec4 first = l.first, right = l.right, up = l.up;
  precise vec3 v = r.position - l.position;
  bool cube = is_cube(first.x);
  vec3 normal = r.face_normal;
  if (cube) {
    v = v * kCube;
    normal = normal * kCube;
  }
  p.face = cube ? cube_face_of(v) : -1;
  light_faces = l.faces;
  mat3 axes = mat3(right.xyz, up.xyz, l.forward);
  if (cube) axes = cube_face_axes(p.face);
  precise vec3 local = v * axes;
  float near = first.y, z = local.z;
  p.live = first.x != float(GLOAM_SHADOW_NONE) && z > near && z < 1e18 &&
           max(abs(local.x), abs(local.y)) <= z * up.w * 1.0001;
  z = p.live ? z : 1.0;
  local = p.live ? local : vec3(0.0, 0.0, 1.0);
  vec2 tangent = local.xy / z;
  float texel = 2.0 * right.w / first.w;  // tangent per texel
  p.origin = origin_of_face(max(p.face, 0));
  p.thin = r.thin;
  p.size = first.w;
  p.tan_half = right.w;
  precise vec2 at = vec2(tangent.x, -tangent.y) / texel + 0.5 * first.w;
  precise float depth = near / z;
  p.at = at;
  p.depth = depth;
  p.scale = max(first.z, 0.0) / (near * texel);
  normal = normal * axes;
  float facing = dot(normal, local);
  float distance = length(local);
  if (kTransmission != 0u) p.metres = near * distance / z;
  float least = least_sine(r);
  float along = abs(facing) < least * distance ? (facing < 0.0 ? -least : least) * distance : facing;
  precise vec2 slope = vec2(normal.x, -normal.y) * (near * texel / along);
  p.slope = slope;
  // A spot's emitter is a disc parallel to its map. A cube's emitter is a sphere: off the axis, the map stretches its
  // outline along the radius, and a round kernel can only have the same area.
  if (cube) p.scale *= sqrt(distance / z);
  set_threshold(p, facing / distance, 0.5 * max(first.z, 0.0) / distance, local_bias_depth(p.depth), r.subsurface);
  return p;
}

ShadowPoint local_shadow_point(uint light, vec3 light_position, ShadowReceiver r) {
  return local_shadow_point(fetch_local_shadow(light, light_position), r);
}

int cascade_row(uint light, uint cascade) {
  return int(shadow_block.cascade_row +
             min(light, uint(GLOAM_MAX_DIRECTIONAL_SHADOWS) - 1u) * uint(GLOAM_MAX_CASCADES) + cascade);
}

ShadowCascade fetch_cascade(int row) {
  vec4 d = texelFetch(shadow_rows, ivec2(3, row), 0), e = texelFetch(shadow_rows, ivec2(4, row), 0);
  return ShadowCascade(texelFetch(shadow_rows, ivec2(0, row), 0), texelFetch(shadow_rows, ivec2(1, row), 0),
                       texelFetch(shadow_rows, ivec2(2, row), 0), d.xy, d.z, d.w, e.x, e.y, vec2(0.0));
}

// x … w: CascadeRow's cascade_count, penumbra_m_per_m, traced_layer, brightest.
vec4 fetch_sun(uint light) { return texelFetch(shadow_rows, ivec2(5, cascade_row(light, 0u)), 0); }

// A receiver of a directional light, while its cascade is searched.
struct SunReceiver {
  ShadowPoint point;
  vec4 position;
  vec3 face_normal;
  float facing;      // cosine between the face normal and the light's direction
  float least_sine;  // result of least_sine()
  float penumbra;    // CascadeRow::penumbra_m_per_m
  float bias_depth;  // cascade_bias_depth() of the cascade that it lies in
};

SunReceiver sun_receiver(vec3 light_direction, float penumbra_m_per_m, ShadowReceiver r) {
  SunReceiver s = SunReceiver(no_shadow_point(), vec4(r.position, 1.0), r.face_normal,
                              dot(r.face_normal, light_direction), least_sine(r), max(penumbra_m_per_m, 0.0), 0.0);
  s.point.orthographic = true;
  s.point.thin = r.thin;
  return s;
}

// Assigns the cascade to the receiver if the receiver lies in it. wanted: the light has this cascade, and the receiver
// has none yet.
void try_cascade(inout SunReceiver s, ShadowCascade c, bool wanted) {
  precise vec3 at = vec3(dot(c.row_u, s.position), dot(c.row_v, s.position), dot(c.row_depth, s.position));
  float inside = min(min(at.x, at.y), c.size - max(at.x, at.y)) - c.rim;
  float along = abs(s.facing) < s.least_sine ? (s.facing < 0.0 ? -s.least_sine : s.least_sine) : s.facing;
  bool taken = wanted && inside >= 0.0 && at.z < 1.0 && at.z > -1e18;
  if (taken) {
    s.point.live = true;
    s.point.origin = c.origin;
    s.point.size = c.size;
    s.point.at = at.xy;
    s.point.depth = at.z;
    s.bias_depth = cascade_bias_depth(c.texel_m, c.depth_m);
    s.point.scale = s.penumbra * c.depth_m / c.texel_m;
    if (kTransmission != 0u) s.point.metres = c.depth_m;
    precise vec2 slope = vec2(dot(s.face_normal, c.row_u.xyz), dot(s.face_normal, c.row_v.xyz)) *
                         (c.texel_m * c.texel_m / c.depth_m / along);
    s.point.slope = slope;
  }
}

ShadowPoint sun_shadow_point(SunReceiver s, bool subsurface) {
  set_threshold(s.point, s.facing, 0.5 * s.penumbra, s.bias_depth, subsurface);
  return s.point;
}

ShadowPoint directional_shadow_point(uint light, vec3 light_direction, ShadowReceiver r) {
  vec4 sun = fetch_sun(light);
  uint count = min(uint(sun.x), uint(GLOAM_MAX_CASCADES)), i = 0u;
  SunReceiver s = sun_receiver(light_direction, sun.y, r);
  // Ends when every thread has its cascade: loading cascades is expensive. A thread without a cascade starts the body,
  // so the body does not ask for s.point.live: lavapipe 22.3 runs it again for threads that have left the loop, and
  // part of their variables then hold the values of their last turn's end.
  do {
    try_cascade(s, fetch_cascade(cascade_row(light, i)), i < count);
  } while (!s.point.live && ++i < count);
  return sun_shadow_point(s, r.subsurface);
}

// The values that all receivers of a directional light share.
struct SunShadow {
  vec4 sun;        // result of fetch_sun()
  vec3 direction;  // the way the light shines
  ShadowCascade cascades[GLOAM_MAX_CASCADES];
};

SunShadow fetch_sun_shadow(uint light) {
  SunShadow s;
  int row = cascade_row(light, 0u);
  s.sun = fetch_sun(light);
  s.direction = texelFetch(shadow_rows, ivec2(6, row), 0).xyz;
  s.cascades =
      ShadowCascade[](fetch_cascade(row), fetch_cascade(row + 1), fetch_cascade(row + 2), fetch_cascade(row + 3));
  return s;
}

ShadowPoint directional_shadow_point(SunShadow shadow, ShadowReceiver r) {
  SunReceiver s = sun_receiver(shadow.direction, shadow.sun.y, r);
  try_cascade(s, shadow.cascades[0], shadow.sun.x > 0.0);
  try_cascade(s, shadow.cascades[1], shadow.sun.x > 1.0 && !s.point.live);
  try_cascade(s, shadow.cascades[2], shadow.sun.x > 2.0 && !s.point.live);
  try_cascade(s, shadow.cascades[3], shadow.sun.x > 3.0 && !s.point.live);
  return sun_shadow_point(s, r.subsurface);
}

// Share of each texel that its nearest surface covers: from the low bits of coverage mips, 1 for other maps.
vec4 coverage(vec4 depth) {
  return kCoverage != 0u ? 1.0 - vec4(floatBitsToUint(depth) & 63u) * (1.0 / 64.0) : vec4(1.0);
}

// Reads the cube's depth in the direction of `at`: a texel coordinate (mip 0) of face p.face, which may be outside that
// face. Returns the depth converted to face p.face, and sets `at` to the centre of the texel that was read, as a
// coordinate of p.face. rise: how much nearer to the light the receiver plane may be inside that texel of the mip.
// share: covered share of the texel.
float cube_depth(ShadowPoint p, inout vec2 at, int mip, out float rise, out float share) {
  mat3 own = cube_face_axes(p.face);
  float to_texel = p.size * 0.5 / p.tan_half;
  vec2 tangent = (at - 0.5 * p.size) / to_texel;
  vec3 v = own * vec3(tangent.x, -tangent.y, 1.0);
  int face = cube_face_of(v);
  mat3 axes = cube_face_axes(face);
  vec3 local = v * axes;
  vec2 there = vec2(local.x, -local.y) / local.z * to_texel + 0.5 * p.size;
  MipSquare square = mip_square(origin_of_face(face), p.size, mip, shadow_block.atlas_size);
  vec2 cell = clamp(floor(there / square.texel), vec2(0.0), vec2(square.size - 1.0));
  float depth = texelFetch(shadow_atlas, ivec2(square.corner + cell), 0).x;
  share = coverage(vec4(depth)).x;
  vec2 center = ((cell + 0.5) * square.texel - 0.5 * p.size) / to_texel;
  vec3 read = (axes * vec3(center.x, -center.y, 1.0)) * own;
  read.z = max(read.z, 0.05);
  // In every face, the plane's depth is dot(plane, direction) for directions with component 1 along the face's axis.
  vec2 gradient = vec2(p.slope.x, -p.slope.y) * to_texel;
  vec2 receiver = (p.at - 0.5 * p.size) / to_texel;
  vec3 plane = (own * vec3(gradient, p.depth - dot(gradient, vec2(receiver.x, -receiver.y)))) * axes;
  rise = 0.5 * (square.texel - 1.0) * (abs(plane.x) + abs(plane.y)) / (to_texel * read.z);
  at = vec2(read.x, -read.y) / read.z * to_texel + 0.5 * p.size;
  return depth / read.z;
}

#endif

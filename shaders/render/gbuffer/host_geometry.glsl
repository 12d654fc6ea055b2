// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "shaders/common/math.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/gbuffer/host_geometry_shared.h"
#include "shaders/render/view_api.glsl"
#ifdef GLOAM_MOTION
#include "shaders/render/motion_api.glsl"
#endif

// Writes the host's geometry (engine/render/host_geometry.h) to the geometry buffer, with GLOAM_MOTION also the motion
// of surfaces at rest.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform HostBlock { HostGeometryConstants host; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform sampler2D normal_image;
layout(set = 0, binding = 4) uniform sampler2D face_normal_image;
layout(set = 0, binding = 5) uniform sampler2D base_color_image;
layout(set = 0, binding = 6) uniform sampler2D material_image;
layout(set = 0, binding = 7) uniform sampler2D emissive_image;

layout(location = 0) out vec4 out_base_color;
layout(location = 1) out uvec4 out_normals;
layout(location = 2) out vec4 out_material;
layout(location = 3) out vec4 out_emissive;
#ifdef GLOAM_MOTION
layout(set = 0, binding = 8, scalar) uniform MotionBlock { MotionConstants motion; };
layout(location = 4) out vec2 out_motion;
#endif

const float kNoSurface = -1.0;
const uint kStandard = 1u, kMetres = 2u;  // HostDepth
const uint kNoChannel = 4u;

// View depth in metres of a stored depth that is not the sky's.
float decode_depth(float stored) {
  // Share of the way from the far (0) to the near (1) distance, as stored.
  float nearness = host.depth_kind == kStandard ? 1.0 - stored : stored;
  float perspective = host.far_m == 0.0
                          ? host.near_m / nearness
                          : host.near_m * host.far_m / (host.near_m + nearness * (host.far_m - host.near_m));
  float projected = view.orthographic != 0u ? mix(host.far_m, host.near_m, nearness) : perspective;
  return host.depth_kind == kMetres ? stored : projected;
}

// View depth in metres, or kNoSurface for the sky and outside the picture.
float host_view_depth(ivec2 pixel) {
  ivec2 last = ivec2(view.size) - 1;
  float stored = texelFetch(depth_image, clamp(pixel, ivec2(0), last), 0).r;
  float sky = host.depth_kind == kStandard ? 1.0 : 0.0;
  bool shows = clamp(pixel, ivec2(0), last) == pixel && !isnan(stored) && !isinf(stored) && stored != sky;
  float depth = decode_depth(shows ? stored : 0.5);
  return shows && depth > 0.0 ? depth : kNoSurface;
}

// gloam's depth of a view depth: reversed, and infinitely far for perspective cameras.
float own_depth(float view_depth) {
  return clamp(view.orthographic == 0u ? view.ray_base.w / view_depth : (view_depth - view.ray_dx.w) / view.ray_dy.w,
               1e-30, 1.0);
}

vec3 position_at(ivec2 pixel, float view_depth) { return relative_position(view, vec2(pixel), own_depth(view_depth)); }

vec3 decode_normal(vec4 texel) {
  vec3 stored = texel.xyz * host.normal_scale.x + host.normal_scale.y;
  if (host.octahedral != 0u) {
    stored.z = 1.0 - abs(stored.x) - abs(stored.y);
    vec2 folded = (1.0 - abs(stored.yx)) * vec2(stored.x >= 0.0 ? 1.0 : -1.0, stored.y >= 0.0 ? 1.0 : -1.0);
    if (stored.z < 0.0) stored.xy = folded;
  }
  vec3 world = host.world_x.xyz * stored.x + host.world_y.xyz * stored.y + host.world_z.xyz * stored.z;
  return dot(world, world) > 0.0 ? normalize(world) : vec3(0.0, 1.0, 0.0);
}

// By how much the depths of two pixels on one side, extrapolated, miss the depth of the pixel itself. Depths as of
// own_depth are linear over a plane. Large where a side shows no surface.
float missed_depth(ivec2 pixel, ivec2 side, float depth) {
  float near = host_view_depth(pixel + side), far = host_view_depth(pixel + 2 * side);
  float first = near > 0.0 ? own_depth(near) : 1e9;
  float second = far > 0.0 ? own_depth(far) : depth;
  return abs(2.0 * first - second - depth);
}

// Step between the surface points of neighbouring pixels, on the side that continues the surface; 0 if neither
// neighbour shows a surface.
vec3 surface_step(ivec2 pixel, ivec2 side, float depth, vec3 position) {
  float own = own_depth(depth);
  bool forward = missed_depth(pixel, side, own) <= missed_depth(pixel, -side, own);
  ivec2 neighbour = pixel + (forward ? side : -side);
  float other = host_view_depth(neighbour);
  vec3 apart = position_at(neighbour, max(other, 1e-30)) - position;
  return other > 0.0 ? (forward ? apart : -apart) : vec3(0.0);
}

vec3 face_normal_at(ivec2 pixel, float depth, vec3 position, vec3 normal) {
  vec3 face =
      cross(surface_step(pixel, ivec2(0, 1), depth, position), surface_step(pixel, ivec2(1, 0), depth, position));
  vec3 facing = dot(face, to_viewer(view, position)) < 0.0 ? -face : face;
  return dot(face, face) > 0.0 ? normalize(facing) : normal;
}

float channel_of(vec4 material, uint shift, float otherwise) {
  uint channel = (host.channels >> shift) & 15u;
  return channel == kNoChannel ? otherwise : clamp(material[channel], 0.0, 1.0);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float view_depth = host_view_depth(pixel);
  if (!(view_depth > 0.0)) discard;
  vec3 position = position_at(pixel, view_depth);
  gl_FragDepth = own_depth(view_depth);

  vec3 normal = decode_normal(texelFetch(normal_image, pixel, 0));
  vec3 face = host.face_normals != 0u ? decode_normal(texelFetch(face_normal_image, pixel, 0))
                                      : face_normal_at(pixel, view_depth, position, normal);
  vec3 color = texelFetch(base_color_image, pixel, 0).rgb;
  out_base_color = encode_base_color(host.srgb != 0u ? srgb_to_linear(color) : color, false);
  out_normals = encode_normals(normal, face);
  vec4 material = texelFetch(material_image, pixel, 0);
  float roughness = channel_of(material, 0u, 1.0), metallic = channel_of(material, 4u, 0.0);
  // As surfaces without a stated reflectivity (surface_api.glsl).
  out_material = vec4(roughness, metallic, channel_of(material, 8u, 1.0), (1.0 - roughness) * mix(0.5, 1.0, metallic));
  vec3 emissive = host.emissive != 0u ? texelFetch(emissive_image, pixel, 0).rgb * view.light_scale : vec3(0.0);
  out_emissive = vec4(clamp(emissive, vec3(0.0), vec3(65504.0)), 0.0);
#ifdef GLOAM_MOTION
  out_motion = screen_motion(motion, (view.clip_from_relative * vec4(position, 1.0)).xyw,
                             previous_clip_at_rest(motion, position));
#endif
}

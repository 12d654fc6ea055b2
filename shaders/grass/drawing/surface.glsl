// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

// The surface of a blade, for the geometry buffer. With GLOAM_MOTION also its motion, with GLOAM_TEXTURED colour and
// shape from an image where the blade has one. The blade is drawn flat and
// shaded as a half tube: its normal turns from edge to edge. Light passes through blades: the normal is bent upward, so
// that a blade between the eye and a light is not black, and the material is marked as subsurface for shadows.
// Lighting, shadows and hemispheric ambient light are those of all surfaces of the geometry buffer.

#include "shaders/grass/drawing/pixel_width.glsl"
#include "shaders/grass/grass_shared.h"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"
#ifdef GLOAM_MOTION
#include "shaders/render/motion_api.glsl"
#endif

layout(constant_id = 2) const uint kClipped = 0u;  // 1: the view has a clip plane

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };

#ifdef GLOAM_TEXTURED
layout(set = 0, binding = 8) uniform sampler2DArray blade_textures;  // rows from the tip to the root
#endif

layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec3 in_binormal;
layout(location = 2) in vec3 in_place;  // along, across, layer
layout(location = 3) in vec3 in_relative;
layout(location = 6) in vec2 in_coverage;  // coverage; threshold of the blade

layout(location = 0) out vec4 out_base_color;
layout(location = 1) out uvec4 out_normals;
layout(location = 2) out vec4 out_material;
layout(location = 3) out vec4 out_emissive;
#ifdef GLOAM_MOTION
layout(location = 4) in vec3 in_clip;
layout(location = 5) in vec3 in_previous_clip;
layout(set = 0, binding = 4, scalar) uniform MotionBlock { MotionConstants motion; };
layout(location = 4) out vec2 out_motion;
#endif

const float kTube = 0.7;        // how far the normal turns toward the edges
const float kUpward = 1.2;      // how far it is bent upward
const float kRoughness = 0.55;  // of the waxy skin of a blade
const float kRootLight = 0.35;  // share of ambient light that reaches the root between its neighbours

// Base colour of a texture layer, linear: four hues of green, each in four ages from fresh to dry.
vec3 layer_color(uint layer) {
  const vec3 kHues[4] =
      vec3[](vec3(0.10, 0.20, 0.035), vec3(0.13, 0.21, 0.05), vec3(0.09, 0.17, 0.045), vec3(0.15, 0.20, 0.04));
  return mix(kHues[layer & 3u], vec3(0.24, 0.19, 0.08), 0.12 * float(layer >> 2 & 3u));
}

void main() {
  float along = in_place.x;
  uint layer = uint(in_place.z + 0.5);
#ifdef GLOAM_TEXTURED
  // Before any pixel is left out: the choice of the mip needs the neighbours.
  vec3 at = vec3(0.5 + 0.5 * in_place.y, 1.0 - along, max(float(layer) - float(GLOAM_GRASS_COLORS), 0.0));
  vec4 texel = texture(blade_textures, at, view.mip_bias);
  bool textured = layer >= uint(GLOAM_GRASS_COLORS);
  bool left_out =
      textured ? is_cut_out(in_coverage.x, texel.a, in_coverage.y) : is_left_out(in_coverage.x, in_coverage.y);
  if (left_out) discard;
#else
  if (is_left_out(in_coverage.x, in_coverage.y)) discard;
#endif
  if (kClipped != 0u && is_clipped(view, in_relative)) discard;
  vec3 seen = to_viewer(view, in_relative);
  vec3 flat_normal = normalize(in_normal);
  flat_normal = dot(flat_normal, seen) < 0.0 ? -flat_normal : flat_normal;
  vec3 normal = normalize(flat_normal + normalize(in_binormal) * (kTube * in_place.y) + vec3(0.0, kUpward, 0.0));
  vec3 color = layer_color(layer) * mix(0.55, 1.25, along);
  color *= 1.0 - 0.25 * exp2(-40.0 * in_place.y * in_place.y);  // the midrib
#ifdef GLOAM_TEXTURED
  color = textured ? texel.rgb : color;
#endif
  out_base_color = encode_thin_color(color);
  out_normals = encode_normals(normal, flat_normal);
  out_material = vec4(kRoughness, 0.0, mix(kRootLight, 1.0, smoothstep(0.0, 0.6, along)), 0.0);
  out_emissive = vec4(0.0);
#ifdef GLOAM_MOTION
  out_motion = screen_motion(motion, in_clip, in_previous_clip);
#endif
}

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/hit_distance_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// Brings the reflection images to the size of the picture, in the listed tiles: upscales them, bends the lookup by the
// normal of each pixel, and adds the fog on the reflected path. Where screen space has found a hit on a smooth surface,
// the lit picture is looked up again for each pixel, so that mirrors are as sharp as the picture. That picture has no
// blended surfaces yet, so where the ray met some, the hit stays as it is.

layout(constant_id = 0) const uint kColumns = 1u;  // the greater width of the blur decides
layout(constant_id = 1) const uint kScreenSpace = 1u;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform usampler2D normal_image;
layout(set = 0, binding = 3) uniform sampler2D material_image;
layout(set = 0, binding = 4) uniform sampler2D depth_image;
layout(set = 0, binding = 5) uniform sampler2D color_image;
layout(set = 0, binding = 6) uniform sampler2D surface_image;
layout(set = 0, binding = 7) uniform sampler2D ssr_color;
layout(set = 0, binding = 8) uniform sampler2D lit_image;
layout(set = 0, binding = 12) uniform sampler2D ssr_distance;
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D upscaled_image;  // premultiplied radiance, confidence

#define GLOAM_MIRROR_TILES 10
#define GLOAM_WIDTH_WITHOUT_CONSTANT
#include "shaders/reflections/passes/upscale.glsl"
#include "shaders/reflections/passes/blur_width.glsl"
#include "shaders/reflections/surfaces_api.glsl"

const float kSharp = 0.6;       // standard deviation of the blur, texels, up to which mirrors are sharp
const float kBlurred = 1.2;     // and from which on they are not
const float kSureScreen = 0.7;  // confidence of screen space from which on its hits are looked up again

vec3 clean(vec3 light) {
  return vec3(light.r > 0.0 ? min(light.r, 65504.0) : 0.0, light.g > 0.0 ? min(light.g, 65504.0) : 0.0,
              light.b > 0.0 ? min(light.b, 65504.0) : 0.0);
}

// Fog on the way to what is reflected. light: premultiplied by `share`.
vec3 fogged(vec3 light, float share, float distance_m) {
  float through = exp(-reflection.fog_density * distance_m);
  return light * through + reflection.fog_radiance.rgb * (share * (1.0 - through));
}

const float kLeastApart = 0.05;  // distance in depth, in units, up to which a pixel shows the hit,
const float kApartShare = 0.03;  // or this share of the ray's length

// The lit picture where a ray of this length ends. share: 0 if the picture shows something else there.
vec3 light_at_hit(vec3 origin, vec3 ray, float length_m, out float share) {
  vec3 hit = origin + ray * length_m;
  vec4 clip = view.clip_from_relative * vec4(hit, 1.0);
  vec2 at = (0.5 + clip.xy / max(clip.w, 1e-6) * vec2(0.5, -0.5)) * vec2(view.size);
  bool inside =
      clip.w > view.near_m * 0.5 && all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(view.size)));
  ivec2 pixel = clamp(ivec2(at), ivec2(0), ivec2(view.size) - 1);
  float seen = texelFetch(depth_image, pixel, 0).r;
  float apart_m = abs(surface_view_depth(view, max(seen, 1e-30)) - view_depth(view, hit));
  bool there =
      seen > 0.0 && apart_m < min(max(kLeastApart * reflection.unit_m, kApartShare * length_m), reflection.thickness_m);
  bool faces = dot(unpack_normal(texelFetch(normal_image, pixel, 0).y), ray) < 0.0;
  share = inside && there && faces ? 1.0 : 0.0;
  return clean(texelFetch(lit_image, pixel, 0).rgb);
}

vec4 reflection_of(ivec2 pixel, ivec2 texel) {
  float depth = texelFetch(depth_image, pixel, 0).r;
  uvec2 normals = texelFetch(normal_image, pixel, 0).xy;
  vec4 material = texelFetch(material_image, pixel, 0);
  vec3 position = relative_position(view, vec2(pixel), max(depth, 1e-30)), normal = unpack_normal(normals.x);
  if (mirror_share(unpack_normal(normals.y).y, material.x, material.w) <= 0.0) return vec4(0.0);
  Mirrored m = mirrored_at(pixel, position, normal);
  if (kScreenSpace != 0u) {
    vec4 surface = texelFetch(surface_image, texel, 0);
    float sigma = blur_sigma(texel, surface.x, surface.y), same;
    bool opaque = surface.y > 0.0 && texelFetch(ssr_distance, texel, 0).z == 0.0;
    float screen = opaque ? texelFetch(ssr_color, texel, 0).a : 0.0;
    vec3 ray = reflect(-normalize(to_viewer(view, position)), normal);
    vec3 light = light_at_hit(position, ray, m.distance_m, same) * m.confidence;
    float sharp = same * smoothstep(kSureScreen, 1.0, screen) * (1.0 - smoothstep(kSharp, kBlurred, sigma));
    m.light = mix(m.light, light, sharp);
  }
  return vec4(fogged(m.light, m.confidence, m.distance_m), m.confidence);
}

void main() {
  ivec2 texel;
  if (!mirror_texel(texel)) return;
  for (uint i = 0u; i < reflection.scale * reflection.scale; ++i) {
    ivec2 pixel = texel * int(reflection.scale) + block_offset(i);
    bool inside = all(lessThan(uvec2(pixel), view.size));
    vec4 light = reflection_of(min(pixel, ivec2(view.size) - 1), texel);
    if (inside) imageStore(upscaled_image, pixel, light);
  }
}

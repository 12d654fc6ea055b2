// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/environment_api.glsl"
#include "shaders/reflections/hit_distance_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// Adds the mirrored images to the lit picture, in the listed tiles:
//   occlusion · specular_share · mix(sky, mirrored · confidence + surroundings · (1 − confidence), reflectivity)
// Upscales the images, bends the lookup by the normal of each pixel, and adds the fog on the reflected path. Where
// screen space has found a hit on a smooth surface, the lit picture is looked up again for each pixel, so that mirrors
// are as sharp as the picture. That picture has no blended surfaces yet, so where the ray met some, the hit stays as it
// is. Pixels without a mirror surface are not written, and no others are looked up.

layout(constant_id = 0) const uint kColumns = 1u;  // the greater width of the blur decides
layout(constant_id = 1) const uint kScreenSpace = 1u;
layout(constant_id = 2) const uint kBumpy = 1u;     // 0: all normals are vertical
layout(constant_id = 3) const uint kCentered = 0u;  // 1: texels stand for the middles of blocks, not for first pixels

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform usampler2D normal_image;
layout(set = 0, binding = 3) uniform sampler2D material_image;
layout(set = 0, binding = 4) uniform sampler2D depth_image;
layout(set = 0, binding = 5) uniform sampler2D color_image;
layout(set = 0, binding = 6) uniform sampler2D surface_image;
layout(set = 0, binding = 7) uniform sampler2D ssr_color;
layout(set = 0, binding = 8) uniform sampler2D ssr_distance;
layout(set = 0, binding = 9, rgba16f) uniform image2D lit_image;
layout(set = 0, binding = 12) uniform sampler2D base_color_image;
layout(set = 0, binding = 13) uniform sampler2D ambient_image;
layout(set = 0, binding = 14) uniform usampler2D mirror_image;
layout(set = 0, binding = 15, scalar) uniform Environment { EnvironmentConstants environment; };

#define GLOAM_MIRROR_TILES 10
#define GLOAM_WIDTH_WITHOUT_CONSTANT
#include "shaders/reflections/passes/upscale.glsl"
#include "shaders/reflections/passes/blur_width.glsl"
#include "shaders/lighting/mirror_share_api.glsl"
#include "shaders/render/gbuffer_api.glsl"

// Radiance without NaN, infinity and negative values.
vec3 clean(vec3 light) {
  return vec3(light.r > 0.0 ? min(light.r, 65504.0) : 0.0, light.g > 0.0 ? min(light.g, 65504.0) : 0.0,
              light.b > 0.0 ? min(light.b, 65504.0) : 0.0);
}

const float kSharp = 0.6;       // standard deviation of the blur, texels, up to which mirrors are sharp
const float kBlurred = 1.2;     // and from which on they are not
const float kSureScreen = 0.7;  // confidence of screen space from which on its hits are looked up again

// Fog on the way to what is reflected. light: premultiplied by `share`.
vec3 fogged(vec3 light, float share, float distance_m) {
  float through = exp(-reflection.fog_density * distance_m);
  return light * through + reflection.fog_radiance.rgb * (share * (1.0 - through));
}

const float kLeastApart = 0.05;  // distance in depth, in units, up to which a pixel shows the hit,
const float kApartShare = 0.03;  // or this share of the ray's length

// Offsets of the pixels of a 2×2 block.
ivec2 block_offset(uint i) { return ivec2(i & 1u, i >> 1); }

// The pixel where a ray of this length ends. False: the picture shows something else there, or a
// surface that reflects strongly, which looks otherwise from the ray.
bool pixel_of_hit(vec3 origin, vec3 ray, float length_m, out ivec2 pixel) {
  vec3 hit = origin + ray * length_m;
  vec4 clip = view.clip_from_relative * vec4(hit, 1.0);
  vec2 at = (0.5 + clip.xy / (clip.w > 0.0 ? clip.w : 1.0) * vec2(0.5, -0.5)) * vec2(view.size);
  bool inside = (view.orthographic != 0u || clip.w > view.near_m * 0.5) && all(greaterThanEqual(at, vec2(0.0))) &&
                all(lessThan(at, vec2(view.size)));
  pixel = clamp(ivec2(at), ivec2(0), ivec2(view.size) - 1);
  float seen = texelFetch(depth_image, pixel, 0).r;
  float apart_m = abs(surface_view_depth(view, max(seen, 1e-30)) - view_depth(view, hit));
  bool there =
      seen > 0.0 && apart_m < min(max(kLeastApart * reflection.unit_m, kApartShare * length_m), reflection.thickness_m);
  bool faces = dot(unpack_normal(texelFetch(normal_image, pixel, 0).y), ray) < 0.0;
  vec4 material = texelFetch(material_image, pixel, 0);
  return inside && there && faces && !reflects_strongly(material.x, material.w);
}

// Share of the reflection that is looked up again.
float sharp_share(ivec2 texel) {
  if (kScreenSpace == 0u) return 0.0;
  vec4 surface = texelFetch(surface_image, texel, 0);
  float sigma = blur_sigma(texel, surface.x, surface.y);
  bool opaque = surface.y > 0.0 && texelFetch(ssr_distance, texel, 0).z == 0.0;
  float screen = opaque ? texelFetch(ssr_color, texel, 0).a : 0.0;
  return smoothstep(kSureScreen, 1.0, screen) * (1.0 - smoothstep(kSharp, kBlurred, sigma));
}

// The lit picture at a pixel with its reflection. texels: those about its block. ambient: StrongAmbient there.
vec4 with_reflection(ivec2 pixel, MirrorTexels texels, float sharp, vec4 ambient) {
  GBufferTexel g = decode_gbuffer(texelFetch(base_color_image, pixel, 0), texelFetch(normal_image, pixel, 0).xy,
                                  texelFetch(material_image, pixel, 0));
  float depth = texelFetch(depth_image, pixel, 0).r;
  vec3 position = relative_position(view, vec2(pixel), max(depth, 1e-30));
  vec3 to_eye = normalize(to_viewer(view, position));
  ShadingPoint p = shading_point(position, to_eye, g.normal, g.base_color, g.metallic, g.roughness);
  MirrorPixel of_pixel = mirror_pixel(pixel, depth, position, g.face_normal, g.roughness);
  Mirrored m = mirrored_at(pixel, of_pixel, texels, g.normal);
  vec3 ray = reflect(-to_eye, g.normal);
  ivec2 at;
  bool found = sharp > 0.0 && m.confidence > 0.0 && pixel_of_hit(position, ray, m.distance_m, at);
  if (found) m.light = mix(m.light, clean(imageLoad(lit_image, at).rgb) * m.confidence, sharp);
  vec3 share = specular_share(p, g.roughness) * g.occlusion;
  vec3 mirrored = fogged(m.light, m.confidence, m.distance_m) * g.reflectivity;
  vec3 light = share * (mirrored + mirrored_radiance(environment, p, g.roughness) * (1.0 - g.reflectivity)) +
               ambient.rgb * max(1.0 - m.confidence, 0.0);
  vec4 lit = imageLoad(lit_image, pixel);
  return vec4(min(lit.rgb + light, vec3(65504.0)), lit.a);
}

void main() {
  ivec2 texel;
  if (!mirror_texel(texel)) return;
  float sharp = sharp_share(texel);
  MirrorTexels texels = fetch_texels(texel);
  uint i = 0u;
  do {
    ivec2 pixel = texel * int(reflection.scale) + block_offset(i);
    bool inside = all(lessThan(uvec2(pixel), view.size));
    vec4 ambient = texelFetch(ambient_image, min(pixel, ivec2(view.size) - 1), 0);
    vec4 light = with_reflection(min(pixel, ivec2(view.size) - 1), texels, sharp, ambient);
    if (inside && ambient.a > 0.0) imageStore(lit_image, pixel, light);
  } while (++i < reflection.scale * reflection.scale);  // see passes/surroundings.comp.glsl
}

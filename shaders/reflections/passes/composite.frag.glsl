// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/environment_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// Adds the specular reflection of the surroundings to the lit picture:
//   occlusion · specular_share · mix(surroundings, reflection, reflectivity)
// where `surroundings` is what lighting adds without this module, and `reflection` the blend of all tiers: screen space
// and proxies by their confidence, the probes and the sky in what remains.

layout(constant_id = 0) const uint kMirror = 1u;  // 0: probes alone, without reflection images
// Captured probes of the world. Up to GLOAM_FEW_PROBES the loop over them is unrolled: rows at constant places of a
// uniform are read once, not by each thread.
layout(constant_id = 1) const uint kProbes = 0u;
layout(constant_id = 2) const uint kTraced = 0u;  // 1: traced radiance in place of all tiers, for references

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform sampler2D base_color_image;
layout(set = 0, binding = 3) uniform usampler2D normal_image;
layout(set = 0, binding = 4) uniform sampler2D material_image;
layout(set = 0, binding = 5) uniform sampler2D depth_image;
layout(set = 0, binding = 6) uniform sampler2D upscaled_image;  // tiers 1 and 2, in tiles with a mirror surface
layout(set = 0, binding = 8) uniform sampler2DArray probe_images;
layout(set = 0, binding = 9, scalar) readonly buffer ProbeRows { ProbeRow probe_rows[]; };
layout(set = 0, binding = 10, scalar) uniform Tiles { ProxyTileConstants tiles; };
layout(set = 0, binding = 11, scalar) uniform Environment { EnvironmentConstants environment; };
layout(set = 0, binding = 12) uniform sampler2D diffuse_light;
layout(set = 0, binding = 13, scalar) readonly buffer ChangedLights { ChangedLight changed_lights[]; };

layout(set = 0, binding = 14) uniform sampler2D traced_image;
layout(set = 0, binding = 16, scalar) uniform FewProbes { ProbeRow few_probes[GLOAM_FEW_PROBES]; };

layout(location = 0) out vec4 out_light;

ProbeRow probe_row(uint i) {
  if (kProbes <= uint(GLOAM_FEW_PROBES)) return few_probes[i];
  return probe_rows[i];
}
#define GLOAM_PROBE_ROW(i) probe_row(i)
#include "shaders/reflections/probes/probes_api.glsl"
#include "shaders/reflections/proxies/changed_light_api.glsl"

// Fog on the way to what the probes show.
vec3 fogged(vec3 light) {
  float through = exp(-reflection.fog_density * reflection.fog_sky_m);
  return light * through + reflection.fog_radiance.rgb * (1.0 - through);
}

// Radiance of the probes and, beyond them, of the surroundings without probes.
vec3 far_radiance(ShadingPoint p, GBufferTexel g, vec3 around, ivec2 pixel) {
  if (kProbes == 0u) return around;
  float covered;
  vec3 direction = reflect(-p.to_eye, g.normal);
  vec3 light;
  if (kProbes <= uint(GLOAM_FEW_PROBES))
    light = probes_radiance(kProbes, p.position, direction, g.roughness, covered);
  else
    light = probes_radiance(tiles.probes, p.position, direction, g.roughness, covered);
  float ratio = 1.0;
  if (reflection.changed_lights != 0u)
    ratio = diffuse_light_ratio(texelFetch(diffuse_light, pixel, 0).rgb, p.position, g.normal);
  return light * (ratio * reflection.capture_scale) + around * (1.0 - covered);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_image, pixel, 0).r;
  vec3 position = relative_position(view, vec2(pixel), max(depth, 1e-30));
  GBufferTexel g = decode_gbuffer(texelFetch(base_color_image, pixel, 0), texelFetch(normal_image, pixel, 0).xy,
                                  texelFetch(material_image, pixel, 0));
  ShadingPoint p =
      shading_point(position, normalize(to_viewer(view, position)), g.normal, g.base_color, g.metallic, g.roughness);
  vec3 around = mirrored_radiance(environment, p, g.roughness), reflected_light = around;
  if (g.reflectivity > 0.0) {
    vec3 far = far_radiance(p, g, around, pixel);
    reflected_light = fogged(far);
    if (kTraced != 0u) {
      reflected_light = texelFetch(traced_image, pixel, 0).rgb * view.light_scale;
    } else if (kMirror != 0u) {
      vec4 mirrored = texelFetch(upscaled_image, pixel, 0);
      reflected_light = reflected_light * (1.0 - mirrored.a) + mirrored.rgb;
    }
  }
  vec3 light = (g.occlusion * mix(around, reflected_light, g.reflectivity)) * specular_share(p, g.roughness);
  out_light = vec4(min(light, vec3(65504.0)), 0.0);
}

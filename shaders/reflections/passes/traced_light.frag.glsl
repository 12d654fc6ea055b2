// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/environment_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// Adds traced reflections to a lit picture without its specular ambient term, for references:
//   occlusion · specular_share · mix(mirrored_radiance, traced radiance, reflectivity)

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Environment { EnvironmentConstants environment; };
layout(set = 0, binding = 2) uniform sampler2D base_color_image;
layout(set = 0, binding = 3) uniform usampler2D normal_image;
layout(set = 0, binding = 4) uniform sampler2D material_image;
layout(set = 0, binding = 5) uniform sampler2D depth_image;
layout(set = 0, binding = 6) uniform sampler2D traced_image;

layout(location = 0) out vec4 out_light;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 position = relative_position(view, vec2(pixel), max(texelFetch(depth_image, pixel, 0).r, 1e-30));
  GBufferTexel g = decode_gbuffer(texelFetch(base_color_image, pixel, 0), texelFetch(normal_image, pixel, 0).xy,
                                  texelFetch(material_image, pixel, 0));
  ShadingPoint p =
      shading_point(position, normalize(to_viewer(view, position)), g.normal, g.base_color, g.metallic, g.roughness);
  vec3 around = mirrored_radiance(environment, p, g.roughness);
  vec3 traced = texelFetch(traced_image, pixel, 0).rgb * view.light_scale;
  vec3 mirrored = mix(around, traced, g.reflectivity > 0.0 ? g.reflectivity : 0.0);
  out_light = vec4(min(g.occlusion * specular_share(p, g.roughness) * mirrored, vec3(65504.0)), 0.0);
}

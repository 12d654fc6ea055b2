// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_FINAL_LISTS_BINDING 9
#include "shaders/lighting/environment_api.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/final_lists_api.glsl"

// Lights the surfaces of the geometry buffer by gloam's light lists and visibilities, with a look of the host's.

layout(push_constant, scalar) uniform Look { uint bands; };  // steps of each light's visibility; 0: smooth, as gloam
layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2, scalar) uniform Environment { EnvironmentConstants environment; };
layout(set = 0, binding = 3) uniform sampler2D base_color_image;
layout(set = 0, binding = 4) uniform usampler2D normal_image;
layout(set = 0, binding = 5) uniform sampler2D material_image;
layout(set = 0, binding = 6) uniform sampler2D emissive_image;
layout(set = 0, binding = 7) uniform sampler2D depth_image;
layout(set = 0, binding = 8) uniform sampler2D light_texels;

layout(location = 0) out vec4 out_light;  // cd/m² before exposure

float visibility_of(uint entry, uvec2 pixel) {
  float visibility = entry_visibility(entry, slot_pixel(pixel));
  return bands == 0u ? visibility : floor(visibility * float(bands) + 0.5) / float(bands);
}

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  FinalList list = final_list(pixel);
  if (!list.complete) discard;  // the buffers were full: gloam's light stays
  float depth = texelFetch(depth_image, ivec2(pixel), 0).r;
  vec3 position = relative_position(view, gl_FragCoord.xy - 0.5, depth);
  GBufferTexel g =
      decode_gbuffer(texelFetch(base_color_image, ivec2(pixel), 0), texelFetch(normal_image, ivec2(pixel), 0).xy,
                     texelFetch(material_image, ivec2(pixel), 0));
  ShadingPoint p =
      shading_point(position, normalize(to_viewer(view, position)), g.normal, g.base_color, g.metallic, g.roughness);
  vec3 light = texelFetch(emissive_image, ivec2(pixel), 0).rgb + ambient(environment, p, g.roughness, g.occlusion);
  for (uint i = 0u; i < list.directional_count; ++i) {
    uint entry = final_entries[list.directional_first + i];
    DirectionalLight sun = lights.directional[entry_light(entry)];
    light += reflected(p, -sun.direction, sun.color * visibility_of(entry, pixel));
  }
  for (uint i = 0u; i < list.local_count; ++i) {
    uint entry = final_entries[list.local_first + i];
    vec3 to_light;
    vec3 illuminance = local_illuminance(fetch_light(light_texels, entry_light(entry)), position, to_light);
    light += reflected(p, to_light, illuminance * visibility_of(entry, pixel));
  }
  out_light = vec4(min(light, vec3(65504.0)), 1.0);
}

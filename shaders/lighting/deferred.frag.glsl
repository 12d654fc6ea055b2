// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/environment.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// Lights the geometry buffer: every light of the pixel's tile, or every light of the view (constant 0 = 0: brute force).
// Masks only leave out lights that do not reach: both give the same picture to the bit.

layout(constant_id = 0) const uint kTiled = 1u;
layout(constant_id = 1) const uint kDirectionalLights = 0u;  // known when the pipeline is made, so that the loop is unrolled

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2, scalar) uniform Environment { EnvironmentConstants environment; };
layout(set = 0, binding = 3) uniform sampler2D base_color_image;
layout(set = 0, binding = 4) uniform usampler2D normal_image;
layout(set = 0, binding = 5) uniform sampler2D material_image;
layout(set = 0, binding = 6) uniform sampler2D emissive_image;
layout(set = 0, binding = 7) uniform sampler2D depth_image;
layout(set = 0, binding = 8) uniform usampler2DArray mask_image;
layout(set = 0, binding = 9) uniform sampler2D light_texels;

layout(location = 0) out vec4 out_light;

vec3 add_local(ShadingPoint p, uint index) {
  vec3 to_light;
  vec3 illuminance = local_illuminance(fetch_light(light_texels, index), p.position, to_light);
  return reflected(p, to_light, illuminance);
}

vec3 local_lights(ShadingPoint p, ivec2 tile) {
  vec3 sum = vec3(0.0);
  if (kTiled == 0u) {
    for (uint i = 0u; i < lights.local_count; ++i) sum += add_local(p, i);
    return sum;
  }
  for (uint groups = texelFetch(mask_image, ivec3(tile, GLOAM_LIGHT_GROUPS), 0).x; groups != 0u; groups &= groups - 1u) {
    uint word = uint(findLSB(groups));
    for (uint bits = texelFetch(mask_image, ivec3(tile, word), 0).x; bits != 0u; bits &= bits - 1u)
      sum += add_local(p, word * 32u + uint(findLSB(bits)));
  }
  return sum;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_image, pixel, 0).r;
  vec3 position = relative_position(view, gl_FragCoord.xy - 0.5, max(depth, 1e-9));
  GBufferTexel g = decode_gbuffer(texelFetch(base_color_image, pixel, 0), texelFetch(normal_image, pixel, 0).xy,
                                  texelFetch(material_image, pixel, 0));
  vec3 to_eye = normalize(to_viewer(view, position));
  ShadingPoint p = shading_point(position, to_eye, g.normal, g.base_color, g.metallic, g.roughness);
  vec3 light = texelFetch(emissive_image, pixel, 0).rgb + ambient(environment, p, g.roughness, g.occlusion);
  for (uint i = 0u; i < kDirectionalLights; ++i) {
    DirectionalLight d = lights.directional[i];
    light += reflected(p, -d.direction, d.color);
  }
  light += local_lights(p, pixel / 8);
  if (depth <= 0.0) light = sky_radiance(environment, -p.to_eye);
  out_light = vec4(min(light, vec3(65504.0)), 1.0);
}

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_OPAQUE_DEFERRED_GLSL
#define GLOAM_SHADERS_LIGHTING_OPAQUE_DEFERRED_GLSL

#include "shaders/lighting/environment_api.glsl"
#include "shaders/lighting/mirror_share_api.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// Lights the surfaces of the geometry buffer. Shared by deferred.frag, deferred_tiled.frag and their variants with
// shadows or cookies, which define local_lights.

layout(constant_id = 1) const uint kDirectionalLights = 0u;  // a constant of the pipeline, so that the loop is unrolled
layout(constant_id = 3) const uint kSpecularAmbient = 1u;    // 0: without it; 2: with far_image
layout(constant_id = 4) const uint kDiffuseLight = 0u;       // 1: with the second target
layout(constant_id = 32) const uint kTracedIndirect = 0u;    // 1: with traced_indirect, for references
layout(constant_id = 35) const uint kOcclusion = 0u;         // 1: with hidden_image

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2, scalar) uniform Environment { EnvironmentConstants environment; };
layout(set = 0, binding = 3) uniform sampler2D base_color_image;
layout(set = 0, binding = 4) uniform usampler2D normal_image;
layout(set = 0, binding = 5) uniform sampler2D material_image;
layout(set = 0, binding = 6) uniform sampler2D emissive_image;
layout(set = 0, binding = 7) uniform sampler2D depth_image;
layout(set = 0, binding = 8) uniform sampler2D light_texels;
layout(set = 0, binding = 23) uniform sampler2D far_image;        // SurroundingsOutput
layout(set = 0, binding = 26) uniform sampler2D traced_indirect;  // IndirectLight::traced
layout(set = 0, binding = 27) uniform sampler2D hidden_image;     // AmbientOcclusion
#define GLOAM_INDIRECT_BINDING 24
#include "shaders/lighting/indirect_api.glsl"

layout(location = 0) out vec4 out_light;
layout(location = 1) out vec4 out_diffuse_light;  // lux

#ifdef GLOAM_SHADOWS_BINDING
#define GLOAM_SMOOTH_SURFACE_BINDING 20
#endif
#include "shaders/lighting/arriving_light.glsl"

vec3 diffuse_light = vec3(0.0);  // illuminance of the surface, summed only with kDiffuseLight

vec3 add_reflected(ShadingPoint p, vec3 to_light, vec3 illuminance, float half_angle) {
  if (kDiffuseLight != 0u) diffuse_light += illuminance * clamp(dot(p.normal, to_light), 0.0, 1.0);
  vec3 light = reflected_disc(p, to_light, illuminance, half_angle);
  if (extinction_behind(extinction_m, p.normal, to_light) > 0.0) {
    vec3 through = light_through(p, to_light, illuminance);
    if (kDiffuseLight != 0u) diffuse_light += through;
    light += p.diffuse * through;
  }
  return light;
}

// `share`: visibility (transmittance) of the light, multiplied with the shadows and cookies that arriving_local
// applies.
vec3 add_local(ShadingPoint p, uint index, float share) {
  vec3 to_light;
  LocalLight light = fetch_light(light_texels, index);
  vec3 illuminance = local_illuminance(light, p.position, to_light);
  illuminance = arriving_local(illuminance, index, light.position, p.normal, to_light) * share;
  return add_reflected(p, to_light, illuminance, half_angle_of(index, light.position - p.position));
}

// Radiance from directional lights at the surface under a pixel.
vec3 directional_lights(ShadingPoint p, uvec2 pixel);

// Radiance from local lights at the surface under a pixel. Lights are summed in ascending order: versions that leave
// out only lights that do not reach the surface get bit-identical sums.
vec3 local_lights(ShadingPoint p, uvec2 pixel);

#ifndef GLOAM_FINAL_LISTS_BINDING
vec3 directional_lights(ShadingPoint p, uvec2 pixel) {
#ifdef GLOAM_SHADOWS_BINDING
  uint count = lights.directional_count;  // not a constant: loops with shadows must not be unrolled
#else
  const uint count = kDirectionalLights;
#endif
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < count; ++i) {
    DirectionalLight d = lights.directional[i];
    sum += add_reflected(p, -d.direction, arriving_directional(d.color, i, d.direction, p.normal), d.half_angle);
  }
  return sum;
}
#endif

// The specular ambient term of surfaces that reflect weakly; that of others is added after the pass.
vec3 weak_reflection(ShadingPoint p, ivec2 pixel, GBufferTexel g, vec3 around) {
  vec3 far = texelFetch(far_image, pixel * textureSize(far_image, 0) / ivec2(view.size), 0).rgb;
  vec3 light = specular_share(p, g.roughness) * mix(around, far, g.reflectivity);
  return reflects_strongly(g.roughness, g.reflectivity) ? vec3(0.0) : light;
}

vec3 ambient_light(ShadingPoint p, ivec2 pixel, GBufferTexel g) {
  SurroundingLight around = surrounding_light(p.position, p.normal);
  if (kTracedIndirect != 0u)
    around = SurroundingLight(texelFetch(traced_indirect, pixel, 0).rgb * view.light_scale, 1.0);
  // Traced light is what its rays met, so nothing more is hidden. Mirrored light comes from one direction, about which
  // the mean of the hemisphere says little.
  float visible = 1.0;
  if (kOcclusion != 0u && kTracedIndirect == 0u) visible -= texelFetch(hidden_image, pixel, 0).r;
  if (kDiffuseLight != 0u) diffuse_light += (kPi * g.occlusion * visible) * around.radiance;
  vec3 light = visible * diffuse_surroundings(p, around);
  vec3 mirrored = mirrored_surroundings(p, g.roughness, around);
  if (kSpecularAmbient == 1u) light += specular_share(p, g.roughness) * mirrored;
  if (kSpecularAmbient == 2u) light += weak_reflection(p, pixel, g, mirrored);
  return g.occlusion * light;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_image, pixel, 0).r;
  vec3 position = relative_position(view, gl_FragCoord.xy - 0.5, max(depth, 1e-30));
  GBufferTexel g = decode_gbuffer(texelFetch(base_color_image, pixel, 0), texelFetch(normal_image, pixel, 0).xy,
                                  texelFetch(material_image, pixel, 0));
  vec3 to_eye = normalize(to_viewer(view, position));
  ShadingPoint p = shading_point(position, to_eye, g.normal, g.base_color, g.metallic, g.roughness);
  p.normal_spread = g.normal_spread;
  vec4 emissive = texelFetch(emissive_image, pixel, 0);
  if (kTransmission != 0u) extinction_m = decode_extinction(emissive.a);
  vec3 light = emissive.rgb + ambient_light(p, pixel, g);
  set_receiver(position, g.face_normal, g.subsurface);
#ifdef GLOAM_SHADOWS_BINDING
  receiver = pixel_receiver(position, g.face_normal, g.subsurface, pixel);
  receiver.thin = g.thin;
#endif
  light += directional_lights(p, uvec2(pixel));
  light += local_lights(p, uvec2(pixel));
  out_light = vec4(min(light, vec3(65504.0)), 1.0);
  if (kDiffuseLight != 0u) out_diffuse_light = vec4(min(diffuse_light, vec3(65504.0)), 1.0);
}

#endif

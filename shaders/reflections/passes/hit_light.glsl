// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_HIT_LIGHT_GLSL
#define GLOAM_SHADERS_REFLECTIONS_HIT_LIGHT_GLSL

#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// The light that a mirrored ray meets at a pixel. Before including this, define GLOAM_LIT_AT(pixel), the lit picture,
// and GLOAM_SURROUNDINGS_BINDING; declare the uniforms `view` and `environment` and the images base_color_image,
// normal_image, material_image, depth_image and ambient_image.
#include "shaders/lighting/mirror_share_api.glsl"
#include "shaders/lighting/surroundings_api.glsl"

// Radiance without NaN, infinity and negative values.
vec3 clean(vec3 light) {
  return vec3(light.r > 0.0 ? min(light.r, 65504.0) : 0.0, light.g > 0.0 ? min(light.g, 65504.0) : 0.0,
              light.b > 0.0 ? min(light.b, 65504.0) : 0.0);
}

// direction: of the ray, unit length. The surface is seen along the ray: if it reflects strongly, it mirrors other
// surroundings than toward the camera.
vec3 light_along(ivec2 pixel, vec3 direction) {
  vec4 material = texelFetch(material_image, pixel, 0);
  vec3 seen = clean(GLOAM_LIT_AT(pixel));
  if (reflects_strongly(material.x, material.w)) {
    GBufferTexel g =
        decode_gbuffer(texelFetch(base_color_image, pixel, 0), texelFetch(normal_image, pixel, 0).xy, material);
    vec3 position = relative_position(view, vec2(pixel), max(texelFetch(depth_image, pixel, 0).r, 1e-30));
    ShadingPoint p = shading_point(position, -direction, g.normal, g.base_color, g.metallic, g.roughness);
    vec4 ambient = texelFetch(ambient_image, pixel, 0);  // toward the camera
    if (ambient.a == 0.0) seen = max(seen - ambient.rgb, vec3(0.0));
    seen += g.occlusion *
            specular_surroundings(p, g.roughness, g.reflectivity, mirrored_radiance(environment, p, g.roughness));
  }
  return clean(seen);
}

#endif

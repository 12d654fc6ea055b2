// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_TESTS_LIGHTING_SURFACES_GLSL
#define GLOAM_TESTS_LIGHTING_SURFACES_GLSL

#include "shaders/lighting/brdf_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// Surfaces of the geometry buffer, as a module outside of lighting reads them.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform sampler2D base_color_image;
layout(set = 0, binding = 3) uniform usampler2D normal_image;
layout(set = 0, binding = 4) uniform sampler2D material_image;

bool is_sky(ivec2 pixel) { return texelFetch(depth_image, pixel, 0).r <= 0.0; }

GBufferTexel surface_at(ivec2 pixel) {
  return decode_gbuffer(texelFetch(base_color_image, pixel, 0), texelFetch(normal_image, pixel, 0).xy,
                        texelFetch(material_image, pixel, 0));
}

ShadingPoint point_at(ivec2 pixel, GBufferTexel g) {
  vec3 position = relative_position(view, vec2(pixel), max(texelFetch(depth_image, pixel, 0).r, 1e-9));
  return shading_point(position, normalize(to_viewer(view, position)), g.normal, g.base_color, g.metallic, g.roughness);
}

#endif

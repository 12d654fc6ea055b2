// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_TESTS_LIGHTING_SHADE_GLSL
#define GLOAM_TESTS_LIGHTING_SHADE_GLSL

#include "tests/shaders/lighting_test/surfaces.glsl"

// Shades the surfaces of the geometry buffer by the forward light loop, without emission. With GLOAM_FORWARD_RESPONSE,
// the sum of the lights' illuminances.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 5, rgba32f) uniform writeonly image2D shaded_image;

#define GLOAM_SHADOWS_PIXEL ivec2(gl_GlobalInvocationID.xy)
#define GLOAM_FORWARD_BINDING 6
#include "shaders/lighting/forward_lights_api.glsl"

#ifdef GLOAM_FORWARD_RESPONSE
vec3 light_response(ShadingPoint p, vec3 to_light, vec3 illuminance) { return illuminance; }
#endif

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(uvec2(pixel), view.size))) return;
  vec3 light = vec3(0.0);
  if (!is_sky(pixel)) {
    GBufferTexel g = surface_at(pixel);
    ShadingPoint p = point_at(pixel, g);
    set_receiver(p.position, g.face_normal, g.subsurface);
#ifndef GLOAM_FORWARD_RESPONSE
    light = ambient(environment, p, g.roughness, g.occlusion);
#endif
    add_forward_lights(light, p, uvec2(pixel));
  }
  imageStore(shaded_image, pixel, vec4(light, 1.0));
}

#endif

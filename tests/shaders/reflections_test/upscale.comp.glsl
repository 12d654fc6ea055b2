// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"
#include "shaders/reflections/hit_distance_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_api.glsl"

// Looks the reflection of each pixel up, as the composite does.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform usampler2D normal_image;
layout(set = 0, binding = 3) uniform sampler2D depth_image;
layout(set = 0, binding = 4) uniform sampler2D color_image;
layout(set = 0, binding = 5) uniform sampler2D surface_image;
layout(set = 0, binding = 7) uniform usampler2D mirror_image;
layout(set = 0, binding = 6, scalar) writeonly buffer Lights { vec4 lights[]; };

const uint kBumpy = 1u, kCentered = 0u;
#include "shaders/reflections/passes/upscale.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(uvec2(pixel), view.size))) return;
  float depth = texelFetch(depth_image, pixel, 0).r;
  vec3 position = relative_position(view, vec2(pixel), max(depth, 1e-9));
  uvec2 normals = texelFetch(normal_image, pixel, 0).xy;
  MirrorPixel p = mirror_pixel(pixel, depth, position, unpack_normal(normals.y), 1.0 / 255.0);
  Mirrored m = mirrored_at(pixel, p, fetch_texels(pixel / int(reflection.scale)), unpack_normal(normals.x));
  lights[uint(pixel.y) * view.size.x + uint(pixel.x)] = vec4(m.light, m.confidence);
}

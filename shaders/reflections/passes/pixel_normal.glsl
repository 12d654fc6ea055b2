// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_PIXEL_NORMAL_GLSL
#define GLOAM_SHADERS_REFLECTIONS_PIXEL_NORMAL_GLSL

#include "shaders/common/math.glsl"
#include "shaders/reflections/mirror_surface_api.glsl"

// Rays mirrored at the shading normals of pixels in place of the vertical. Include this after the uniform `view` and
// the image normal_image.

const float kLeastSlope = 0.01;  // y of the directions: rays that would enter the floor leave it at this slope

void follow_normal(inout MirrorSurface s) {
  vec3 normal = unpack_normal(texelFetch(normal_image, s.pixel, 0).x);
  vec3 ray = reflect(-normalize(to_viewer(view, s.position)), normal);
  s.direction = normalize(vec3(ray.x, max(ray.y, kLeastSlope), ray.z));
}

#endif

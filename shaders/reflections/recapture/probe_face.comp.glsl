// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/recapture/recapture_shared.h"

// A face of a probe's cube from a view of that face, as half floats can hold it.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D light_image;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2DArray face_image;

layout(push_constant, scalar) uniform Push { RecaptureConstants recapture; };

float storable(float value) { return value > 0.0 ? min(value, 65504.0) : 0.0; }

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(face_image).xy;
  if (texel.x >= size.x || texel.y >= size.y) return;
  vec3 light = texelFetch(light_image, texel, 0).rgb * recapture.scale;
  imageStore(face_image, ivec3(texel, 0), vec4(storable(light.r), storable(light.g), storable(light.b), 1.0));
}

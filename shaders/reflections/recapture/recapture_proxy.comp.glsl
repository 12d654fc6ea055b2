// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/recapture/recapture_shared.h"

// Mip 0 of a proxy's image from a view of the proxy: the mean of the pixels of each texel, premultiplied by alpha,
// which is 0 where no surface was met.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D light_image;
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2, rgba16f) uniform writeonly image2D captured_image;

layout(push_constant, scalar) uniform Push { RecaptureConstants recapture; };

// As half floats can hold it: NaN and negative numbers become 0.
float storable(float value) { return value > 0.0 ? min(value, 65504.0) : 0.0; }

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(captured_image);
  if (texel.x >= size.x || texel.y >= size.y) return;
  ivec2 target = texel;
  if (recapture.upside_down != 0u) target.y = size.y - 1 - texel.y;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < GLOAM_RECAPTURE_PIXELS; ++y)
    for (int x = 0; x < GLOAM_RECAPTURE_PIXELS; ++x) {
      ivec2 pixel = texel * GLOAM_RECAPTURE_PIXELS + ivec2(x, y);
      if (texelFetch(depth_image, pixel, 0).r <= 0.0) continue;
      vec3 light = texelFetch(light_image, pixel, 0).rgb * recapture.scale;
      sum += vec4(storable(light.r), storable(light.g), storable(light.b), 1.0);
    }
  imageStore(captured_image, target, sum / float(GLOAM_RECAPTURE_PIXELS * GLOAM_RECAPTURE_PIXELS));
}

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// Twice the light.

layout(set = 0, binding = 0) uniform sampler2D lit_image;

layout(location = 0) out vec4 out_light;

void main() { out_light = vec4(2.0 * texelFetch(lit_image, ivec2(gl_FragCoord.xy), 0).rgb, 1.0); }

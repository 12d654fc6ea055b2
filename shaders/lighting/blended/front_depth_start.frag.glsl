// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// Copies the depth of opaque surfaces.

layout(set = 0, binding = 0) uniform sampler2D depth_image;

layout(location = 0) out vec4 out_depth;

void main() { out_depth = vec4(texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).x); }

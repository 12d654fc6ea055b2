// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Multiplies the vertex colour by a tint from set 1 and a brightness from set 0, for the tests of drawing and sets.

layout(set = 0, binding = 0, scalar) uniform Brightness { float brightness; };
layout(set = 1, binding = 3, scalar) readonly buffer Tints { vec4 tints[]; };
layout(location = 0) in vec4 in_color;
layout(location = 0) out vec4 out_color;
layout(push_constant, scalar) uniform Push { uint tint; }
push;

void main() { out_color = in_color * tints[push.tint] * brightness; }

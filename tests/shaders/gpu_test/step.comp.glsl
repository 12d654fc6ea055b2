// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Counts steps in place, for tests of history buffers.
layout(local_size_x = 1) in;

layout(push_constant, scalar) uniform Constants { uint restart; };
layout(set = 0, binding = 0, scalar) buffer Steps { uint steps; };

void main() { steps = restart != 0u ? 1u : steps + 1u; }

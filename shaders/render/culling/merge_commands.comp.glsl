// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/culling/culling_shared.h"

// Writes the draw command of each cluster. The first of several visible neighbours within a draw draws them all,
// because a command costs as much as some fifty triangles on a software device. The others, and hidden clusters, draw
// nothing.

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer Clusters { DrawCluster clusters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Starts { uint starts[]; };  // 1: the first cluster of a draw
layout(set = 0, binding = 2, scalar) readonly buffer Visible { uint visible[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Commands { ClusterCommand commands[]; };
layout(push_constant, scalar) uniform Push { uint cluster_count; };

void main() {
  uint index = gl_GlobalInvocationID.x;
  if (index >= cluster_count) return;
  bool begins = visible[index] != 0u && (starts[index] != 0u || visible[index - 1u] == 0u);
  uint count = 0u;
  for (uint i = index; begins && i < cluster_count && visible[i] != 0u && (i == index || starts[i] == 0u); ++i)
    count += clusters[i].index_count;
  commands[index] = ClusterCommand(count, begins ? 1u : 0u, clusters[index].first_index, 0, 0u);
}

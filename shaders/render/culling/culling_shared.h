// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_CULLING_CULLING_SHARED_H
#define GLOAM_SHADERS_RENDER_CULLING_CULLING_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// Triangles of one draw that are culled together.
struct DrawCluster {
  vec3 low;  // of the box of the drawn vertices, relative to the view's position
  uint first_index;
  vec3 high;  // less than low: the box is unknown
  uint index_count;
};

/// VkDrawIndexedIndirectCommand.
struct ClusterCommand {
  uint index_count;
  uint instance_count;  // 1 if the cluster is drawn, 0 if it is hidden
  uint first_index;
  int vertex_offset;
  uint first_instance;
};

struct CullingCounters {
  uint clusters;   // hidden
  uint triangles;  // of the hidden clusters
};

GLOAM_SHARED_END

#define GLOAM_CULLING_TEXEL 8u   // pixels along the side of a texel of the finest occluder depth
#define GLOAM_CULLING_LEVELS 5u  // images of occluder depth; each has half the size of the one before

#endif

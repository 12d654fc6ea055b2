// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/culling/culling_shared.h"
#include "shaders/render/view_shared.h"

// Finds the clusters that may have a visible pixel: all but those whose box is behind the occluders at all pixels that
// it may cover. Only clusters without a visible pixel are hidden. Margins cover what vertex transforms, the
// rasteriser's grid and its interpolation of depth may add:
// - a pixel on each side of the box's rectangle;
// - kDepthMargin of the depth and kRangeMargin of the box's range of depths. The interpolated depth of a sliver may be
//   outside of its vertices' depths by a share of their range.
// - kOrthographicMargin in orthographic views, whose depths have an absolute error.

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) readonly buffer Clusters { DrawCluster clusters[]; };
layout(set = 0, binding = 2) uniform sampler2D depth_0;
layout(set = 0, binding = 3) uniform sampler2D depth_1;
layout(set = 0, binding = 4) uniform sampler2D depth_2;
layout(set = 0, binding = 5) uniform sampler2D depth_3;
layout(set = 0, binding = 6) uniform sampler2D depth_4;
layout(set = 0, binding = 7, scalar) writeonly buffer Visible { uint visible[]; };  // 0 or 1
layout(set = 0, binding = 8, scalar) buffer Counters { CullingCounters counters; };
layout(push_constant, scalar) uniform Push { uint cluster_count; };

const float kDepthMargin = 1e-4, kRangeMargin = 1.0 / 16.0, kOrthographicMargin = 1e-5;
const int kMostTexels = 5;  // a level is chosen in which the rectangle touches at most this many texels along a side

// The box in the picture. Pixels, y downwards.
struct PictureBox {
  vec2 low, high;
  float nearest, farthest;  // depths
  bool before_camera;       // false: it reaches behind the camera, and nothing else is known
};

PictureBox picture_box(DrawCluster cluster) {
  PictureBox box = PictureBox(vec2(1e30), vec2(-1e30), 0.0, 1.0, true);
  for (int i = 0; i < 8; ++i) {
    bvec3 upper = bvec3((i & 1) != 0, (i & 2) != 0, (i & 4) != 0);
    vec4 clip = view.clip_from_relative * vec4(mix(cluster.low, cluster.high, upper), 1.0);
    box.before_camera = box.before_camera && clip.w > 0.0 && clip.z <= clip.w;
    vec3 point = clip.xyz / clip.w;
    vec2 pixel = (vec2(point.x, -point.y) * 0.5 + 0.5) * vec2(view.size);
    box.low = min(box.low, pixel);
    box.high = max(box.high, pixel);
    box.nearest = max(box.nearest, point.z);
    box.farthest = min(box.farthest, point.z);
  }
  return box;
}

float fetch_depth(int level, ivec2 texel) {
  if (level == 0) return texelFetch(depth_0, texel, 0).r;
  if (level == 1) return texelFetch(depth_1, texel, 0).r;
  if (level == 2) return texelFetch(depth_2, texel, 0).r;
  if (level == 3) return texelFetch(depth_3, texel, 0).r;
  return texelFetch(depth_4, texel, 0).r;
}

bool is_hidden(DrawCluster cluster) {
  if (any(lessThan(cluster.high, cluster.low))) return false;
  PictureBox box = picture_box(cluster);
  if (!box.before_camera) return false;
  vec2 last_pixel = vec2(view.size) - 1.0;
  ivec2 low = ivec2(clamp(box.low - 1.0, vec2(0.0), last_pixel)) / int(GLOAM_CULLING_TEXEL);
  ivec2 high = ivec2(clamp(box.high + 1.0, vec2(0.0), last_pixel)) / int(GLOAM_CULLING_TEXEL);
  ivec2 touched = high - low + 1;
  int extent = max(touched.x, touched.y);
  int level = extent < kMostTexels ? 0 : min(findMSB(extent - 1) - 1, int(GLOAM_CULLING_LEVELS) - 1);
  low >>= level;
  high >>= level;
  float farthest = 1.0;
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) farthest = min(farthest, fetch_depth(level, ivec2(x, y)));
  float nearest = box.nearest * (1.0 + kDepthMargin) + (box.nearest - box.farthest) * kRangeMargin;
  if (view.orthographic != 0u) nearest += kOrthographicMargin;
  return nearest < farthest;
}

void main() {
  uint index = gl_GlobalInvocationID.x;
  if (index >= cluster_count) return;
  DrawCluster cluster = clusters[index];
  bool hidden = is_hidden(cluster);
  visible[index] = hidden ? 0u : 1u;
  if (!hidden) return;
  atomicAdd(counters.clusters, 1u);
  atomicAdd(counters.triangles, cluster.index_count / 3u);
}

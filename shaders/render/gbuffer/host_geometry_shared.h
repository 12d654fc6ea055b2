// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_GBUFFER_HOST_GEOMETRY_SHARED_H
#define GLOAM_SHADERS_RENDER_GBUFFER_HOST_GEOMETRY_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// Encodings of the host's images.
struct HostGeometryConstants {
  vec4 world_x;  // xyz: world axis of the x of stored normals
  vec4 world_y;
  vec4 world_z;
  vec4 normal_scale;  // decoded = stored * x + y
  uint depth_kind;    // HostDepth
  float near_m;
  float far_m;        // 0: infinitely far
  uint octahedral;    // 0 or 1
  uint channels;      // 4 bits each, HostChannel: roughness, metallic, occlusion
  uint srgb;          // 1: base colours are sRGB-encoded
  uint face_normals;  // 1: there is an image of them
  uint emissive;      // 1: there is an image of it
};

GLOAM_SHARED_END

#endif

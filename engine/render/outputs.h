// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/math/types.h"

namespace gloam {

/// The geometry buffer of a view, written by the geometry pass; formats are in shaders/render/gbuffer_api.glsl.
struct GeometryOutputs {
  ImageRef base_color;
  ImageRef normals;
  ImageRef material;
  ImageRef emissive;
  ImageRef depth;  ///< d32, reversed Z, 0 = sky
  /// rg32f, one texel per 8×8 tile: farthest and nearest depth, sky excluded; (1, 0) if the tile shows only sky.
  ImageRef depth_bounds;
};

/// Linear light of the view, cd/m² before exposure, rgba16f. The renderer creates the image and shading fills it. Later
/// passes write it in place, or read it and write their result to another image of the same size and format, for
/// example a transient one (create_view_image). Either way, the pass puts the written version into `color`. An image
/// that is owned outside the graph must have been created as sampled.
struct LitOutput {
  ImageRef color;
};

/// Image of the finished picture, the caller's or the renderer's. Available from the first phase on. Written in place:
/// a write moves `color` on to the image's new version, but `color` must never refer to another image.
struct TargetOutput {
  ImageRef color;
  gpu::Format format = gpu::Format::rgba8_srgb;
};

/// Side of a shadow tile and of a depth_bounds tile, in pixels.
inline constexpr std::uint32_t kTileSize = 8;

/// One texel of GeometryOutputs, decoded on the CPU from its four images' bytes.
struct GeometryTexel {
  vec3 base_color = vec3(0.0f);  ///< linear
  bool subsurface = false;
  vec3 normal = vec3(0.0f);
  vec3 face_normal = vec3(0.0f);
  float roughness = 0.0f;
  float metallic = 0.0f;
  float occlusion = 0.0f;
  float reflectivity = 0.0f;
};

/// Decodes one texel. base_color: rgba8_unorm as 0xAABBGGRR, with square roots of the linear colour; normals: the two
/// words of the texel; material: rgba8_unorm as 0xAABBGGRR.
[[nodiscard]] GeometryTexel decode_geometry(std::uint32_t base_color, glm::uvec2 normals, std::uint32_t material);

}  // namespace gloam

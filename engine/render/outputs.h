// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/math/types.h"

namespace gloam {

/// What the geometry pass leaves for a view; formats are in shaders/render/gbuffer_api.glsl.
struct GeometryOutputs {
  ImageRef base_color;
  ImageRef normals;
  ImageRef material;
  ImageRef emissive;
  ImageRef depth;         ///< d32, reversed Z, 0 = sky
  ImageRef depth_bounds;  ///< rg32f, one texel an 8×8 tile: farthest and nearest depth without sky; (1, 0) where there
                          ///< is only sky
};

/// Linear light of the view, cd/m² before exposure, rgba16f. The renderer makes the image, shading fills it, later
/// phases write in place: `color` moves on to the version that a write gives, and never to another image
/// (Renderer::read_linear reads this one). A phase that needs the old light beside the new one copies it first.
struct LitOutput {
  ImageRef color;
};

/// Where the finished picture goes: the caller's image or the renderer's, there from the first phase on. Written in
/// place, as LitOutput.
struct TargetOutput {
  ImageRef color;
  gpu::Format format = gpu::Format::rgba8_srgb;
};

/// Pixels along one side of a shadow tile, of a tile of depth_bounds.
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

/// base_color: rgba8_unorm square roots as 0xAABBGGRR; normals: the two words; material: rgba8_unorm as 0xAABBGGRR.
[[nodiscard]] GeometryTexel decode_geometry(std::uint32_t base_color, glm::uvec2 normals, std::uint32_t material);

}  // namespace gloam

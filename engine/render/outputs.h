// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>

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
  /// Set from PassPhase::lists on.
  ImageRef depth_bounds;
  /// rg32f: screen motion in pixels, the position of the surface point in this frame minus its position in the world's
  /// previous frame, x to the right, y down. Null unless a module that the view demands needs it
  /// (Module::needs_motion). The previous position is what RenderView::previous sees in a picture of the current size.
  ///
  /// Objects that the previous frame did not draw, whose mesh or skin has changed, or that are listed in Teleports have
  /// the motion of objects at rest. So have all objects in the first frame with motion. Sky has the motion of
  /// infinitely distant points, which only the camera's rotation moves; 0 if a camera is orthographic. Blended surfaces
  /// leave the motion of the solid surface or the sky behind them. Each component is within ±65536; points that were
  /// behind the previous camera have (65536, 65536), outside of any picture.
  ///
  /// 32-bit floats, because 16-bit floats would round motion of 64 pixels and more by up to 0.03 pixels.
  ImageRef motion;
  /// rg32_uint: the smooth surface that the vertex normals of smooth-shaded meshes describe (decode_smooth_surface,
  /// shaders/render/smooth_surface_api.glsl); 0 where the drawn surface is the smooth one. Null unless a module that
  /// the view demands needs it (Module::needs_smooth_surfaces) and the scene has smooth-shaded meshes. Set from
  /// PassPhase::lists on. Only the renderer's own surfaces have a smooth surface, not those of PassPhase::geometry.
  ImageRef smooth_surfaces;
};

/// Linear light of the view, cd/m² before exposure · RenderView::light_scale, rgba16f. The renderer creates the image
/// and shading fills it. Later passes write it in place, or read it and write their result to another image of the same
/// size and format, for example a transient one (create_view_image). Either way, the pass puts the written version into
/// `color`. Shading writes 1 to alpha. In jittered views (RenderView::jittered) passes multiply alpha by 1 - opacity if
/// they draw light whose motion is not in GeometryOutputs::motion (BlendMode::premultiplied_over). Passes that replace
/// light keep its alpha. An image that is owned outside the graph must have been created as sampled.
struct LitOutput {
  ImageRef color;
};

/// Image of the finished picture, the caller's or the renderer's. Available from the first phase on. Written in place:
/// a write moves `color` on to the image's new version, but `color` must never refer to another image.
struct TargetOutput {
  ImageRef color;
  gpu::Format format = gpu::Format::rgba8_srgb;
};

/// Images of callers that views capture light into (ViewTarget::light), on the frame's shared board; newest versions.
struct CapturedLight {
  std::map<gpu::ImageHandle, ImageRef> images;
};

/// Images of the frame's companion views (Module::companion_views), on the frame's shared board; by the view's id.
struct CompanionLight {
  struct Images {
    ImageRef light;  ///< LitOutput::color after all passes
    ImageRef depth;  ///< GeometryOutputs::depth
  };
  std::map<std::uint32_t, Images> views;
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

/// One texel of GeometryOutputs::smooth_surfaces, decoded on the CPU.
struct SmoothSurface {
  bool exists = false;       ///< false: the drawn surface is the smooth one
  vec3 offset = vec3(0.0f);  ///< metres, from the drawn surface
  vec3 normal = vec3(0.0f);  ///< unit, on the visible side
};
[[nodiscard]] SmoothSurface decode_smooth_surface(uvec2 texel);

}  // namespace gloam

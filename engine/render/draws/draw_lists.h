// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/math/bounds.h"
#include "engine/render/draws/casters.h"
#include "engine/render/scene/draw_pipelines.h"
#include "engine/render/scene/gpu_scene.h"
#include "engine/render/view.h"
#include "shaders/render/culling/culling_shared.h"
#include "shaders/render/deform_shared.h"
#include "shaders/render/draw_shared.h"

namespace gloam {

/// One indexed draw: consecutive triangles of one primitive of one instance.
struct Draw {
  Entity entity;
  const GpuPrimitive* primitive = nullptr;
  SurfaceVariant variant;
  shaders::DrawConstants constants{};
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::uint32_t deform = kNone;     ///< index into FrameDraws::deforms, or kNone for rest vertices
  float depth_m = 0.0f;             ///< nearest view depth of the bounds
  Aabb bounds;                      ///< of the drawn vertices, relative to the view's position; empty: unknown
  std::uint32_t first_cluster = 0;  ///< of a solid draw: its part of ViewDraws::clusters
  std::uint32_t cluster_count = 0;
};

/// A primitive of an instance whose vertices the GPU morphs or skins in this frame, if anything uses them.
struct DeformJob {
  Entity entity;
  const GpuPrimitive* primitive = nullptr;
  shaders::DeformConstants constants{};
  std::uint32_t first_vertex = 0;  ///< in the frame's deformed streams, a multiple of 64
};

/// All draws of one view. `solid`: opaque and alpha-masked surfaces, by pipeline variant, then front to back.
/// `blended`: back to front.
struct ViewDraws {
  std::vector<Draw> solid;
  std::vector<Draw> blended;
  /// Of solid draws. The clusters of a draw are consecutive triangles, in order.
  std::vector<shaders::DrawCluster> clusters;
  std::uint32_t culled_instances = 0;
};

/// All draws of one frame of a world. `deforms`: the deformed primitives of draws and casters of all views.
struct FrameDraws {
  std::vector<ViewDraws> views;
  std::vector<DeformJob> deforms;
  std::uint32_t deformed_vertices = 0;
  CasterList casters;  ///< empty unless DrawListContents::casters
};

/// The world matrix of a primitive's positions, which are relative to GpuPrimitive::origin.
[[nodiscard]] dmat4 from_origin(const dmat4& world_from_mesh, const GpuPrimitive& primitive);

/// Push constants that draw a mesh relative to `origin` (world). Composed in double.
[[nodiscard]] shaders::DrawConstants draw_constants(const dmat4& world_from_mesh, const dvec3& origin);

/// What a frame's draw lists hold besides the draws of views.
struct DrawListContents {
  bool casters = false;        ///< all shadow casters, in a view or not, with jobs that deform them
  bool caster_levels = false;  ///< with Caster::levels
};

/// Culls every MeshInstance of the world against each view, in jobs. The result does not depend on the number of
/// threads.
[[nodiscard]] FrameDraws build_frame_draws(const World& world, std::span<const RenderView* const> views,
                                           const GpuScene& scene, JobExecutor& executor,
                                           const DrawListContents& contents = {});

}  // namespace gloam

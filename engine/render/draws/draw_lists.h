// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/draws/casters.h"
#include "engine/render/scene/draw_pipelines.h"
#include "engine/render/scene/gpu_scene.h"
#include "engine/render/view.h"
#include "shaders/render/deform_shared.h"
#include "shaders/render/draw_shared.h"

namespace gloam {

/// One run of triangles of one instance.
struct Draw {
  const GpuPrimitive* primitive = nullptr;
  SurfaceVariant variant;
  shaders::DrawConstants constants{};
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::uint32_t deform = kNone;  ///< index into DrawLists::deforms, or kNone for rest vertices
  float depth_m = 0.0f;          ///< nearest view depth of the bounds
};

/// A primitive of an instance whose vertices the GPU moves this frame.
struct DeformJob {
  const GpuPrimitive* primitive = nullptr;
  shaders::DeformConstants constants{};
  std::uint32_t first_vertex = 0;  ///< in the frame's deformed streams, a multiple of 64
};

/// What one view draws: opaque and cut-out surfaces by pipeline, then front to back; blended ones back to front.
/// `deforms` are those of draws and casters.
struct DrawLists {
  std::vector<Draw> solid;
  std::vector<Draw> blended;
  std::vector<DeformJob> deforms;
  std::uint32_t deformed_vertices = 0;
  std::uint32_t culled_instances = 0;
  CasterList casters;  ///< empty unless asked for
};

/// Push constants of a mesh with this matrix, with vertices relative to `origin` (world); composed in double.
[[nodiscard]] shaders::DrawConstants draw_constants(const dmat4& world_from_mesh, const dvec3& origin);

/// Culls every MeshInstance of the world against the view, in jobs. The result does not depend on the number of
/// threads. `with_casters`: lists what casts shadows too, wherever it is, and has it deformed.
[[nodiscard]] DrawLists build_draw_lists(const World& world, const RenderView& view, const GpuScene& scene,
                                         JobExecutor& executor, bool with_casters = false);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "engine/render/scene/draw_pipelines.h"
#include "engine/render/scene/gpu_scene.h"
#include "shaders/render/draw_shared.h"

namespace gloam {

/// One primitive of one mesh instance that may block light, in the camera's view or not. Blended surfaces are not
/// casters. The bounds enclose the vertices of this frame, morphed and skinned. Vertices that the GPU computes in float
/// may lie outside by rounding.
struct Caster {
  Entity entity;
  const GpuPrimitive* primitive = nullptr;
  std::uint64_t content = 0;           ///< GpuPrimitive::content
  std::uint64_t cut_out_content = 0;   ///< GpuMaterial::content if the material cuts out; otherwise 0
  SurfaceVariant variant;              ///< the variant that draws it in a camera's view
  bool subsurface = false;             ///< of the material
  bool moving = false;                 ///< its vertices move every frame (skinned or morphed)
  std::uint32_t deform = ~0u;          ///< index into DrawLists::deforms, or kNone
  dmat4 world_from_mesh = dmat4(1.0);  ///< skinned: only the translation to the origin of the skinned vertices
  dvec3 bounds_min = dvec3(0.0);       ///< world
  dvec3 bounds_max = dvec3(0.0);       ///< world; less than bounds_min if unknown: the caster may be anywhere
  /// Number of the levels of detail that may be drawn in place of all triangles (GpuPrimitive::levels), and the
  /// greatest distance of each from the full surface.
  std::uint32_t levels = 0;
  LevelErrors level_errors_m{};
  double emissive_reach_m = 0.0;  ///< half_diagonal() of a rigid, emissive caster; 0 for all others
};

/// Casters, ordered by entity index, then by primitive.
struct CasterList {
  std::vector<Caster> casters;
};

/// Push constants that draw a caster relative to `origin` (world). Composed in double, so that they are exact far from
/// the world's origin too, if the caster is near `origin`.
[[nodiscard]] shaders::DrawConstants caster_constants(const Caster& caster, const dvec3& origin);

}  // namespace gloam

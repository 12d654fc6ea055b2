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

/// One primitive of one instance, wherever the camera looks: what may cast a shadow. Blended surfaces cast none. Bounds
/// are of the vertices as the frame shows them, morphed and posed; what GPUs make of them in float may lie outside by
/// rounding.
struct Caster {
  Entity entity;
  const GpuPrimitive* primitive = nullptr;
  SurfaceVariant variant;              ///< as it is drawn for a camera
  bool subsurface = false;             ///< of its material
  bool moving = false;                 ///< its vertices move every frame (skinned or morphed)
  std::uint32_t deform = ~0u;          ///< index into DrawLists::deforms, or kNone
  dmat4 world_from_mesh = dmat4(1.0);  ///< of a skinned one: only the origin of its moved vertices
  dvec3 bounds_min = dvec3(0.0);       ///< world
  dvec3 bounds_max = dvec3(0.0);       ///< below bounds_min where they are not known: it may be anywhere
};

/// Ordered by entity index, then by primitive.
struct CasterList {
  std::vector<Caster> casters;
};

/// Push constants that draw a caster with vertices relative to `origin` (world). Composed in double: exact far from the
/// world's origin too, while caster and origin lie near each other.
[[nodiscard]] shaders::DrawConstants caster_constants(const Caster& caster, const dvec3& origin);

}  // namespace gloam

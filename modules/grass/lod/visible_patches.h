// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Patches are culled first, so that the far part of a field costs patches and not blades.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/render/view.h"
#include "modules/grass/components.h"

namespace gloam {

/// A light whose shadows may be seen. Lights, patches and views are in metres.
struct CastingLight {
  bool directional = false;
  dvec3 position = dvec3(0.0);  ///< world; of a local light
  vec3 direction = vec3(0.0f);  ///< in which a directional light shines
  float range_m = 0.0f;         ///< of a local light
};

/// Limits of culling.
struct PatchCulling {
  float cast_distance_m = 0.0f;  ///< nearer patches are kept although out of view if they may cast shadows into it
  std::span<const CastingLight> lights = {};
};

/// Whether the shadow that the box casts in the light may reach the view. box: camera-relative. Never false for a box
/// whose shadow does.
[[nodiscard]] bool may_cast_into(const RenderView& view, const Aabb& box, const CastingLight& light);

/// One patch that a view draws.
struct VisiblePatch {
  std::uint32_t patch = 0;  ///< index in the field
  float nearest_m = 0.0f;   ///< distance from the camera to the box of its roots
  bool operator==(const VisiblePatch&) const = default;
};

/// The patches of a view, nearest first. A view resource.
struct VisiblePatches {
  std::vector<VisiblePatch> patches;
  float range_m = 0.0f;       ///< greatest GrassPatch::max_distance_m among them
  std::uint32_t in_view = 0;  ///< patches that may show a blade; the others only cast
  bool cast = false;          ///< blades cast shadows: the culling had lights and a cast distance
};

/// Box of everything that the patch's blades may touch, relative to its origin, along the world's axes: every knot lies
/// within its blade's length of the root.
[[nodiscard]] Aabb reach_box(const GrassPatch& patch);

/// The patches that may show a blade in the view, or have one within the cast distance whose shadow may reach the view.
/// Never drops another one.
/// Ordered by distance, then by index, for any executor.
[[nodiscard]] VisiblePatches find_visible_patches(std::span<const GrassPatch> patches, const RenderView& view,
                                                  const PatchCulling& culling, JobExecutor& jobs);

}  // namespace gloam

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

/// Limits of culling.
struct PatchCulling {
  float cast_distance_m = 0.0f;  ///< nearer patches are kept although out of view: they may cast shadows into it
};

/// One patch that a view draws.
struct VisiblePatch {
  std::uint32_t patch = 0;  ///< index in the field
  float nearest_m = 0.0f;   ///< distance from the camera to the box of its roots
  bool operator==(const VisiblePatch&) const = default;
};

/// The patches of a view, nearest first. A view resource.
struct VisiblePatches {
  std::vector<VisiblePatch> patches;
  float range_m = 0.0f;  ///< greatest GrassPatch::max_distance_m among them
};

/// Box of everything that the patch's blades may touch, relative to its origin, along the world's axes: every knot lies
/// within its blade's length of the root.
[[nodiscard]] Aabb reach_box(const GrassPatch& patch);

/// The patches that may show a blade in the view, or have one within the cast distance. Never drops another one.
/// Ordered by distance, then by index, for any executor.
[[nodiscard]] VisiblePatches find_visible_patches(std::span<const GrassPatch> patches, const RenderView& view,
                                                  const PatchCulling& culling, JobExecutor& jobs);

}  // namespace gloam

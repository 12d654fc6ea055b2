// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"
#include "shaders/reflections/reflections_shared.h"

namespace gloam {

/// Cells along each side of the images of proxies and of probes that have a factor of their own.
inline constexpr std::uint32_t kProxyCells = GLOAM_PROXY_CELLS, kProbeCells = GLOAM_PROBE_CELLS;

[[nodiscard]] CapturedLightState light_state(Entity entity, const Light& light, const dmat4& world_from_node);

/// States of all lights of the world, by entity index.
[[nodiscard]] std::vector<CapturedLightState> light_states(const World& world);

/// A rectangle or parallelogram that stands for lit surfaces: center + s · half_u + t · half_v, s and t in −1…1.
struct LitPatch {
  dvec3 center = dvec3(0.0);
  dvec3 half_u = dvec3(0.0);
  dvec3 half_v = dvec3(0.0);
  dvec3 normal = dvec3(0.0, 0.0, 1.0);  ///< unit length, to the lit side
};

/// What a proxy shows in the kProxyCells × kProxyCells cells of its image, rows from the top: parts of its rectangle,
/// moved to the mean distance of the captured surfaces (CapturedParts::surface_m).
[[nodiscard]] std::vector<LitPatch> proxy_patches(const PlacedProxy& proxy, float surface_m);

/// What a probe at `eye` shows in the kProbeCells × kProbeCells cells of its octahedral map: squares as large as the
/// cells are seen; of no size for the sky.
[[nodiscard]] std::vector<LitPatch> probe_patches(const dvec3& eye, std::span<const CapturedSurface> surfaces);

/// Mean illuminance of the patch by a light that emits 1 cd (directional: 1 lx), without shadows and cookies. Exact for
/// a point light without a range (the solid angle of the patch); ranges and cones are sampled at 3 × 3 points. Finite
/// and ≥ 0.
[[nodiscard]] double unit_illuminance(const CapturedLightState& light, const LitPatch& patch);

/// The same of all lights together for each patch, lux in linear RGB.
[[nodiscard]] std::vector<vec3> illuminances(std::span<const CapturedLightState> lights,
                                             std::span<const LitPatch> patches);

}  // namespace gloam

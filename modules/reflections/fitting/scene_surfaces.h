// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/ecs/world.h"
#include "modules/reflections/fitting/planar_regions.h"
#include "modules/reflections/fitting/receivers.h"

namespace gloam {

/// Surfaces with less reflectivity receive no rays for the fit.
inline constexpr float kLeastReflectivity = 0.3f;

/// The rigid, unmoving surfaces of a world, in metres whatever its units are (SceneUnits).
struct SceneSurfaces {
  std::vector<FitTriangles> instances;  ///< ordered by entity index, then by primitive; without blended ones
  std::vector<UpTriangle> ground;       ///< all triangles of `instances`
  std::vector<UpTriangle> reflective;   ///< of materials with at least kLeastReflectivity
};

/// Gathers the triangles of all mesh instances by WorldTransform, without meshes that are skinned or morphed and those
/// on nodes that a playing clip moves (AnimatedNodes). Textures of reflectivity are not read.
[[nodiscard]] SceneSurfaces gather_surfaces(const World& world);

}  // namespace gloam

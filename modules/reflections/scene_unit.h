// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/ecs/world.h"

namespace gloam {

/// What constants of reflections are multiples of, in units of the scene: a metre. They say how thick things are that
/// screen space sees from the front only, how far its rays go, how far before a proxy its capture begins, and cannot be
/// known from a picture.
///
/// SceneUnits (key gloam.scale) states it. For scenes of files without that key a power of ten is estimated when the
/// file is read (estimate_scene_unit); all other worlds are in metres.
[[nodiscard]] double scene_unit(const World& world);

/// World resource: the estimate for a file.
struct EstimatedUnit {
  double unit = 1.0;  ///< a metre in units of the scene
};

/// A power of ten that is 1 for scenes of usual size: 0.01 for a room of 10 cm. Scenes are small if their largest mesh
/// is, and large only if most meshes and the near planes of all cameras are, so one object far off, tiny or huge, does
/// not change it. A scene times 0.01, 0.1, 10 or 100 gets that multiple of the unit as long as it has cameras, and
/// meshes of the usual sizes. Nodes are read in their local poses.
[[nodiscard]] double estimate_scene_unit(const World& world);

/// Puts the estimate into the world. For KeyRegistry::add_finish.
[[nodiscard]] Status keep_estimated_unit(World& world);

}  // namespace gloam

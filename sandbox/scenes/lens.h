// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

/// Shows depth of field: pieces on a table before, at and behind the focus, a thin wire close to the camera, a lattice,
/// and small bright lamps at many distances. Cameras "round", "hexagonal" (the same view through the other aperture)
/// and "sharp" (without a focus).
void build_lens_scene(World& world, SceneInfo& info);

}  // namespace gloam

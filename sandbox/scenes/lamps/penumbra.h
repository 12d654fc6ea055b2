// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

inline constexpr double kPenumbraLampHeight_m = 12.0;

/// Shows one penumbra: the shadow of the straight edge of a sheet without thickness (mesh "sheet", x < 0) on a floor (y
/// = 0). A wide lamp (light "lamp", a spot) is straight above the edge at y = kPenumbraLampHeight_m. Camera "main".
void build_penumbra_scene(World& world, SceneInfo& info);

}  // namespace gloam

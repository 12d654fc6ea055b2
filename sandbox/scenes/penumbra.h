// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf_import.h"

namespace gloam {

inline constexpr double kPenumbraLampHeight_m = 12.0;

/// Shows one penumbra: the straight edge of a sheet of no thickness (mesh "sheet", x < 0) above a floor (y = 0),
/// straight below a wide lamp (light "lamp", a spot over the edge, kPenumbraLampHeight_m high). Camera "main".
void build_penumbra_scene(World& world, SceneInfo& info);

}  // namespace gloam
